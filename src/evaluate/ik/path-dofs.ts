/** What of a motion path can be dragged: the DOFs that move its joint, and the times at which they have keys or samples. */

import { type Character, shownTake } from '../../model/document.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { USUAL_FRAMES_PER_SECOND } from '../../model/takes/take.ts';
import { compileSkeleton } from '../kinematics.ts';
import { framesOfTake } from '../samples/key-frames.ts';
import { bendsWith, limbOf } from './limb.ts';

/** As a fraction of a frame; relative for keys. */
const SLACK = 1e-6;

/**
 * The DOFs that move a joint along its path, ascending: those of its limb; for the root, and for a joint that carries
 * limbs, the root's translation.
 */
export function dofsOnPath(skeleton: Skeleton, joint: number): readonly number[] {
  const { travel, firstDof, jointCount } = compileSkeleton(skeleton);
  const limb = limbOf(skeleton, joint);
  if (limb === 'body') return [...travel].filter((dof) => dof >= 0).sort((a, b) => a - b);
  const bends = bendsWith(skeleton, limb);
  return Array.from({ length: firstDof[jointCount] }, (_, dof) => dof).filter(bends);
}

/** Times on a path, in seconds of the transport, ascending. */
export interface PathTimes {
  /** Whole frames of the take; none if there are too many. */
  readonly frames: readonly number[];
  /** Those of keys; none if there are too many. */
  readonly keys: readonly number[];
  /** Whether frames are samples of DOFs on the path, which can be dragged as keys can. */
  readonly isSampled: boolean;
}

/**
 * The times of a joint's path within a range of the transport. Keys are those of the active layer; a retargeted
 * character has none, as it follows another one's.
 *
 * @param most how many of either are listed at most
 */
export function timesOnPath(
  character: Character,
  joint: number,
  [start, end]: readonly [number, number],
  most: number,
): PathTimes {
  const { skeleton, timeOffsetSeconds } = character;
  const take = shownTake(character);
  if (!skeleton || !take || character.driver) return { frames: [], keys: [], isSampled: false };
  const own = new Set(dofsOnPath(skeleton, joint));
  const channels = take.channels.filter((_, dof) => own.has(dof));
  const keys = new Set<number>();
  const slack = SLACK * (end - start);
  for (const channel of channels) {
    if (channel.kind !== 'keys') continue;
    for (const own of channel.times) {
      const time = own - timeOffsetSeconds;
      if (time >= start - slack && time <= end + slack) keys.add(time);
    }
  }
  const { startSeconds, frameSeconds, frameCount } = framesOfTake(take, USUAL_FRAMES_PER_SECOND);
  const from = startSeconds - timeOffsetSeconds;
  const first = Math.max(0, Math.ceil((start - from) / frameSeconds - SLACK));
  const last = Math.min(frameCount - 1, Math.floor((end - from) / frameSeconds + SLACK));
  const count = last - first + 1;
  return {
    frames:
      count > 0 && count <= most ? Array.from({ length: count }, (_, k) => from + (first + k) * frameSeconds) : [],
    keys: keys.size <= most ? [...keys].sort((a, b) => a - b) : [],
    isSampled: channels.some(({ kind }) => kind === 'samples'),
  };
}
