/** Where the centre of mass of a body is, by the published masses of its segments. */
import { describe, expect, it } from 'vitest';
import { jointMasses } from '../../../src/evaluate/measure/mass.ts';
import { DEFAULT_MOTION, type Joint, type Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import { joint } from '../../helpers/builders.ts';

type Point = readonly [number, number, number];

/** Metres, a man of 1.75 m with his arms hanging. Of the left side; the right is its mirror image. */
const BODY: readonly (readonly [string, string, Point])[] = [
  ['Hips', '', [0, 1, 0]],
  ['Spine', 'Hips', [0, 1.2, 0]],
  ['Neck', 'Spine', [0, 1.5, 0]],
  ['Head', 'Neck', [0, 1.6, 0]],
  ['LeftArm', 'Spine', [0.2, 1.45, 0]],
  ['LeftForeArm', 'LeftArm', [0.2, 1.15, 0]],
  ['LeftHand', 'LeftForeArm', [0.2, 0.88, 0]],
  ['LeftUpLeg', 'Hips', [0.1, 0.92, 0]],
  ['LeftLeg', 'LeftUpLeg', [0.1, 0.5, 0]],
  ['LeftFoot', 'LeftLeg', [0.1, 0.08, 0]],
  ['LeftToeBase', 'LeftFoot', [0.1, 0, 0.15]],
];

/** Percent of the mass of men, and of the segment from its first joint on, as printed by de Leva (1996), table 4. */
const PRINTED: readonly (readonly [from: string, to: string, mass: number, centre: number])[] = [
  ['LeftArm', 'LeftForeArm', 2.71, 57.72],
  ['LeftForeArm', 'LeftHand', 1.62, 45.74],
  ['LeftHand', 'LeftHand', 0.61, 0],
  ['LeftUpLeg', 'LeftLeg', 14.16, 40.95],
  ['LeftLeg', 'LeftFoot', 4.33, 43.95],
  ['LeftFoot', 'LeftToeBase', 1.37, 44.15],
];
const [HEAD, TRUNK, TRUNK_CENTRE] = [6.94, 43.46, 43.1];

function body(without?: string): { readonly skeleton: Skeleton; readonly places: ReadonlyMap<string, Point> } {
  const left = BODY.filter(([name]) => name !== without && `Left${without}` !== name);
  const right = left
    .filter(([name]) => name.startsWith('Left'))
    .map(([name, above, [x, y, z]]) => [mirrored(name), mirrored(above), [-x, y, z]] as const);
  const all = [...left, ...right];
  const places = new Map<string, Point>(all.map(([name, , at]) => [name, at]));
  const joints = all.map(([name, above, at]): Joint => {
    const parent = all.findIndex(([other]) => other === above);
    const [x, y, z] = places.get(above) ?? [0, 0, 0];
    return joint(parent, { name, motion: DEFAULT_MOTION, offset: [at[0] - x, at[1] - y, at[2] - z] });
  });
  // Parents come first.
  const order = depthFirst(joints);
  return { skeleton: { name: 'body', joints: order }, places };
}

const mirrored = (name: string) => name.replace('Left', 'Right');

function depthFirst(joints: readonly Joint[]): Joint[] {
  const out: Joint[] = [];
  const visit = (index: number, parent: number) => {
    const place = out.push({ ...joints[index], parent }) - 1;
    for (const [i, child] of joints.entries()) if (child.parent === index) visit(i, place);
  };
  for (const [i, { parent: above }] of joints.entries()) if (above < 0) visit(i, -1);
  return out;
}

/** The centre of mass as joint masses have it. */
function centreOf({ skeleton, places }: ReturnType<typeof body>): number[] {
  const { weights } = jointMasses(skeleton);
  return [0, 1, 2].map((k) =>
    skeleton.joints.reduce((sum, { name }, j) => sum + weights[j] * (places.get(name)?.[k] ?? 0), 0),
  );
}

describe('the centre of mass of a body', () => {
  it('is that of its segments with the printed masses, each at the printed part of its length', () => {
    const made = body();
    const at = (name: string) => made.places.get(name) ?? [0, 0, 0];
    const along = (a: Point, b: Point, percent: number) => a.map((x, k) => x + ((b[k] - x) * percent) / 100);
    const parts = PRINTED.flatMap(([from, to, mass, percent]) =>
      [(name: string) => name, mirrored].map((side) => ({
        mass,
        centre: along(at(side(from)), at(side(to)), percent),
      })),
    );
    parts.push({ mass: HEAD, centre: [...at('Head')] });
    parts.push({ mass: TRUNK, centre: along([0, 1.45, 0], [0, 0.92, 0], TRUNK_CENTRE) });
    // The table accounts for all of a man.
    expect(parts.reduce((sum, { mass }) => sum + mass, 0)).toBeCloseTo(100, 9);
    expect(jointMasses(made.skeleton).model).toBe('segments');
    centreOf(made).forEach((x, k) => {
      expect(x).toBeCloseTo(
        parts.reduce((sum, { mass, centre }) => sum + (mass * centre[k]) / 100, 0),
        12,
      );
    });
  });

  it('is in the middle between left and right, at 57 % of the height', () => {
    const [x, y] = centreOf(body());
    expect(x).toBeCloseTo(0, 12);
    expect(y / 1.75).toBeGreaterThan(0.53);
    expect(y / 1.75).toBeLessThan(0.6);
  });

  it.each(['ToeBase', 'Head'])('has all of the mass also without a %s', (without) => {
    const made = body(without);
    const { model, weights } = jointMasses(made.skeleton);
    expect(made.skeleton.joints.some(({ name }) => name.endsWith(without))).toBe(false);
    expect(model).toBe('segments');
    expect(weights.reduce((sum, w) => sum + w, 0)).toBeCloseTo(1, 12);
  });
});
