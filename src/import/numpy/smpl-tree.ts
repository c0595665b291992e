/** The joints of SMPL's family, and a neutral adult of our own proportions. */
import type { Vec3 } from '../../math/vec3.ts';

/** Joints with their parents; offsets are those of the neutral adult, in metres, the root's its place at rest. */
export interface BodyTree {
  readonly names: readonly string[];
  readonly parents: readonly number[];
  readonly offsets: readonly Vec3[];
}

/** `name parent x y z`, of the left and of the middle; the right mirrors the left. */
const BODY: readonly (readonly [name: string, parent: number, offset: Vec3])[] = [
  ['pelvis', -1, [0, -0.22, 0.03]],
  ['left_hip', 0, [0.07, -0.09, -0.01]],
  ['right_hip', 0, [-0.07, -0.09, -0.01]],
  ['spine1', 0, [0, 0.11, -0.02]],
  ['left_knee', 1, [0.03, -0.38, 0]],
  ['right_knee', 2, [-0.03, -0.38, 0]],
  ['spine2', 3, [0, 0.135, 0.01]],
  ['left_ankle', 4, [-0.01, -0.41, -0.03]],
  ['right_ankle', 5, [0.01, -0.41, -0.03]],
  ['spine3', 6, [0, 0.055, 0.01]],
  ['left_foot', 7, [0.03, -0.06, 0.13]],
  ['right_foot', 8, [-0.03, -0.06, 0.13]],
  ['neck', 9, [0, 0.21, -0.03]],
  ['left_collar', 9, [0.08, 0.12, -0.02]],
  ['right_collar', 9, [-0.08, 0.12, -0.02]],
  ['head', 12, [0, 0.09, 0.04]],
  ['left_shoulder', 13, [0.1, 0.04, -0.01]],
  ['right_shoulder', 14, [-0.1, 0.04, -0.01]],
  ['left_elbow', 16, [0.26, -0.01, -0.02]],
  ['right_elbow', 17, [-0.26, -0.01, -0.02]],
  ['left_wrist', 18, [0.25, 0, 0]],
  ['right_wrist', 19, [-0.25, 0, 0]],
];
const HANDS: readonly (readonly [string, number, Vec3])[] = [
  ['left_hand', 20, [0.085, -0.01, -0.01]],
  ['right_hand', 21, [-0.085, -0.01, -0.01]],
];
const FACE: readonly (readonly [string, number, Vec3])[] = [
  ['jaw', 15, [0, 0, 0.02]],
  ['left_eye_smplhf', 15, [0.03, 0.07, 0.07]],
  ['right_eye_smplhf', 15, [-0.03, 0.07, 0.07]],
];
/** Where the fingers of the left hand begin, and their next joints. */
const FINGERS: readonly (readonly [string, Vec3, Vec3, Vec3])[] = [
  ['index', [0.1, -0.005, 0.025], [0.033, 0, 0], [0.023, 0, 0]],
  ['middle', [0.105, 0, 0], [0.033, 0, 0], [0.024, 0, 0]],
  ['pinky', [0.08, -0.01, -0.045], [0.018, 0, -0.005], [0.015, 0, 0]],
  ['ring', [0.095, -0.005, -0.025], [0.03, 0, 0], [0.023, 0, 0]],
  ['thumb', [0.03, -0.015, 0.03], [0.03, -0.005, 0.025], [0.03, 0, 0.02]],
];
/** The pelvis of SMPL-X at rest. */
const LOWER_PELVIS: Vec3 = [0, -0.35, 0.01];

/** How many joints the bodies of the family have. */
export type BodyCount = 24 | 52 | 55;

/** The tree of so many joints. */
export function bodyTree(count: BodyCount): BodyTree {
  const joints = [...BODY];
  if (count === 24) joints.push(...HANDS);
  if (count === 55) joints.push(...FACE);
  if (count > 24) for (const side of ['left', 'right'] as const) joints.push(...fingersOf(side, joints.length));
  if (count === 55) joints[0] = ['pelvis', -1, LOWER_PELVIS];
  return {
    names: joints.map(([name]) => name),
    parents: joints.map(([, parent]) => parent),
    offsets: joints.map(([, , offset]) => offset),
  };
}

function fingersOf(side: 'left' | 'right', first: number): (readonly [string, number, Vec3])[] {
  const sign = side === 'left' ? 1 : -1;
  return FINGERS.flatMap(([finger, ...offsets], f) =>
    offsets.map(([x, y, z], i): readonly [string, number, Vec3] => [
      `${side}_${finger}${i + 1}`,
      i === 0 ? (side === 'left' ? 20 : 21) : first + 3 * f + i - 1,
      [sign * x, y, z],
    ]),
  );
}
