/** `marrow compare` on the command line. */
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { command, commandJson } from '../helpers/command.ts';
import { conformance, describeShared, sharedPath } from '../helpers/shared.ts';

interface CompareJson {
  readonly agrees: boolean;
  readonly time?: number;
  readonly compared: Readonly<Record<string, number>>;
  readonly layout?: { readonly order: string; readonly numbers: number };
  readonly first?: { readonly what: string; readonly index: number; readonly name?: string; readonly time?: number };
  readonly own: readonly number[];
  readonly inherited: readonly number[];
  readonly causes: readonly { readonly code: string; readonly explains: number; readonly of: number }[];
  readonly times?: readonly { readonly time: number; readonly agrees: boolean }[];
}

interface Case {
  readonly kind: string;
  readonly files: readonly string[];
  readonly dump: string;
  readonly args: readonly string[];
  readonly mistake: string;
  readonly expect: {
    readonly agrees: boolean;
    readonly layout?: CompareJson['layout'];
    readonly first?: CompareJson['first'];
    readonly own?: readonly number[];
    readonly causes?: readonly string[];
  };
}

describeShared('the dumps of the reference', () => {
  const cases = conformance<readonly Case[]>('compare/cases.json');

  it.each(cases)('compare as expected: $dump, $mistake', async ({ files, dump, args, expect: expected }) => {
    const paths = [...files.map((file) => sharedPath(`data/${file}`)), sharedPath(`conformance/compare/${dump}`)];
    const found = await commandJson<CompareJson>(['compare', ...paths, ...args], undefined, expected.agrees ? 0 : 1);
    expect(found.agrees).toBe(expected.agrees);
    if (expected.layout) expect(found.layout).toEqual(expected.layout);
    if (expected.first) expect(found.first).toMatchObject(expected.first);
    if (expected.own) expect(found.own).toEqual(expected.own);
    expect(found.causes.map(({ code }) => code).sort()).toEqual([...(expected.causes ?? [])].sort());
  });
});

const SKEL = `balljoint root {
  balljoint arm {
    offset 1 0 0
    pose 0.3 0.2 -0.4
    balljoint hand {
      offset 0 1 0
      pose 0.1 0 0.5
    }
  }
}
`;

