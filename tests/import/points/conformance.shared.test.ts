/** Files of points against separately computed positions. */
import { expect, it } from 'vitest';
import { metresPerUnit } from '../../../src/evaluate/space/metres.ts';
import { eachWorld, labCases } from '../../helpers/lab.ts';
import { errorIn, placesIn, pointsIn } from '../../helpers/points.ts';
import { conformance, describeShared, sharedBytes } from '../../helpers/shared.ts';

interface PointsCase {
  readonly name: string;
  readonly kind: string;
  readonly files: readonly string[];
  readonly labels: readonly string[];
  readonly frames: number;
  readonly fps: number;
  readonly unit: string;
  readonly tolerance: number;
  readonly at: Readonly<Record<string, (number[] | null)[]>>;
}

const ENDS = /\.(c3d|trc|csv)$/;

describeShared('files of points', () => {
  const { cases } = conformance<{ readonly cases: readonly PointsCase[] }>('lab.json');
  const points = cases.filter(({ kind }) => kind === 'points');
  const { cases: all, malformed } = labCases();

  it.each(points)('$name: labels, frames, rate, unit and places are those of the file', async (given) => {
    const [file] = given.files;
    const { character, take } = await pointsIn(file, sharedBytes(`data/lab/${file}`));
    expect(character.skeleton.joints.map(({ name }) => name)).toEqual(given.labels);
    expect(take.samples?.frameCount).toBe(given.frames);
    expect(1 / (take.samples?.frameSeconds ?? 0)).toBeCloseTo(given.fps, 9);
    const { space } = character;
    expect(space && metresPerUnit(space.space)).toBe(0.001);
    expect(space?.space.known).toBe(given.unit === '' ? 'guessed' : 'stated');
    expect(space?.space.up).toBe('y');
    const places = placesIn(character);
    const size = Math.max(
      ...Object.values(given.at)
        .flat(2)
        .map((v) => Math.abs(v ?? 0)),
    );
    for (const [frame, wanted] of Object.entries(given.at)) {
      wanted.forEach((position, p) => {
        const found = places[Number(frame)][p];
        expect(found === null).toBe(position === null);
        position?.forEach((v, k) => {
          expect(Math.abs(v - (found?.[k] ?? Number.NaN))).toBeLessThan(given.tolerance * size);
        });
      });
    }
  });

  it.each(all.filter(({ kind, files }) => kind === 'fitted' && ENDS.test(files[0])))(
    '$name: bones fit the points as well as those of the reference',
    async (given) => {
      const [file] = given.files;
      const { character, take, diagnostics } = await pointsIn(file, sharedBytes(`data/lab/${file}`));
      expect(character.skeleton.joints.map(({ name }) => name)).toEqual(given.joints);
      expect(take.samples?.frameCount).toBe(given.frames);
      expect(1 / (take.samples?.frameSeconds ?? 0)).toBeCloseTo(given.fps, 9);
      const off: number[] = [];
      eachWorld(character.skeleton, take, (world, _dofs, frame) => {
        given.at[frame]?.positions?.forEach((position, j) => {
          off.push(Math.hypot(...position.map((v, k) => v - world[16 * j + 12 + k])));
        });
      });
      const told = diagnostics.find(({ code }) => code === 'bones-fitted')?.message ?? '';
      expect(Number(/are (\S+) off/.exec(told)?.[1])).toBeLessThan(1.25 * (given.mean_error ?? 0));
      expect(Math.max(...off)).toBeLessThan(1.5 * (given.max_error ?? 0));
    },
  );

  it.each(malformed.filter(({ file }) => ENDS.test(file)))('the broken file $file brings an error', async (given) => {
    expect(await errorIn(given.file, sharedBytes(`data/lab/${given.file}`))).toMatch(/\.$/);
  });
});
