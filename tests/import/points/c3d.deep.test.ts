import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import type { Processor } from '../../../src/import/points/c3d-parameters.ts';
import { c3dOf, type MadeC3d, type PointFrame } from '../../helpers/c3d.ts';
import { errorIn, placesIn, pointsIn } from '../../helpers/points.ts';

const LABELS = ['LASI', 'RASI', 'Left knee'];
const FRAMES: readonly PointFrame[] = [
  [[1, 1000, 3], null, [4.5, 500, -6]],
  [[2, 1001, 3], [7, 990, 9], null],
  [[3, 1002, 3], [8, 991, 9], null],
];

async function read(made: Partial<MadeC3d> = {}) {
  return pointsIn('walk.c3d', c3dOf({ labels: LABELS, frames: FRAMES, ...made }));
}

describe('a C3D', () => {
  const forms = (['intel', 'dec', 'mips'] as const).flatMap((processor) =>
    [undefined, 0.5].map((scale): [Processor, number | undefined] => [processor, scale]),
  );

  it.each(forms)(
    'of %s with the scale %s has its points where they are, and none where one is missing',
    async (...form) => {
      const [processor, scale] = form;
      const { character, take } = await read({ processor, analog: 3, first: 41, ...(scale && { scale }) });
      expect(placesIn(character)).toEqual(FRAMES);
      expect(character.skeleton.joints.map(({ name }) => name)).toEqual(LABELS);
      expect(take.samples?.frameSeconds).toBe(0.01);
      expect(character.space?.space).toMatchObject({ unit: 'millimetres', up: 'y', known: 'stated' });
    },
  );

  it('without parameters is read by its head', async () => {
    const without = ['POINT:USED', 'POINT:SCALE', 'POINT:RATE', 'POINT:UNITS', 'POINT:LABELS', 'POINT:DATA_START'];
    const { character, take, diagnostics } = await read({ without, rate: 50 });
    expect(placesIn(character)).toEqual(FRAMES);
    expect(character.skeleton.joints.map(({ name }) => name)).toEqual(['point1', 'point2', 'point3']);
    expect(take.samples?.frameSeconds).toBe(0.02);
    expect(diagnostics.map(({ code }) => code)).toContain('unit-guessed');
  });

  it.each([59.94, 29.97, 0.1, 1 / 3])('has the rate %d as it is meant, which is stored with 24 bits', async (rate) => {
    const { take } = await read({ rate });
    const [meant] = [Number(Math.fround(rate).toPrecision(7)), Math.fround(rate)].filter(
      (r) => Math.fround(r) === Math.fround(rate),
    );
    expect(take.samples?.frameSeconds).toBe(1 / meant);
    if (rate !== 1 / 3) expect(meant).toBe(rate);
  });

  it('with missing or double labels calls these points after their numbers', async () => {
    const { character } = await read({ labels: ['A', '', 'A'] });
    expect(character.skeleton.joints.map(({ name }) => name)).toEqual(['A', 'point2', 'point3']);
  });

  it('with more than 255 points has all of their labels', async () => {
    const labels = Array.from({ length: 600 }, (_, p) => `M${p}`);
    const frame: PointFrame = labels.map((_, p) => [p, 2 * p, -p]);
    const { character } = await read({ labels, frames: [frame] });
    expect(character.skeleton.joints.map(({ name }) => name)).toEqual(labels);
    expect(placesIn(character)[0][599]).toEqual([599, 1198, -599]);
  });

  it('with more than 65,535 frames has the frames that its parameters count', async () => {
    const frames = Array.from({ length: 65_600 }, (_, f): PointFrame => [[f, 0, 0]]);
    const { character, take } = await read({ labels: ['A'], frames, isLong: true });
    expect(take.samples?.frameCount).toBe(65_600);
    expect(take.samples?.values[4 * 65_599]).toBe(65_599);
    expect(character.skeleton.joints).toHaveLength(1);
  });

  it('keeps a point that is missing where it was, and one that is never there in the middle of the others', async () => {
    const frames = FRAMES.map((frame): PointFrame => [...frame, null]);
    const { take, character } = await read({ labels: [...LABELS, 'lost'], frames });
    const { values } = take.samples ?? { values: [] };
    expect(Array.from(values.slice(16 + 8, 16 + 12))).toEqual([4.5, 500, -6, 0]);
    expect(Array.from(values.slice(4, 8))).toEqual([7, 990, 9, 0]);
    const middle = [(1 + 7 + 4.5) / 3, (1000 + 990 + 500) / 3, (3 + 9 - 6) / 3];
    expect(Array.from(values.slice(12, 15))).toEqual(middle);
    expect(placesIn(character).every((frame) => frame[3] === null)).toBe(true);
  });

  it('whose labels are those of a known tree has joints with bones', async () => {
    const names = ['Nose', 'left-eye', 'RIGHT EYE', 'left ear', 'right ear'];
    const pairs = ['shoulder', 'elbow', 'wrist', 'hip', 'knee', 'ankle'].flatMap((part) => [
      `Left_${part}`,
      `right ${part}`,
    ]);
    const labels = ['extra', ...names, ...pairs];
    const frame = (f: number): PointFrame => labels.map((_, p) => [10 * p + f, 100 * p, (p * p) % 7]);
    const { character, diagnostics } = await read({ labels, frames: [frame(0), frame(1)] });
    expect(character.skeleton.joints.map(({ name }) => name)).toContain('left_shoulder');
    expect(character.skeleton.joints[0].name).toBe('pelvis');
    const told = diagnostics.map(({ message }) => message).join(' ');
    expect(told).toContain('those of COCO');
    expect(told).toContain('extra');
  });
});

