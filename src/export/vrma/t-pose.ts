/**
 * A body in a T-pose: upright, facing +z, arms along x, legs straight down. From the pose in which skeletons are compared
 * for retargeting (`evaluate/retarget/reference.ts`), each joint is turned by D, in the world:
 *
 *     trunk, neck, head, collars     D = B⁻¹, with B the front and up of the body
 *     arm, forearm, hand             D = swing · D(above), to ±x          swing: the smallest rotation of the bone
 *     thigh, shin                    D = swing · D(above), to −y
 *     foot, toe                      D = B⁻¹
 *     fingers and others             D(above)
 */
import { bodiesOf, bodyFrame } from '../../evaluate/retarget/align.ts';
import type { RetargetBody } from '../../evaluate/retarget/body.ts';
import { ownReference, type PlayedTake } from '../../evaluate/retarget/reference.ts';
import { backTurnVector, copy3, multiply3, swing, turnVector } from '../../math/mat3.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import type { Space } from '../../model/space.ts';
import type { HumanBones } from './human-bones.ts';

/** A body in a T-pose, in metres, and how the scene is turned so that it faces +z. */
export interface TPose extends RetargetBody {
  /** About the vertical: 9 numbers, column-major. */
  readonly turn: Float64Array;
}

const DOWN = Float64Array.of(0, -1, 0);

/**
 * The T-pose of a skeleton.
 * @param take with an upright frame, if its file pose is none
 * @param lengths the body whose bones are as long as they are to be
 */
export function tPoseOf(
  skeleton: Skeleton,
  space: Space | undefined,
  bones: HumanBones,
  take: PlayedTake | undefined,
  lengths: RetargetBody | undefined,
): TPose {
  const { joints } = skeleton;
  const bodies = bodiesOf(
    skeleton,
    space,
    skeleton,
    space,
    joints.map((_, j) => ({ source: j, target: j })),
  );
  const posed = ownReference(bodies, take);
  const reference = { rotations: posed.rotations, points: withLengths(skeleton, posed, lengths ?? posed) };
  const frame = bodyFrame(reference, bodies, (joint) => joint);
  const upright = transposed(frame);
  const aims = aimsOf(bones);
  const turns = new Float64Array(9 * joints.length);
  const rotations = new Float64Array(9 * joints.length);
  const points = new Float64Array(3 * joints.length);
  const along = new Float64Array(3);
  const own = new Float64Array(9);
  const feet = new Set([...bones].flatMap(([bone, joint]) => (bone.endsWith('Foot') ? [joint] : [])));
  joints.forEach(({ parent }, j) => {
    const above = parent < 0 || feet.has(j) ? upright : turns.slice(9 * parent, 9 * parent + 9);
    const aim = aims.get(j);
    copy3(above, 0, turns, 9 * j);
    if (aim) {
      for (let k = 0; k < 3; k++) along[k] = reference.points[3 * aim.to + k] - reference.points[3 * j + k];
      turnVector(above, 0, along, 0, along, 0);
      if (Math.hypot(...along) > 0) {
        swing(along, 0, aim.direction, 0, own, 0);
        multiply3(own, 0, above, 0, turns, 9 * j);
      }
    }
    multiply3(turns, 9 * j, reference.rotations, 9 * j, rotations, 9 * j);
    const from = parent < 0 ? upright : turns.slice(9 * parent, 9 * parent + 9);
    for (let k = 0; k < 3; k++)
      along[k] = reference.points[3 * j + k] - (parent < 0 ? 0 : reference.points[3 * parent + k]);
    turnVector(from, 0, along, 0, along, 0);
    for (let k = 0; k < 3; k++) points[3 * j + k] = along[k] + (parent < 0 ? 0 : points[3 * parent + k]);
  });
  standAt(points, bones, lowestOf(reference.points, bones));
  return { rotations, points, turn: headingOf(frame) };
}

/** Where joints are if each keeps its rotation, and is where it is to its parent in another body. */
function withLengths({ joints }: Skeleton, { rotations, points }: RetargetBody, other: RetargetBody): Float64Array {
  const out = points.slice();
  const along = new Float64Array(3);
  joints.forEach(({ parent }, j) => {
    if (parent < 0) return;
    for (let k = 0; k < 3; k++) along[k] = other.points[3 * j + k] - other.points[3 * parent + k];
    backTurnVector(other.rotations, 9 * parent, along, 0, along, 0);
    turnVector(rotations, 9 * parent, along, 0, along, 0);
    for (let k = 0; k < 3; k++) out[3 * j + k] = out[3 * parent + k] + along[k];
  });
  return out;
}

interface Aim {
  readonly to: number;
  readonly direction: Float64Array;
}

/** Where bones of arms and legs point. */
function aimsOf(bones: HumanBones): ReadonlyMap<number, Aim> {
  const aims = new Map<number, Aim>();
  const add = (from: string, to: string, direction: Float64Array) => {
    const [joint, next] = [bones.get(from), bones.get(to)];
    if (joint !== undefined && next !== undefined) aims.set(joint, { to: next, direction });
  };
  for (const [side, x] of [
    ['left', 1],
    ['right', -1],
  ] as const) {
    const out = Float64Array.of(x, 0, 0);
    add(`${side}UpperArm`, `${side}LowerArm`, out);
    add(`${side}LowerArm`, `${side}Hand`, out);
    add(`${side}Hand`, `${side}MiddleProximal`, out);
    add(`${side}UpperLeg`, `${side}LowerLeg`, DOWN);
    add(`${side}LowerLeg`, `${side}Foot`, DOWN);
  }
  return aims;
}

/** How high above the ground the lowest bone is; 0 if it is nowhere near it. */
function lowestOf(points: Float64Array, bones: HumanBones): number {
  const heights = [...bones.values()].map((joint) => points[3 * joint + 1]);
  const lowest = Math.min(...heights);
  return Math.abs(lowest) < NEAR_GROUND * (Math.max(...heights) - lowest) ? lowest : 0;
}

/** Of the height of a body. */
const NEAR_GROUND = 0.2;

/** Moves a body so that its hips are above the origin, and its lowest bone at a height. */
function standAt(points: Float64Array, bones: HumanBones, height: number): void {
  const hips = 3 * (bones.get('hips') ?? 0);
  const lowest = Math.min(...[...bones.values()].map((joint) => points[3 * joint + 1]));
  const shift = [-points[hips], height - lowest, -points[hips + 2]];
  for (let i = 0; i < points.length; i++) points[i] += shift[i % 3];
}

function transposed(m: Float64Array): Float64Array {
  return Float64Array.from(m, (_, i) => m[3 * (i % 3) + Math.floor(i / 3)]);
}

/** The turn about the vertical after which a front is +z. */
function headingOf(frame: Float64Array): Float64Array {
  const [x, z] = [frame[6], frame[8]];
  const length = Math.hypot(x, z) || 1;
  const [sin, cos] = [-x / length, (length > 0 ? z : 1) / length];
  return Float64Array.of(cos, 0, -sin, 0, 1, 0, sin, 0, cos);
}