describe('marrow compare', () => {
  let folder = '';
  const write = (name: string, text: string) => writeFileSync(join(folder, name), text);
  beforeAll(() => {
    folder = mkdtempSync(join(tmpdir(), 'marrow-compare-'));
    write('a.skel', SKEL);
  });
  afterAll(() => rmSync(folder, { recursive: true }));

  /** What `marrow pose` prints, as another program would. */
  async function ownMatrices(): Promise<readonly (readonly number[])[]> {
    const { characters } = await commandJson<{ characters: { joints: { world: number[] }[] }[] }>(
      ['pose', 'a.skel'],
      folder,
    );
    return characters[0].joints.map(({ world }) => world);
  }

  it('agrees with what marrow pose prints, as text and as JSON', async () => {
    write('own.json', (await command(['pose', 'a.skel', '--json'], folder)).out);
    const found = await commandJson<CompareJson>(['compare', 'a.skel', 'own.json'], folder);
    expect(found).toMatchObject({ agrees: true, compared: { world: 3 }, own: [], inherited: [], causes: [] });
    const { code, out } = await command(['compare', 'a.skel', 'own.json'], folder);
    expect([code, out]).toEqual([0, expect.stringContaining('All agree.')]);
  });

  it('says what is missing where no file is at fault', async () => {
    const { code, err } = await command(['compare', 'a.skel'], folder);
    expect([code, err]).toEqual([2, expect.stringMatching(/^error dump-missing: Expected a dump/)]);
  });

  it('puts rows with names and indices in their places, whatever their order', async () => {
    const [root, arm, hand] = await ownMatrices();
    write('names.txt', `hand: ${hand.join(' ')}\nroot: ${root.join(' ')}\narm: ${arm.join(' ')}\n`);
    write('indices.txt', `2 ${hand.join(' ')}\n0 ${root.join(' ')}\n1 ${arm.join(' ')}\n`);
    for (const name of ['names.txt', 'indices.txt']) {
      expect(await commandJson<CompareJson>(['compare', 'a.skel', name], folder)).toMatchObject({ agrees: true });
    }
  });

  it('tells joints that are wrong by themselves from those below, and says so in words', async () => {
    const matrices = (await ownMatrices()).map((m) => [...m]);
    // The arm is moved, and the hand with it.
    for (const j of [1, 2]) matrices[j][12] += 0.5;
    write('moved.txt', matrices.map((m) => m.join(' ')).join('\n'));
    const found = await commandJson<CompareJson>(['compare', 'a.skel', 'moved.txt'], folder, 1);
    expect(found).toMatchObject({
      first: { what: 'joint', index: 1, name: 'arm' },
      own: [1],
      inherited: [2],
      causes: [],
    });
    const { out } = await command(['compare', 'a.skel', 'moved.txt'], folder);
    expect(out).toContain('First wrong: joint 1 "arm"');
    expect(out).toContain('Inherited (wrong only because a parent is): hand.');
    expect(out).toContain('No known mistake');
  });

  it('names a mistake with a sentence and a formula', async () => {
    const { out } = await command(['pose', 'a.skel', '--json'], folder);
    const joints = JSON.parse(out).characters[0].joints;
    // The hand's local matrix, Rz·Rx at its offset, used as its world matrix.
    const parentless = joints.map(({ world }: { world: number[] }, j: number) => {
      if (j < 2) return world;
      const [sx, cx, sz, cz] = [Math.sin(0.1), Math.cos(0.1), Math.sin(0.5), Math.cos(0.5)];
      return [cz, sz, 0, 0, -cx * sz, cx * cz, sx, 0, sx * sz, -sx * cz, cx, 0, 0, 1, 0, 1];
    });
    write('parentless.json', JSON.stringify({ world: parentless }));
    const text = await command(['compare', 'a.skel', 'parentless.json'], folder);
    expect(text.code).toBe(1);
    expect(text.out).toContain('no-parent');
    expect(text.out).toContain('W = W_parent·L');
    expect(text.out).toContain('Explains 3 of 3');
  });

  it('names the mistakes of two dumps, each with its file, and says what none explains', async () => {
    const anim = (angle: number) =>
      `channel { extrapolate constant constant keys 3 { 0 0 smooth smooth 0.5 ${angle} smooth smooth 2 0.1 smooth smooth } }`;
    write(
      'a.anim',
      `animation { range 0 2 numchannels 12 ${[...'0'.repeat(12)].map((_, c) => anim(0.1 * c)).join(' ')} }`,
    );
    const { out } = await command(['pose', 'a.skel', 'a.anim', '--time', '0.8', '--json'], folder);
    const joints: readonly { world: number[]; local: number[] }[] = JSON.parse(out).characters[0].joints;
    write(
      'anna@0.8.txt',
      joints
        .map(({ local }) => local.join(' '))
        .join('\n')
        .replace(/^/, 'world\n'),
    );
    const times = Array.from({ length: 9 }, (_, i) => i / 4);
    const held = times.map((time) => [
      time,
      ...Array.from({ length: 12 }, (_, c) => (time < 0.5 ? 0 : time < 2 ? 0.1 * c : 0.1)),
    ]);
    write('dan.csv', held.map((row) => row.join(',')).join('\n'));
    const both = await command(['compare', 'a.skel', 'a.anim', 'anna@0.8.txt', 'dan.csv'], folder);
    expect(both.out).toContain('no-parent (W = L), in the world matrices of anna@0.8.txt\n');
    expect(both.out).toContain('stepped, in the channels of dan.csv\n');
    expect(both.out).toContain('Explains 12 of 12 channels');
    const found = await commandJson<CompareJson>(['compare', 'a.skel', 'a.anim', 'anna@0.8.txt', 'dan.csv'], folder, 1);
    expect(found.causes).toMatchObject([
      { code: 'no-parent', kinds: ['world'], files: ['anna@0.8.txt'], explains: 3, of: 3 },
      { code: 'stepped', kinds: ['channels'], files: ['dan.csv'], explains: 12, of: 12 },
    ]);
    write('noise.csv', held.map((row) => row.map((v, c) => (c > 0 ? v + Math.sin(9 * c) : v)).join(',')).join('\n'));
    const { out: text } = await command(['compare', 'a.skel', 'a.anim', 'anna@0.8.txt', 'noise.csv'], folder);
    expect(text).toContain('no-parent');
    expect(text).toContain('No known mistake, alone or with another, explains all of the channels of noise.csv.');
  });

  it('says errors of lengths in the units of the files, and others as they are', async () => {
    const matrices = (await ownMatrices()).map((m) => [...m]);
    matrices[1][12] += 0.5;
    matrices[2][0] += 0.4;
    write('lengths.txt', matrices.map((m) => m.join(' ')).join('\n'));
    const { out } = await command(['compare', 'a.skel', 'lengths.txt'], folder);
    const [, share, size] = /by 0\.5 \((\S+) of the size (\S+)\)/.exec(out) ?? [];
    expect(Number(share) * Number(size)).toBeCloseTo(0.5, 2);
    expect(out).toContain('joint 2 "hand", by 0.4 in its rotation');
    const { first } = await commandJson<CompareJson>(['compare', 'a.skel', 'lengths.txt'], folder, 1);
    expect(first).toEqual({ what: 'joint', index: 1, name: 'arm', error: expect.closeTo(Number(share), 3) });
  });

  it('compares several times in one file, each with its own numbers', async () => {
    const matrices = await ownMatrices();
    const frame = (time: number, by: number) =>
      `time ${time}\n${matrices.map((m) => m.map((v) => v + by).join(' ')).join('\n')}\n`;
    write('takes.txt', frame(0, 0) + frame(0.5, 0.1));
    const found = await commandJson<CompareJson>(['compare', 'a.skel', 'takes.txt'], folder, 1);
    expect(found.time).toBe(0.5);
    expect(found.times?.map(({ time, agrees }) => [time, agrees])).toEqual([
      [0, true],
      [0.5, false],
    ]);
  });

  it('takes a dump without a time to be of the time that another one states', async () => {
    const lines = (await ownMatrices()).map((m) => m.join(' ')).join('\n');
    write('stated@0.5.txt', lines);
    write('positions.txt', (await ownMatrices()).map((m) => m.slice(12, 15).join(' ')).join('\n'));
    const found = await commandJson<CompareJson>(['compare', 'a.skel', 'stated@0.5.txt', 'positions.txt'], folder);
    expect(found).toMatchObject({ agrees: true, time: 0.5, compared: { world: 3, positions: 3 } });
    expect(found.times).toBeUndefined();
  });

  const ANIM = `animation { range 0 1 numchannels 12 ${Array.from({ length: 12 }, (_, c) => `channel { extrapolate constant constant keys 2 { 0 ${0.1 * c} linear linear 1 ${0.4 - 0.1 * c} linear linear } }`).join(' ')} }`;
  const TIMES = [0, 0.25, 1] as const;

  it('takes the times of frames that state none from --times, in order', async () => {
    write('a.anim', ANIM);
    const frames: string[] = [];
    for (const time of TIMES) {
      const args = ['pose', 'a.skel', 'a.anim', `--time=${time}`];
      const { characters } = await commandJson<{ characters: { joints: { world: number[] }[] }[] }>(args, folder);
      frames.push(`${characters[0].joints.map(({ world }) => world.join(' ')).join('\n')}\n`);
    }
    const wrong = frames.map((frame, f) => (f === 1 ? frame.replace(/^\S+/, '9') : frame));
    write('all.txt', frames.join(''));
    write('apart.txt', frames.join('# next\n'));
    write('line.txt', frames.join('').replaceAll('\n', ' '));
    write('wrong.txt', wrong.join(''));
    wrong.forEach((frame, f) => void write(`frame${f}.txt`, frame));
    const at = (...dumps: string[]) => ['compare', 'a.skel', 'a.anim', ...dumps, '--times', TIMES.join(',')];
    for (const dump of ['all.txt', 'apart.txt', 'line.txt']) {
      const found = await commandJson<CompareJson>(at(dump), folder);
      expect(found.times?.map(({ time, agrees }) => [time, agrees])).toEqual(TIMES.map((time) => [time, true]));
    }
    for (const dumps of [['wrong.txt'], ['frame0.txt', 'frame1.txt', 'frame2.txt']]) {
      const found = await commandJson<CompareJson>(at(...dumps), folder, 1);
      expect(found.times?.map(({ time, agrees }) => [time, agrees])).toEqual([
        [0, true],
        [0.25, false],
        [1, true],
      ]);
      expect(found.first).toMatchObject({ what: 'joint', index: 0 });
    }
    const { out } = await command(at('wrong.txt'), folder);
    expect(out).toMatch(/^Times: 0 s agrees, 0\.25 s differs by [\d.]+, 1 s agrees\.$/m);
    // What states its time keeps it, and channels have their own.
    write(
      'stated.txt',
      frames
        .map((frame, f) => `time ${TIMES[f]}\n${frame}`)
        .reverse()
        .join(''),
    );
    expect((await command(at('stated.txt'), folder)).code).toBe(0);
    const values = (time: number) => Array.from({ length: 12 }, (_, c) => 0.1 * c + time * (0.4 - 0.2 * c));
    write('values.csv', [0, 0.5, 1].map((time) => [time, ...values(time)].join(',')).join('\n'));
    expect((await command(at('values.csv'), folder)).code).toBe(0);
    expect((await command(at('values.csv', 'all.txt'), folder)).code).toBe(0);
    for (const options of [['--times=0,1'], ['--times=0,0,1'], ['--times='], ['--times=0,1', '--time=2']]) {
      const { code } = await command(['compare', 'a.skel', 'a.anim', 'all.txt', ...options], folder);
      expect(code, options.join(' ')).toBe(2);
    }
  });

  const figure = (name: string, offset: string, channels: string) =>
    `ROOT ${name} { OFFSET ${offset} CHANNELS ${channels} JOINT ${name}_tip { OFFSET 0.2 1 0.3 CHANNELS 3 Zrotation Xrotation Yrotation End Site { OFFSET 0 1 0 } } }\n`;
  const POSITIONS = 'Xposition Yposition Zposition';
  const ROTATIONS = 'Zrotation Xrotation Yrotation';

  it.each([
    ['with positions', `6 ${POSITIONS} ${ROTATIONS}`, `6 ${POSITIONS} ${ROTATIONS}`],
    ['the first without', `3 ${ROTATIONS}`, `6 ${ROTATIONS} ${POSITIONS}`],
    ['the last without', `6 ${POSITIONS} ${ROTATIONS}`, `3 ${ROTATIONS}`],
  ])('compares all roots of a motion capture file together, %s', async (_, first, last) => {
    const width = [first, last].reduce((sum, list) => sum + Number(list[0]) + 3, 0);
    const row = (f: number) => Array.from({ length: width }, (_, k) => 10 * Math.sin(7 * f + 3 * k)).join(' ');
    const motion = `MOTION\nFrames: 2\nFrame Time: 0.5\n${row(1)}\n${row(2)}\n`;
    write('pair.bvh', `HIERARCHY\n${figure('a', '0 1 0', first)}${figure('b', '2 0 1', last)}${motion}`);
    interface Posed {
      readonly characters: readonly { readonly joints: readonly { world: number[]; local: number[] }[] }[];
    }
    const { characters } = await commandJson<Posed>(['pose', 'pair.bvh', '--time', '0.5'], folder);
    const joints = characters.flatMap((character) => character.joints);
    write('both@0.5.txt', joints.map(({ world }) => world.join(' ')).join('\n'));
    const right = await commandJson<CompareJson>(['compare', 'pair.bvh', 'both@0.5.txt'], folder);
    expect(right).toMatchObject({ agrees: true, compared: { world: 4 } });
    write('locals@0.5.txt', `world\n${joints.map(({ local }) => local.join(' ')).join('\n')}`);
    const wrong = await commandJson<CompareJson>(['compare', 'pair.bvh', 'locals@0.5.txt'], folder, 1);
    expect(wrong).toMatchObject({ first: { what: 'joint', index: 1, name: 'a_tip' }, own: [1, 3] });
    expect(wrong.causes[0]).toMatchObject({ code: 'no-parent', explains: 4, of: 4 });
    // One root alone, too: the one whose numbers these are.
    write('last@0.5.txt', characters[1].joints.map(({ world }) => world.join(' ')).join('\n'));
    expect((await command(['compare', 'pair.bvh', 'last@0.5.txt'], folder)).code).toBe(0);
  });

  it('names twenty joints as text, and counts the others', async () => {
    const chain = Array.from({ length: 30 }, (_, j) => `balljoint j${j} { offset 0 1 0 pose 0.1 0 0`);
    write('chain.skel', `${chain.join('\n')}${'}'.repeat(30)}`);
    write('zeros.txt', `${Array.from({ length: 30 }, () => '0 '.repeat(16)).join('\n')}\n`);
    const { out } = await command(['compare', 'chain.skel', 'zeros.txt'], folder);
    expect(out).toContain('j18, j19 and 10 more.');
    const { own } = await commandJson<CompareJson>(['compare', 'chain.skel', 'zeros.txt'], folder, 1);
    expect(own).toHaveLength(30);
  });

  it('takes a dump that states no time to be of the file pose where that explains it, and says so', async () => {
    const anim = (c: number) =>
      `channel { extrapolate cycle cycle keys 2 { 0 ${0.1 * c} linear linear 1 -0.3 linear linear } }`;
    write('b.skel', SKEL);
    write('b.anim', `animation { range 0 1 numchannels 12 ${[...'0'.repeat(12)].map((_, c) => anim(c)).join(' ')} }`);
    const dumped = async (...args: readonly string[]) => {
      const { out } = await command(['pose', 'b.skel', 'b.anim', ...args, '--json'], folder);
      const joints: readonly { world: number[]; local: number[] }[] = JSON.parse(out).characters[0].joints;
      return joints;
    };
    const timed = (await dumped('--time', '0.5')).map(({ world }) => world.join(' ')).join('\n');
    write('timed.txt', `time 0.5\n${timed}`);
    write('untimed.txt', (await dumped()).map(({ local }) => local.slice(12, 15).join(' ')).join('\n'));
    const { out } = await command(['compare', 'b.skel', 'b.anim', 'timed.txt', 'untimed.txt'], folder);
    expect(out).toContain('timed.txt is compared at 0.5 s, the time it states.');
    expect(out).toContain('untimed.txt is compared in the file pose, because it states no time.');
    expect(out).toContain('no-parent (W = L), in the joint positions of untimed.txt');
    const late = await command(['compare', 'b.skel', 'b.anim', 'timed.txt', '--time', '0'], folder);
    expect(late.out).toContain(
      'The dump is compared at 0.5 s, the time it states; --time 0 is only for dumps without a time.',
    );
    expect(late.code).toBe(0);
    const bare = await command(['compare', 'b.skel', 'timed.txt'], folder);
    expect(bare.out).toContain('The dump is from 0.5 s. Give the .anim too');
    const { hints } = await commandJson<{ hints: readonly string[] }>(['compare', 'b.skel', 'timed.txt'], folder, 1);
    expect(hints).toEqual([expect.stringContaining('Give the .anim too')]);
    write('silent.txt', timed);
    const still = await command(['compare', 'b.skel', 'silent.txt'], folder);
    expect(still.out).toContain('All joints differ. If the dump is from an animation, give the .anim too');
    const silent = await command(['compare', 'b.skel', 'b.anim', 'silent.txt'], folder);
    expect(silent.out).toContain('give its time with --time T');
    const asked = await command(['compare', 'b.skel', 'b.anim', 'silent.txt', '--time', '0.5'], folder);
    expect([asked.code, asked.out]).toEqual([0, expect.stringContaining('is compared at 0.5 s, as asked.')]);
  });

  it('compares with the character whose joints the dump names, although its rows are as wide as channels', async () => {
    const channel = 'channel { extrapolate cycle cycle keys 2 { 0 0.1 linear linear 1 -0.3 linear linear } }';
    mkdirSync(join(folder, 'many/a'), { recursive: true });
    mkdirSync(join(folder, 'many/b'), { recursive: true });
    write('many/a/three.skel', 'balljoint lone { }');
    write('many/a/three.anim', `animation { range 0 1 numchannels 3 ${channel.repeat(3)} }`);
    write('many/b/b.skel', SKEL);
    const rows = (m: readonly number[]) =>
      [0, 1, 2, 3].map((r) => [0, 4, 8, 12].map((c) => m[r + c]).join(' ')).join('\n');
    const matrices = (await ownMatrices()).map((m) => m.map((v, i) => (i === 0 ? v + 50 : v)));
    write(
      'mine.txt',
      ['root', 'arm', 'hand'].map((name, j) => `joint ${j} (${name}):\n${rows(matrices[j])}`).join('\n'),
    );
    const found = await commandJson<CompareJson>(['compare', 'many', 'mine.txt'], folder, 1);
    expect(found).toMatchObject({ compared: { world: 3, channels: 0 }, first: { name: 'root' } });
    const { out } = await command(['compare', 'many', 'mine.txt'], folder);
    expect(out).toContain('Compared with b: 3 world matrices.');
    write('many.csv', '0,0.1,0.1,0.1\n1,-0.3,-0.3,-0.3\n');
    const { code, err } = await command(['compare', 'many', 'mine.txt', 'many.csv'], folder);
    expect([code, err]).toEqual([2, expect.stringContaining('found many.csv of three; mine.txt of b. Compare')]);
  });

  it('takes files of any name as dumps, and the tolerance as given', async () => {
    const matrices = (await ownMatrices()).map((m) => m.map((v, i) => (i === 12 ? v + 0.01 : v)));
    write('mine', matrices.map((m) => m.join(' ')).join('\n'));
    expect((await command(['compare', 'a.skel', 'mine'], folder)).code).toBe(1);
    expect((await command(['compare', 'a.skel', 'mine', '--tolerance', '0.05'], folder)).code).toBe(0);
  });

  it.each([
    ['too few numbers', '1 2 3 4\n5 6 7 8\n', 'dump-length', 1],
    ['vertices without a skin', 'v 1 2 3\n', 'dump-length', 1],
    [
      'a name of no joint',
      `root: ${'0 '.repeat(16)}\nleg: ${'0 '.repeat(16)}\nhand: ${'0 '.repeat(16)}\n`,
      'dump-name',
      2,
    ],
    [
      'a row that lacks a number',
      [`${'0 '.repeat(16)}\n`, `${'0 '.repeat(15)}\n`, `${'0 '.repeat(16)}\n`.repeat(2)].join(''),
      'dump-length',
      2,
    ],
    ['an index twice', `0: ${'0 '.repeat(16)}\n0: ${'0 '.repeat(16)}\n2: ${'0 '.repeat(16)}\n`, 'dump-index', 2],
  ])('refuses %s with its line', async (_, text, code, line) => {
    write('wrong.txt', text);
    const found = await command(['compare', 'a.skel', 'wrong.txt'], folder);
    expect(found.code).toBe(2);
    expect(found.err).toContain(`wrong.txt:${line}:1 error ${code}: Expected`);
  });

  it('says of a file without numbers that it has none, rather than that its kind is unknown', async () => {
    write('empty.txt', '');
    write('words.txt', 'No numbers today.\n');
    expect((await command(['compare', 'a.skel', 'empty.txt'], folder)).err).toContain('found an empty file');
    expect((await command(['compare', 'a.skel', 'words.txt'], folder)).err).toContain('found a file without them');
  });

  it('reads local and world matrices that are printed in turn for each joint, by the names before them', async () => {
    const { out } = await command(['pose', 'a.skel', '--json'], folder);
    const joints: readonly { name: string; world: number[]; local: number[] }[] = JSON.parse(out).characters[0].joints;
    const both = (at: readonly number[]) =>
      at
        .map((j) => joints[j])
        .map(({ name, local, world }) => `${name}\nlocal\n${local.join(' ')}\nworld\n${world.join(' ')}\n`)
        .join('');
    for (const order of [
      [0, 1, 2],
      [2, 0, 1],
    ]) {
      write('turns.txt', both(order));
      expect(await commandJson<CompareJson>(['compare', 'a.skel', 'turns.txt'], folder)).toMatchObject({
        agrees: true,
        compared: { world: 3, local: 3 },
      });
    }
    write('turns.txt', both([0, 1, 2]).replaceAll('hand', 'foot'));
    expect((await command(['compare', 'a.skel', 'turns.txt'], folder)).err).toContain('found "foot"');
  });

  it('tells the layout of matrices by the others if some are not numbers', async () => {
    const columns = await ownMatrices();
    const rows = columns.map((m) => [...m].map((_, i) => m[4 * (i % 4) + Math.floor(i / 4)]));
    for (const [order, matrices] of [
      ['column-major', columns],
      ['row-major', rows],
    ] as const) {
      for (const numbers of [12, 16] as const) {
        const cut = matrices.map((m) =>
          numbers === 16 ? m : m.filter((_, i) => (order === 'row-major' ? i < 12 : i % 4 < 3)),
        );
        write('lost.txt', cut.map((m, j) => m.map((v) => (j === 2 ? 'nan' : v)).join(' ')).join('\n'));
        expect(await commandJson<CompareJson>(['compare', 'a.skel', 'lost.txt'], folder, 1)).toMatchObject({
          layout: { order, numbers },
          first: { index: 2 },
          own: [2],
        });
      }
    }
    const { out } = await command(['compare', 'a.skel', 'lost.txt'], folder);
    expect(out).toContain('First wrong: joint 2 "hand", which is not a finite number.');
  });

  it('refuses a file without numbers, a missing dump, a missing character, and wrong options', async () => {
    write('notes.txt', 'These are my notes about the assignment, in words.\n');
    for (const args of [
      ['a.skel', 'notes.txt'],
      ['a.skel'],
      ['notes.txt'],
      ['a.skel', 'notes.txt', '--tolerance', '0'],
      ['a.skel', 'none.txt'],
    ]) {
      expect((await command(['compare', ...args], folder)).code, args.join(' ')).toBe(2);
    }
  });
});