describe('a C3D that is damaged brings an error that', () => {
  const good = () => c3dOf({ labels: LABELS, frames: FRAMES });
  const changed = (at: number, ...values: readonly number[]) => {
    const bytes = good();
    bytes.set(values, at);
    return errorIn('x.c3d', bytes);
  };

  it.each([
    ['names the key', 1, [0x51], /second byte is 80, found 81/],
    ['names the block of parameters', 0, [99], /parameters at block 99/],
    ['names the processor', 512 + 3, [87], /84 \(Intel\), 85 \(DEC\) or 86 \(MIPS\), found 87/],
    ['says that a record leads back', 512 + 4 + 7, [0xff, 0xff], /POINT leads back/],
    ['says that a record leads out of the file', 512 + 4 + 7, [0xff, 0x7f], /leads to byte/],
  ])('%s', async (_, at, values, message) => {
    expect(await changed(at, ...values)).toMatch(message);
  });

  it('counts the frames of one that is cut off', async () => {
    expect(await errorIn('x.c3d', good().slice(0, -500))).toMatch(/Expected 3 frames, found 0: the file is cut off/);
  });

  it('says so without points, and without frames', async () => {
    expect(await errorIn('x.c3d', c3dOf({ labels: [], frames: [[]] }))).toMatch(/analog samples only/);
    expect(await errorIn('x.c3d', c3dOf({ labels: ['A'], frames: [], first: 0 }))).toMatch(/Expected frames/);
  });

  it('is a sentence, whatever bytes are changed or missing', async () => {
    const bytes = good();
    const change = fc.tuple(fc.nat(bytes.length - 1), fc.nat(255));
    await fc.assert(
      fc.asyncProperty(fc.array(change, { maxLength: 4 }), fc.nat(bytes.length), async (changes, length) => {
        const other = bytes.slice(0, length);
        for (const [at, value] of changes) if (at < length) other[at] = value;
        const read = await pointsIn('x.c3d', other).catch((error: Error) => error.message);
        if (typeof read === 'string') expect(read).toMatch(/\.$/);
      }),
    );
  });
});
