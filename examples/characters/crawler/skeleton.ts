/**
 * The crawler's skeleton: a plump beetle facing +z on six legs, each of three joints.
 *
 *     root ─ body ─┬─ abdomen                     leg: coxa (turns about y) ─ femur (rz lifts) ─ tibia (rz bends)
 *                  ├─ head ─ feelers 1–2 (×2)     left legs run along their own +x, right ones along −x
 *                  └─ coxa ─ femur ─ tibia (×6)
 */
import type { Vec3 } from '../../../src/math/vec3.ts';
import { type BallJointPlan, boxAbout, buildSkeleton } from '../shape/skeletons.ts';

export const BODY_HEIGHT = 0.36;
export const COXA = 0.09;
export const FEMUR = 0.25;
export const TIBIA = 0.43;

/** One leg: its attachment in the body's space, its direction, and when it steps. */
export interface LegPlan {
  readonly name: string;
  readonly side: 1 | -1;
  readonly hip: Vec3;
  /** Radians forward of straight out. */
  readonly azimuth: number;
  /** Lag in a stride. Alternate legs step together, the front slightly before the back. */
  readonly lag: number;
}

export const LEGS: readonly LegPlan[] = ([1, -1] as const).flatMap((side) =>
  [0.62, 0, -0.66].map(
    (azimuth, row): LegPlan => ({
      name: `${side > 0 ? 'l' : 'r'}${row + 1}`,
      side,
      hip: [[0.2, 0.25, 0.21][row] * side, -0.04, [0.21, 0.0, -0.2][row]],
      azimuth,
      lag: ((row + (side > 0 ? 0 : 1)) % 2) * 0.5 + row * 0.04,
    }),
  ),
);

const legs = LEGS.flatMap(({ name, side, hip, azimuth }): BallJointPlan[] => [
  {
    name: `coxa_${name}`,
    parent: 'body',
    offset: hip,
    pose: [0, Number((-side * azimuth).toFixed(4)) + 0, 0],
    box: boxAbout([(side * COXA) / 2, 0, 0], [COXA / 2, 0.04, 0.04]),
    limits: [
      [0, 0],
      [-1.6, 1.6],
      [0, 0],
    ],
  },
  {
    name: `femur_${name}`,
    parent: `coxa_${name}`,
    offset: [side * COXA, 0, 0],
    pose: [0, 0, side * 0.6],
    box: boxAbout([(side * FEMUR) / 2, 0, 0], [FEMUR / 2, 0.035, 0.035]),
    limits: [
      [0, 0],
      [0, 0],
      [-1.5, 1.5],
    ],
  },
  {
    name: `tibia_${name}`,
    parent: `femur_${name}`,
    offset: [side * FEMUR, 0, 0],
    pose: [0, 0, side * -1.95],
    box: boxAbout([(side * TIBIA) / 2, 0, 0], [TIBIA / 2, 0.025, 0.025]),
    limits: [[0, 0], [0, 0], side > 0 ? [-2.8, 0] : [0, 2.8]],
  },
]);

const feelers = ([1, -1] as const).flatMap((side): BallJointPlan[] => {
  const suffix = side > 0 ? '_l' : '_r';
  return [
    {
      name: `feeler_1${suffix}`,
      parent: 'head',
      offset: [0.07 * side, 0.16, 0.1],
      box: boxAbout([0.03 * side, 0.1, 0.02], [0.04, 0.1, 0.03]),
    },
    {
      name: `feeler_2${suffix}`,
      parent: `feeler_1${suffix}`,
      offset: [0.06 * side, 0.2, 0.04],
      box: boxAbout([0.05 * side, 0.06, 0.05], [0.05, 0.06, 0.05]),
    },
  ];
});

export const CRAWLER_SKELETON = buildSkeleton('crawler', [
  {
    name: 'root',
    offset: [0, BODY_HEIGHT, 0],
    box: boxAbout([0, 0, 0], [0.03, 0.03, 0.03]),
    limits: [[0, 0], undefined, [0, 0]],
  },
  { name: 'body', parent: 'root', offset: [0, 0, 0], box: boxAbout([0, 0.05, 0.05], [0.24, 0.14, 0.22]) },
  { name: 'abdomen', parent: 'body', offset: [0, 0.02, -0.12], box: boxAbout([0, 0.05, -0.2], [0.26, 0.16, 0.22]) },
  { name: 'head', parent: 'body', offset: [0, 0.04, 0.27], box: boxAbout([0, 0.04, 0.12], [0.17, 0.15, 0.13]) },
  ...feelers,
  ...legs,
]);