describe('marrow compare of inverse kinematics', () => {
  let folder = '';
  // Three bones in a plane, from 20°, 30° and 40°.
  const LENGTHS = [1, 0.8, 0.6];
  const START = [20, 30, 40].map((angle) => (angle * Math.PI) / 180);
  const [X, Y] = [0.4, 1.7];
  const pin = ['--pin', `#2=${X},${Y},0`];
  beforeAll(() => {
    folder = mkdtempSync(join(tmpdir(), 'marrow-compare-ik-'));
    const bones = LENGTHS.map((length, j) => `${length} 0 0 1 ${20 + 10 * j} ${j < 2 ? 1 : 0}\n`);
    writeFileSync(join(folder, 'arm.axskel'), bones.join(''));
  });
  afterAll(() => rmSync(folder, { recursive: true }));

  /** Origins of the joints, and the tip. */
  function pointsOf(angles: readonly number[]): readonly (readonly [x: number, y: number])[] {
    let [x, y, turn] = [0, 0, 0];
    return [...LENGTHS, 0].map((length, j) => {
      const point = [x, y] as const;
      turn += angles[j] ?? 0;
      x -= length * Math.sin(turn);
      y += length * Math.cos(turn);
      return point;
    });
  }

  /** Jᵀe of a point: 2 is the last joint's origin, 3 the tip. */
  function stepOf(angles: readonly number[], point: number): readonly number[] {
    const points = pointsOf(angles);
    const [px, py] = points[point];
    return angles.map((_, j) => {
      const [ox, oy] = points[j];
      return j < point ? -(py - oy) * (X - px) + (px - ox) * (Y - py) : 0;
    });
  }

  const stepped = (angles: readonly number[], step: readonly number[], by: number) =>
    angles.map((angle, j) => angle + by * step[j]);

  /** World matrices by rows, as the program prints them. */
  function print(name: string, angles: readonly number[]): string {
    let turn = 0;
    const rows = LENGTHS.map((_, j) => {
      turn += angles[j];
      const [c, s] = [Math.cos(turn), Math.sin(turn)];
      const [x, y] = pointsOf(angles)[j];
      return [c, -s, 0, x, s, c, 0, y, 0, 0, 1, 0, 0, 0, 0, 1].map((value) => value.toFixed(6)).join(' ');
    });
    writeFileSync(join(folder, name), `${rows.join('\n')}\n`);
    return name;
  }

  function solved(point: number): readonly number[] {
    let angles: readonly number[] = START;
    for (let i = 0; i < 2000; i++) angles = stepped(angles, stepOf(angles, point), 0.1);
    return angles;
  }

  it('agrees with any solution, and names the wrong end effector in a sentence with its formula', async () => {
    const right = await command(['compare', 'arm.axskel', print('right.txt', solved(3)), ...pin], folder);
    expect([right.code, right.out]).toEqual([0, expect.stringContaining('The tip of joint 2 is at its target')]);
    const diverged = await command(['compare', 'arm.axskel', print('nan.txt', [1, Number.NaN, 2]), ...pin], folder);
    expect([diverged.code, diverged.err]).toEqual([1, '']);
    const wrong = await command(['compare', 'arm.axskel', print('wrong.txt', solved(2)), ...pin], folder);
    expect(wrong.code).toBe(1);
    expect(wrong.out).toContain('ik-end-effector (the tip of joint 1)');
    expect(wrong.out).toContain('You bring the tip of joint 1 to the target; it should be the tip of joint 2.');
    expect(wrong.out).toContain('J = ∂p/∂φ');
    // The same numbers are right of that tip.
    const args = ['compare', 'arm.axskel', 'wrong.txt', '--pin', `#1=${X},${Y},0`];
    expect(await commandJson(args, folder)).toMatchObject({ agrees: true, causes: [] });
  });

  it('tells steps of one solver from another after one of them', async () => {
    const step = stepOf(START, 3);
    const [first, second, third] = step.map((_, i) => pointsOf(START)[i]);
    const [px, py] = pointsOf(START)[3];
    // Three bones, so J is 3 × 3, and J·e can be computed for Jᵀe.
    const columns = [first, second, third].map(([ox, oy]) => [-(py - oy), px - ox, 0]);
    const untransposed = [0, 1, 2].map((r) => columns[0][r] * (X - px) + columns[1][r] * (Y - py));
    for (const [name, moved, by, code] of [
      ['right', step, 0.1, undefined],
      ['unscaled', step, 1, 'ik-step-unscaled'],
      ['transposed', untransposed, 0.1, 'ik-jacobian-transposed'],
      ['effector', stepOf(START, 2), 0.1, 'ik-end-effector'],
    ] as const) {
      const dump = print(`${name}.txt`, stepped(START, moved, by));
      const args = ['compare', 'arm.axskel', dump, ...pin, '--one-step'];
      const found = await commandJson<CompareJson>(args, folder, code ? 1 : 0);
      expect([name, found.agrees, found.causes.map((cause) => cause.code)]).toEqual([name, !code, code ? [code] : []]);
    }
  });

  const state = (name: string, dump: string, ...lines: readonly string[]) => {
    writeFileSync(join(folder, name), `${lines.join('\n')}\n${readFileSync(join(folder, dump), 'utf8')}`);
    return name;
  };

  it('takes the target that a dump states, as text or as JSON, and a step that it says to be one', async () => {
    print('right.txt', solved(3));
    print('wrong.txt', solved(2));
    const world = readFileSync(join(folder, 'right.txt'), 'utf8')
      .trim()
      .split('\n')
      .map((row) => row.split(' ').map(Number));
    const targets = [{ joint: 2, position: [X, Y, 0] }];
    writeFileSync(join(folder, 'right.json'), JSON.stringify({ targets, world }));
    const line = `target 2: ${X} ${Y} 0`;
    for (const dump of [
      state('a.txt', 'right.txt', line),
      state('b.txt', 'right.txt', `# target #2 = (${X}, ${Y}, 0)`),
      'right.json',
    ])
      expect(await command(['compare', 'arm.axskel', dump], folder)).toMatchObject({
        code: 0,
        out: expect.stringContaining('The tip of joint 2 is at its target'),
      });
    const wrong = await commandJson<CompareJson>(
      ['compare', 'arm.axskel', state('c.txt', 'wrong.txt', line)],
      folder,
      1,
    );
    expect(wrong).toMatchObject({ causes: [{ code: 'ik-end-effector' }], goals: [{ joint: 2, isPose: true }] });
    print('unscaled.txt', stepped(START, stepOf(START, 3), 1));
    const step = await commandJson<CompareJson>(
      ['compare', 'arm.axskel', state('d.txt', 'unscaled.txt', line, 'one step')],
      folder,
      1,
    );
    expect(step.causes.map(({ code }) => code)).toEqual(['ik-step-unscaled']);
  });

  it('judges several targets and several times, each by its own', async () => {
    print('right.txt', solved(3));
    print('wrong.txt', solved(2));
    const text = (name: string) => readFileSync(join(folder, name), 'utf8');
    const [elbowX, elbowY] = pointsOf(solved(3))[2];
    const both = `target 2: ${X} ${Y} 0\ntarget 1: ${elbowX.toFixed(6)} ${elbowY.toFixed(6)} 0\n`;
    writeFileSync(join(folder, 'both.txt'), both + text('right.txt'));
    expect(await commandJson(['compare', 'arm.axskel', 'both.txt'], folder)).toMatchObject({ agrees: true });
    const times = `target 2: ${X} ${Y} 0\ntime 0\n${text('right.txt')}time 1\n${text('wrong.txt')}`;
    writeFileSync(join(folder, 'times.txt'), times);
    expect(await commandJson(['compare', 'arm.axskel', 'times.txt'], folder, 1)).toMatchObject({
      times: [{ agrees: true }, { agrees: false }],
      causes: [{ code: 'ik-end-effector', kinds: ['world'] }],
    });
    writeFileSync(join(folder, 'steps.txt'), `one step\n${both}${text('right.txt')}`);
    const { code, err } = await command(['compare', 'arm.axskel', 'steps.txt'], folder);
    expect([code, err]).toEqual([2, expect.stringContaining('one step is judged for one alone; found 2')]);
    writeFileSync(join(folder, 'none.txt'), `target ${X} ${Y} 0\n${text('right.txt')}`);
    const none = await command(['compare', 'arm.axskel', 'none.txt'], folder);
    expect([none.code, none.err]).toEqual([2, expect.stringContaining('none.txt:1:1')]);
    expect(none.err).toContain('Expected the joint that is brought to the target');
  });

  it('says what it needs', async () => {
    const dump = print('right.txt', START);
    for (const [args, says] of [
      [['--one-step'], '--one-step goes with --pin'],
      [['--pin', 'elbow=1,2,3'], 'There is no joint "elbow"'],
      [[...pin, ...pin, '--one-step'], '--one-step takes one pin'],
    ] as const) {
      const { code, err } = await command(['compare', 'arm.axskel', dump, ...args], folder);
      expect([code, err]).toEqual([2, expect.stringContaining(says)]);
    }
  });
});
