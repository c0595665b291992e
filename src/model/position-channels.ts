/**
 * What position channels of BVH mean: they replace the OFFSET of their joint, as nearly all real files have it, or are
 * added to it, as an old exporter of Blender wrote them (files of MakeHuman). Under the wrong rule a figure falls in on
 * itself, or comes apart with every bone twice as long.
 */
import type { ChannelClip } from './clip.ts';
import { firstDofs } from './dofs.ts';
import { dofsOf, positionsOf, withParameter } from './joint-types.ts';
import type { BvhMotion, Joint, Skeleton } from './skeleton.ts';

export type Positions = BvhMotion['positions'];

const TRANSLATIONS: readonly string[] = ['tx', 'ty', 'tz'];
/** Frames that are looked at, evenly over the clip. */
const MAX_FRAMES = 16;
/** Channels that stay below this part of their OFFSET's length stay at 0. */
const NOTHING = 0.05;

/** Whether any joint has position channels, which can mean one thing or the other. */
export function hasPositions({ joints }: Skeleton): boolean {
  return joints.some(({ motion }) => positionsOf(motion));
}

/** What the skeleton's position channels are taken as now; undefined where it has none. */
export function positionsTaken({ joints }: Skeleton): Positions | undefined {
  const motion = joints.find((joint) => positionsOf(joint.motion))?.motion;
  return motion && positionsOf(motion);
}

/**
 * What the clip's values can only mean: `add` where the channels of most joints below the root stay at 0, although their
 * OFFSETs are not. (Roots say nothing: theirs move the figure about.)
 */
export function positionsMeant(skeleton: Skeleton, clip: ChannelClip | undefined): Positions {
  const first = firstDofs(skeleton);
  const tellers = skeleton.joints.flatMap(({ motion, offset, parent }, j) => {
    const length = Math.hypot(...offset);
    if (parent < 0 || !positionsOf(motion) || !(length > 0)) return [];
    const dofs = dofsOf(motion).flatMap(({ unit }, i) => (unit === 'length' ? [first[j] + i] : []));
    return [{ dofs, length, moves: false }];
  });
  const samples = clip?.samples;
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

/** The skeleton with its position channels taken so, and its pose where it was; the same object where they are. */
export function withPositions(skeleton: Skeleton, positions: Positions): Skeleton {
  let changed = false;
  const joints = skeleton.joints.map((joint): Joint => {
    const { motion, pose } = joint;
    if ((positionsOf(motion) ?? positions) === positions) return joint;
    changed = true;
    return {
      ...joint,
      motion: withParameter(motion, 'positions', positions),
      pose: pose.map((value, i) => value + shiftOf(joint, i, positions)),
    };
  });
  return changed ? { ...skeleton, joints } : skeleton;
}

/**
 * Values of a character's DOFs that stand as before, once `withPositions` was applied to its skeleton: what was a place
 * is a distance from OFFSET now, or the other way round.
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

/** What is to be added to a value of a joint's channel when it is taken so from now on. */
function shiftOf({ motion, offset }: Joint, channel: number, positions: Positions): number {
  const axis = TRANSLATIONS.indexOf(dofsOf(motion)[channel].name);
  if (axis < 0) return 0;
  return positions === 'add' ? -offset[axis] : offset[axis];
}
