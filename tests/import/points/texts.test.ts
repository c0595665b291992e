import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { errorIn, placesIn, pointsIn, readPointsIn } from '../../helpers/points.ts';

const trc = (head: readonly string[], labels: string, rows: readonly string[]) =>
  ['PathFileType\t4\t(X/Y/Z)\tx.trc', ...head, labels, '\t\tX1\tY1\tZ1\tX2\tY2\tZ2', '', ...rows].join('\n');
const HEAD = ['DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits', '60\t60\t2\t2\tmm'];
const NAMES = 'Frame#\tTime\tLASI\t\t\tLeft knee\t\t';
const ROWS = ['1\t0\t1\t1000\t3\t4\t500\t6', '2\t0.0166667\t1.5\t1001\t3e0\t\t\t'];
const PLACES = [
  [
    [1, 1000, 3],
    [4, 500, 6],
  ],
  [[1.5, 1001, 3], null],
];

describe('a .trc', () => {
  it('has its points where its rows say, with labels that have blanks, and none where cells are empty', async () => {
    const { character, take, diagnostics } = await pointsIn('x.trc', trc(HEAD, NAMES, ROWS));
    expect(character.skeleton.joints.map(({ name }) => name)).toEqual(['LASI', 'Left knee']);
    expect(placesIn(character)).toEqual(PLACES);
    expect(take.samples?.frameSeconds).toBe(1 / 60);
    expect(character.space?.space).toMatchObject({ unit: 'millimetres', up: 'y', known: 'stated' });
    expect(diagnostics.map(({ severity }) => severity)).toEqual(['info']);
  });

  it.each([
    ['\r\n', ROWS],
    ['\r', ROWS],
    ['\r\r\n', ROWS],
    ['\n', [ROWS[0], '2\t0.0166667\t1.5\t1001\t3\tNaN\tnan\tNaN']],
    ['\n', [ROWS[0], '', '2\t0.0166667\t 1.5\t1001 \t3', '']],
  ])('is read the same with the line end %j and other cells for a missing point', async (end, rows) => {
    const { character } = await pointsIn('x.trc', trc(HEAD, NAMES, rows).replaceAll('\n', end));
    expect(placesIn(character)).toEqual(PLACES);
  });

  it('may have decimal commas, in its rate too', async () => {
    const text = trc(HEAD, NAMES, ROWS).replace('60\t60', '60,0\t60').replaceAll('.', ',').replace('x,trc', 'x.trc');
    const { character, diagnostics } = await pointsIn('x.trc', text);
    expect(placesIn(character)).toEqual(PLACES);
    expect(diagnostics.map(({ severity }) => severity)).toEqual(['info']);
  });

  it('says what it states and isn’t so', async () => {
    const head = ['DataRate\tNumFrames\tNumMarkers\tUnits', '0\t7\t3\tfathoms'];
    const { take, diagnostics } = await pointsIn('x.trc', trc(head, NAMES, ROWS));
    expect(diagnostics.map(({ code }) => code)).toEqual([
      'count-differs',
      'count-differs',
      'unit-unknown',
      'rate-expected',
      'unit-guessed',
    ]);
    expect(take.samples?.frameSeconds).toBe(1 / 60);
  });

  it.each([
    ['without rows', trc(HEAD, NAMES, []), /rows of numbers after the labels, found none/],
    ['with a cell that is no number', trc(HEAD, NAMES, ['1\t0\t1\tx5\t3']), /Expected a number, found “x5”/],
    ['with a number that is too large', trc(HEAD, NAMES, ['1\t0\t1\t1e999\t3']), /found “1e999”/],
    [
      'with a row that is too long',
      trc(HEAD, NAMES, ['1\t0\t1\t2\t3\t4\t5\t6\t7']),
      /at most 8 numbers in a row, found 9/,
    ],
    ['of something else', 'hello\n1 2 3\n', /PathFileType/],
    ['without labels', trc(HEAD, 'Frame#\tTime', ROWS), /found no label/],
  ])('%s brings an error in words', async (_, text, message) => {
    expect(await errorIn('x.trc', text)).toMatch(message);
  });

  it('may have quotes in labels, and line ends of any kind beside each other', async () => {
    const text = trc(HEAD, 'Frame#\tTime\t"A\t\t\tB"C\t\t', [`${ROWS[0]}\r${ROWS[1]}`]).replace('\n', '\r');
    const { character } = await pointsIn('x.trc', text);
    expect(character.skeleton.joints.map(({ name }) => name)).toEqual(['"A', 'B"C']);
    expect(placesIn(character)).toEqual(PLACES);
  });

  it('tells the line and the column of a cell that is no number', async () => {
    const { diagnostics } = await readPointsIn('x.trc', trc(HEAD, NAMES, [ROWS[0], '2\t0\t1\t2\tthree']));
    expect(diagnostics.at(-1)).toMatchObject({ line: 8, column: 9, excerpt: { text: '2\t0\t1\t2\tthree', caret: 8 } });
  });
});

