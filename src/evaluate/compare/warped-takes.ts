/** The distance of two takes with time warp (`time-warp.ts`), each over its whole length. */
import type { Character } from '../../model/document.ts';
import { measuredFrames } from '../measure/tracks.ts';
import { type Steps, within } from '../steps.ts';
import { rootPair } from './compared-roots.ts';
import type { JointMatch } from './joint-match.ts';
import { type Alignment, PosedJoints } from './posed-joints.ts';
import { type TimeWarp, timeWarp } from './time-warp.ts';

/** More frames are skipped evenly: the work grows with their square. */
const MAX_FRAMES = 600;

/**
 * Measures in steps: yields progress, 0 to 1. Undefined if one of them shows no take, or no joints match.
 * @param framesPerSecond the rate of a take that has only keys
 * @param turn of the second root's axes, nine numbers; absent: none
 */
export function* warpTakes(
  a: Character,
  b: Character,
  match: JointMatch,
  alignment: Alignment,
  framesPerSecond: number,
  turn?: Float64Array,
): Steps<TimeWarp | undefined> {
  if (!match.first.length) return undefined;
  const root = rootPair(a, b, match);
  const one = positionsOf(a, new PosedJoints(a, match.first, root, alignment), framesPerSecond);
  yield 0.1;
  const two = positionsOf(b, new PosedJoints(b, match.second, root, alignment, turn), framesPerSecond);
  yield 0.2;
  return one && two && (yield* within(timeWarp(one, two, 3 * match.first.length), 0.2, 1));
}

/** x y z of each joint, frame by frame. */
function positionsOf(character: Character, joints: PosedJoints, framesPerSecond: number): Float64Array | undefined {
  const frames = measuredFrames(character, framesPerSecond);
  if (!frames) return undefined;
  const { startSeconds, frameSeconds, frameCount } = frames;
  const step = Math.ceil(frameCount / MAX_FRAMES);
  const count = Math.floor((frameCount - 1) / step) + 1;
  const width = joints.positions.length;
  const out = new Float64Array(width * count);
  for (let f = 0; f < count; f++) {
    joints.pose(startSeconds + f * step * frameSeconds);
    out.set(joints.positions, width * f);
  }
  return out;
}
