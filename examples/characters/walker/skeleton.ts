/**
 * The walker's skeleton: a small upright creature facing +z, y up, its left on +x, about 2 units tall.
 *
 *     root ─ hips ─┬─ spine ─ chest ─┬─ neck ─ head ─ ears
 *     (turns)      ├─ tail 1–4       ├─ pack, scarf 1–2
 *                  └─ thigh ─ shin ─ foot ─ toe (×2)   └─ upper arm ─ forearm ─ hand (×2)
 *
 * `root` only translates and turns about y, so that all other joints repeat with every stride. Joints are straight at
 * 0: arms out to the sides (file pose: half lowered), legs down.
 */
import type { Vec3 } from '../../../src/math/vec3.ts';
import { type BallJointPlan, boxAbout, buildSkeleton } from '../shape/skeletons.ts';

/** Lengths that the gait needs too. */
export const HIP_HEIGHT = 0.66;
export const THIGH_OFFSET: Vec3 = [0.105, -0.02, 0];
export const THIGH = 0.27;
export const SHIN = 0.255;
/** Height of the ankle above the sole. */
export const ANKLE_HEIGHT = 0.115;
export const TOE_OFFSET: Vec3 = [0, -0.085, 0.11];
/** Contact point of the heel, in the foot's space. */
export const HEEL_CONTACT: Vec3 = [0, -ANKLE_HEIGHT, -0.095];
export const UPPER_ARM = 0.2;
export const FOREARM = 0.19;
/** How far the arms are lowered in the file pose, in which the skin is bound. */
const ARM_DROOP = 0.8;

const STIFF: readonly [number, number] = [0, 0];

function sides(plan: (side: 1 | -1, suffix: '_l' | '_r') => readonly BallJointPlan[]): readonly BallJointPlan[] {
  return [...plan(1, '_l'), ...plan(-1, '_r')];
}

const mirrored = (min: number, max: number, side: number) =>
  side > 0 ? ([min, max] as const) : ([0 - max, 0 - min] as const);

const arms = sides((side, s) => [
  {
    name: `upper_arm${s}`,
    parent: 'chest',
    offset: [0.17 * side, 0.1, 0],
    pose: [0, 0, -ARM_DROOP * side],
    box: boxAbout([(UPPER_ARM / 2) * side, 0, 0], [UPPER_ARM / 2, 0.04, 0.04]),
    limits: [[-1.8, 1.8], mirrored(-2.2, 1.2, side), mirrored(-1.7, 1.4, side)],
  },
  {
    name: `forearm${s}`,
    parent: `upper_arm${s}`,
    offset: [UPPER_ARM * side, 0, 0],
    box: boxAbout([(FOREARM / 2) * side, 0, 0], [FOREARM / 2, 0.035, 0.035]),
    limits: [[-1.5, 1.5], mirrored(-2.4, 0, side), STIFF],
  },
  {
    name: `hand${s}`,
    parent: `forearm${s}`,
    offset: [FOREARM * side, 0, 0],
    box: boxAbout([0.06 * side, 0, 0], [0.06, 0.03, 0.045]),
    limits: [STIFF, [-0.8, 0.8], [-1.2, 1.2]],
  },
]);

const legs = sides((side, s) => [
  {
    name: `thigh${s}`,
    parent: 'hips',
    offset: [THIGH_OFFSET[0] * side, THIGH_OFFSET[1], THIGH_OFFSET[2]],
    box: boxAbout([0, -THIGH / 2, 0], [0.05, THIGH / 2, 0.05]),
    limits: [
      [-2, 1],
      [-1, 1],
      [-0.9, 0.9],
    ],
  },
  {
    name: `shin${s}`,
    parent: `thigh${s}`,
    offset: [0, -THIGH, 0],
    box: boxAbout([0, -SHIN / 2, 0], [0.04, SHIN / 2, 0.04]),
    limits: [[0, 2.5], STIFF, STIFF],
  },
  {
    name: `foot${s}`,
    parent: `shin${s}`,
    offset: [0, -SHIN, 0],
    box: { min: [-0.06, -0.115, -0.1], max: [0.06, 0.01, 0.11] },
    limits: [
      [-1.3, 1.3],
      [-0.9, 0.9],
      [-0.8, 0.8],
    ],
  },
  {
    name: `toe${s}`,
    parent: `foot${s}`,
    offset: TOE_OFFSET,
    box: { min: [-0.06, -0.03, 0], max: [0.06, 0.04, 0.1] },
    limits: [[-1.2, 0.6], STIFF, STIFF],
  },
]);

const TAIL: readonly Vec3[] = [
  [0, -0.02, -0.17],
  [0, -0.07, -0.19],
  [0, 0.05, -0.2],
  [0, 0.15, -0.13],
];

const tail = TAIL.map((offset, i): BallJointPlan => {
  const next = TAIL[i + 1] ?? [0, 0.2, -0.04];
  return {
    name: `tail_${i + 1}`,
    parent: i === 0 ? 'hips' : `tail_${i}`,
    offset,
    box: boxAbout([0, next[1] / 2, next[2] / 2], [0.04, Math.abs(next[1]) / 2 + 0.02, Math.abs(next[2]) / 2]),
  };
});

export const WALKER_SKELETON = buildSkeleton('walker', [
  {
    name: 'root',
    offset: [0, HIP_HEIGHT, 0],
    box: boxAbout([0, 0, 0], [0.03, 0.03, 0.03]),
    limits: [STIFF, undefined, STIFF],
  },
  { name: 'hips', parent: 'root', offset: [0, 0, 0], box: boxAbout([0, 0.02, 0], [0.15, 0.07, 0.1]) },
  { name: 'spine', parent: 'hips', offset: [0, 0.12, 0], box: boxAbout([0, 0.07, 0], [0.13, 0.06, 0.09]) },
  { name: 'chest', parent: 'spine', offset: [0, 0.14, 0], box: boxAbout([0, 0.08, 0], [0.15, 0.08, 0.1]) },
  { name: 'neck', parent: 'chest', offset: [0, 0.18, -0.01], box: boxAbout([0, 0.05, 0], [0.04, 0.05, 0.04]) },
  {
    name: 'head',
    parent: 'neck',
    offset: [0, 0.1, 0.01],
    box: boxAbout([0, 0.36, 0.02], [0.36, 0.32, 0.32]),
    limits: [
      [-0.9, 0.9],
      [-1.4, 1.4],
      [-0.7, 0.7],
    ],
  },
  ...sides((side, s) => [
    {
      name: `ear${s}`,
      parent: 'head',
      offset: [0.27 * side, 0.6, 0],
      box: boxAbout([0.05 * side, 0.12, 0], [0.09, 0.12, 0.03]),
    },
  ]),
  { name: 'scarf_1', parent: 'chest', offset: [0.09, 0.17, 0.17], box: boxAbout([0, -0.07, 0.02], [0.05, 0.07, 0.01]) },
  { name: 'scarf_2', parent: 'scarf_1', offset: [0.01, -0.15, 0.04], box: boxAbout([0, -0.07, 0], [0.05, 0.07, 0.01]) },
  { name: 'pack', parent: 'chest', offset: [0, 0.04, -0.2], box: boxAbout([0, -0.02, -0.09], [0.16, 0.17, 0.09]) },
  ...arms,
  ...tail,
  ...legs,
]);