describe('a table', () => {
  it('of NAME.x NAME.y NAME.z has points, and the rate of its times', async () => {
    const text =
      'Frame,Time,LASI.X,LASI.Y,LASI.Z,knee_x,knee_y,knee_z\n0,0.00,1,1000,3,4,500,6\n1,0.02,1.5,1001,3,,,\n';
    const { character, take } = await pointsIn('x.csv', text);
    expect(character.skeleton.joints.map(({ name }) => name)).toEqual(['LASI', 'knee']);
    expect(placesIn(character)).toEqual(PLACES);
    expect(take.samples?.frameSeconds).toBe(0.02);
    expect(character.space?.space).toMatchObject({ up: 'y', known: 'guessed' });
  });

  it.each([
    'frame;time;a.x;a.y;a.z\n0;0;0,5;-1,25e1;3\n1;0,04;1;2;3\n',
    'frame\ttime\ta_x\ta_y\ta_z\n0\t0\t0,5\t-12,5\t3\n1\t0,04\t1\t2\t3\n',
    'frame;time;joint;x;y;z\n0;0;a;0,5;-12,5;3\n1;0,04;a;1;2;3\n',
  ])('may have decimal commas where commas separate no cells: %j', async (text) => {
    const { character, take } = await pointsIn('x.csv', text);
    expect(placesIn(character)).toEqual([[[0.5, -12.5, 3]], [[1, 2, 3]]]);
    expect(take.samples?.frameSeconds).toBe(1 / 25);
  });

  it.each([
    ['frame,time,a.x,a.y,a.z\n4,0.4,1,2,3\n5,0.5,1,3,3\n8,0.8,1,4,3\n', 1 / 10],
    ['frame,a.x,a.y,a.z\n10,1,2,3\n12,1,3,3\n18,1,4,3\n', 1 / 30],
  ])('with a row for each frame has frames that are left out as frames without points: %j', async (text, seconds) => {
    const { character, take } = await pointsIn('x.csv', text);
    expect(placesIn(character)).toEqual([[[1, 2, 3]], [[1, 3, 3]], [null], [null], [[1, 4, 3]]]);
    expect(take.samples?.frameSeconds).toBe(seconds);
  });

  it('whose numbers of frames don’t rise has a frame a row; the time of a single one tells no rate', async () => {
    const { character } = await pointsIn('x.csv', 'frame,a.x,a.y,a.z\n5,1,2,3\n1,1,3,3\n1,1,4,3\n');
    expect(placesIn(character)).toEqual([[[1, 2, 3]], [[1, 3, 3]], [[1, 4, 3]]]);
    const { diagnostics } = await readPointsIn('x.csv', 'time,a.x,a.y,a.z\n5,1,2,3\n');
    expect(diagnostics.map(({ message }) => message).join(' ')).toContain(
      'No rate follows from the time of one frame.',
    );
  });

  it('with a row for each point has points, with frames that are left out as frames without them', async () => {
    const text = 'frame;name;x;y;z;score\n0;"a";1;1000;3;0.5\n0;b;4;500;6;0.1\n1;a;1.5;1001;3;1\n3;b;4;501;6;1\n';
    const { character, take, diagnostics } = await pointsIn('x.csv', text);
    expect(character.skeleton.joints.map(({ name }) => name)).toEqual(['a', 'b']);
    expect(placesIn(character)).toEqual([...PLACES, [null, null], [null, [4, 501, 6]]]);
    expect(take.samples?.frameSeconds).toBe(1 / 30);
    expect(diagnostics.map(({ code }) => code)).toContain('rate-assumed');
  });

  it('with the numbers 0 to 32 is a person as MediaPipe finds one, whose joints have bones', async () => {
    const rows = [0, 1].flatMap((frame) =>
      Array.from({ length: 33 }, (_, p) => `${frame},${32 - p},${p % 5},${p},${frame + (p % 3)}`),
    );
    const { character, diagnostics } = await pointsIn('x.csv', `frame,landmark,x,y,z\n${rows.join('\n')}`);
    expect(character.skeleton.joints).toHaveLength(35);
    expect(diagnostics.map(({ message }) => message).join(' ')).toContain('numbered as those of MediaPipe');
  });

  it.each([
    'time,hip,knee\n0,1,2\n',
    'hip.x,hip.y,hip.z\n1,2,3\n',
    'frame,hip.x,hip.y\n0,1,2\n',
    'time,hip.px,hip.py,hip.pz\n0,1,2,3\n',
    'frame,x,y,z\n0,1,2,3\n',
    '1,2,3\n4,5,6\n',
    '',
  ])('of other columns is left to the reader of numbers: %j', async (text) => {
    expect(await readPointsIn('x.csv', text)).toMatchObject({ isOther: true, diagnostics: [] });
  });

  it.each([
    ['frame,a.x,a.y,a.z\n', /rows of numbers under the names/],
    ['frame,a.x,a.y,a.z\n0,1,two,3\n', /found “two”/],
    ['frame,joint,x,y,z\n0,,1,2,3\n', /label of a point, found none/],
    ['frame,joint,x,y,z\nzero,a,1,2,3\n', /found “zero”/],
  ])('that is broken brings an error in words: %j', async (text, message) => {
    expect(await errorIn('x.csv', text)).toMatch(message);
  });
});

it('a label is called after its number if it is double, in texts too', async () => {
  const { character } = await pointsIn('x.csv', 'frame,a.x,a.y,a.z,a.x,a.y,a.z\n0,1,2,3,4,5,6\n');
  expect(character.skeleton.joints.map(({ name }) => name)).toEqual(['a', 'point2']);
});

it('texts of points never throw, and say what is wrong in sentences', async () => {
  const cell = fc.constantFrom(
    'frame',
    'time',
    'a.x',
    'a.y',
    'a.z',
    'name',
    'x',
    'y',
    'z',
    '1',
    '-2.5',
    'nan',
    '',
    '"',
    '\r',
  );
  const text = fc.array(fc.array(cell, { maxLength: 8 }), { maxLength: 6 });
  await fc.assert(
    fc.asyncProperty(text, fc.constantFrom('csv', 'trc'), async (rows, extension) => {
      const separator = extension === 'trc' ? '\t' : ',';
      const head = extension === 'trc' ? 'PathFileType\n' : '';
      const content = head + rows.map((row) => row.join(separator)).join('\n');
      const { diagnostics } = await readPointsIn(`x.${extension}`, content);
      for (const { message } of diagnostics) expect(message).toMatch(/\.$/);
    }),
  );
});
