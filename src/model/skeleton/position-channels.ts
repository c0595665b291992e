/**
 * The meaning of BVH position channels: they replace the OFFSET of their joint, as in nearly all real files, or are
 * added to it, as an old Blender exporter wrote them (MakeHuman files). Under the wrong rule a character collapses, or
 * comes apart with every bone twice as long.
 */
import type { Take } from '../takes/take.ts';
import { firstDofs } from './dofs.ts';
import { dofsOf, positionsOf, withParameter } from './joint-types.ts';
import type { BvhMotion, Joint, Skeleton } from './skeleton.ts';

/** Whether BVH position channels `replace` the offset of their joint or `add` to it. */
export type Positions = BvhMotion['positions'];

const TRANSLATIONS: readonly string[] = ['tx', 'ty', 'tz'];
/** Frames that are inspected, evenly spread over the take. */
const MAX_FRAMES = 16;
/** Channels below this fraction of their OFFSET's length count as 0. */
const NOTHING = 0.05;

/** The current meaning of the skeleton's position channels; undefined if it has none. */
export function positionsTaken({ joints }: Skeleton): Positions | undefined {
  const motion = joints.find((joint) => positionsOf(joint.motion))?.motion;
  return motion && positionsOf(motion);
}

/**
 * The meaning that fits the take's values: `add` if most joints below the root have channels that stay at 0 although
 * their OFFSETs don't. (Roots tell nothing: theirs move the character.)
 */
export function positionsMeant(skeleton: Skeleton, take: Take | undefined): Positions {
  const first = firstDofs(skeleton);
  const tellers = skeleton.joints.flatMap(({ motion, offset, parent }, j) => {
    const length = Math.hypot(...offset);
    if (parent < 0 || !positionsOf(motion) || !(length > 0)) return [];
    const dofs = dofsOf(motion).flatMap(({ unit }, i) => (unit === 'length' ? [first[j] + i] : []));
    return [{ dofs, length, moves: false }];
  });
  const samples = take?.samples;
  if (!samples || tellers.length === 0) return 'replace';
  const { values, scales, frameCount, firstChannel } = samples;
  const count = Math.min(MAX_FRAMES, frameCount);
  for (let i = 0; i < count; i++) {
    const row = scales.length * Math.round((i * (frameCount - 1)) / Math.max(1, count - 1)) - firstChannel;
    for (const teller of tellers) {
      teller.moves ||= teller.dofs.some((dof) => Math.abs(values[row + dof]) > NOTHING * teller.length);
    }
  }
  return tellers.filter(({ moves }) => !moves).length > tellers.length / 2 ? 'add' : 'replace';
}

/**
 * The skeleton with this meaning of position channels and its pose unchanged in space; the same object if nothing
 * changes.
 */
export function withPositions(skeleton: Skeleton, positions: Positions): Skeleton {
  const isOther = ({ motion }: Joint) => (positionsOf(motion) ?? positions) !== positions;
  if (!skeleton.joints.some(isOther)) return skeleton;
  const joints = skeleton.joints.map((joint): Joint => {
    if (!isOther(joint)) return joint;
    const { motion, pose } = joint;
    return {
      ...joint,
      motion: withParameter(motion, 'positions', positions),
      pose: pose.map((value, i) => value + shiftOf(joint, i, positions)),
    };
  });
  return { ...skeleton, joints };
}

/**
 * DOF values that keep the pose after `withPositions` was applied to the skeleton: positions become distances from
 * OFFSET, or the reverse.
 */
export function poseForPositions(skeleton: Skeleton, pose: readonly number[], positions: Positions): number[] {
  const next = [...pose];
  const first = firstDofs(skeleton);
  skeleton.joints.forEach((joint, j) => {
    const { motion } = joint;
    if ((positionsOf(motion) ?? positions) === positions) return;
    dofsOf(motion).forEach((_, i) => {
      next[first[j] + i] += shiftOf(joint, i, positions);
    });
  });
  return next;
}

/** The number to add to a value of a joint's channel to keep its position under the new meaning. */
function shiftOf({ motion, offset }: Joint, channel: number, positions: Positions): number {
  const axis = TRANSLATIONS.indexOf(dofsOf(motion)[channel].name);
  if (axis < 0) return 0;
  return positions === 'add' ? -offset[axis] : offset[axis];
}
