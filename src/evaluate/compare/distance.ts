/**
 * Distances between the joints of two characters, frame by frame, for comparing two takes of a skeleton.
 *
 *     d_j(t) = | A(a_j(t)) − B(b_j(t)) |          a_j, b_j: position of joint j in the scene at time t of the transport
 *
 *     aligned    A(p)
 *     world      p                                as displayed
 *     root       p − root                         ignores placement and path
 *     turned     R⁻¹ (p − root)                   also ignores heading: R is the rotation of the root
 *
 * The root is the joint that carries the character, often the topmost one. Those of different skeletons have different
 * axes at rest, so there the second one's are turned to the first one's (`compared-roots.ts`).
 *
 * Positions are in the scene (with each character's placement and space), so distances are in metres if both characters
 * specify their unit. "In place" only affects display and is ignored.
 *
 * Frames are those of the take with the higher frame rate, over the time that both takes cover. Comparing whole poses
 * after optimal rigid alignment (Kovar) was left out: it tells how similar two poses are, not where they differ.
 */

import type { Character } from '../../model/document.ts';
import { playedTake } from '../bake.ts';
import { framesOfTake } from '../samples/key-frames.ts';
import type { Steps } from '../steps.ts';
import { rootPair } from './compared-roots.ts';
import type { JointMatch } from './joint-match.ts';
import { type Alignment, PosedJoints } from './posed-joints.ts';

/** When distances are measured: frame f is at `startSeconds + f · frameSeconds` of the transport. */
export interface FrameTimes {
  readonly startSeconds: number;
  readonly frameSeconds: number;
  /** At least 1. */
  readonly frameCount: number;
}

/** Distances of matched joints over time, in the scene's units. */
export interface Distances extends FrameTimes {
  /** The matched joints: row k belongs to `match.first[k]` and `match.second[k]`. */
  readonly match: JointMatch;
  /** A row of `frameCount` distances per pair of joints. */
  readonly values: Float32Array;
  /** Over all pairs, per frame. */
  readonly mean: Float32Array;
  readonly most: Float32Array;
  /** Over all frames, per pair. */
  readonly jointMean: Float64Array;
  readonly jointMost: Float64Array;
  readonly jointRms: Float64Array;
  /** The frame with the largest distance. */
  readonly jointMostAt: Uint32Array;
}

/** Limit of stored distances: 128 MB. Beyond it, frames are skipped evenly. */
const MAX_VALUES = 2 ** 25;

/**
 * The frames at which two characters' takes are compared; undefined if they do not overlap in time, or one of them
 * shows no take.
 * @param framesPerSecond the rate of a take that has none of its own
 */
export function commonFrames(
  a: Character,
  b: Character,
  framesPerSecond: number,
  jointCount: number,
): FrameTimes | undefined {
  const [own, other] = [framesOf(a, framesPerSecond), framesOf(b, framesPerSecond)];
  if (!own || !other) return undefined;
  const from = Math.max(own.from, other.from);
  const to = Math.min(own.to, other.to);
  const finer = other.frameSeconds < own.frameSeconds ? other : own;
  // Ends that are a frame up to rounding count as that frame.
  const first = Math.ceil((from - finer.startSeconds) / finer.frameSeconds - 1e-6);
  const last = Math.floor((to - finer.startSeconds) / finer.frameSeconds + 1e-6);
  if (!(last >= first)) return undefined;
  const step = Math.max(1, Math.ceil(((last - first + 1) * jointCount) / MAX_VALUES));
  return {
    startSeconds: finer.startSeconds + first * finer.frameSeconds,
    frameSeconds: step * finer.frameSeconds,
    frameCount: Math.floor((last - first) / step) + 1,
  };
}

/** Frames and range of the take that drives a character, in seconds of the transport. */
function framesOf(character: Character, framesPerSecond: number) {
  const take = playedTake(character);
  if (!take) return undefined;
  const offset = character.timeOffsetSeconds + (character.driver?.source.timeOffsetSeconds ?? 0);
  const { startSeconds, frameSeconds } = framesOfTake(take, framesPerSecond);
  const [from, to] = take.range;
  return { from: from - offset, to: to - offset, startSeconds: startSeconds - offset, frameSeconds };
}

/** Frames between two progress reports, a few milliseconds at most. */
const FRAMES_AT_A_TIME = 32;

/**
 * Measures in steps: yields progress, 0 to 1, every few milliseconds. Both characters need a skeleton.
 * @param turn of the second root's axes, nine numbers; absent: none
 * @throws Error if one has none
 */
export function* measureDistances(
  a: Character,
  b: Character,
  match: JointMatch,
  times: FrameTimes,
  alignment: Alignment,
  turn?: Float64Array,
): Steps<Distances> {
  const root = rootPair(a, b, match);
  const one = new PosedJoints(a, match.first, root, alignment);
  const two = new PosedJoints(b, match.second, root, alignment, turn);
  const { frameCount, startSeconds, frameSeconds } = times;
  const joints = match.first.length;
  const values = new Float32Array(joints * frameCount);
  const mean = new Float32Array(frameCount);
  const most = new Float32Array(frameCount);
  const jointMean = new Float64Array(joints);
  const jointMost = new Float64Array(joints);
  const jointRms = new Float64Array(joints);
  const jointMostAt = new Uint32Array(joints);
  for (let f = 0; f < frameCount; f++) {
    if (f % FRAMES_AT_A_TIME === 0) yield f / frameCount;
    const time = startSeconds + f * frameSeconds;
    one.pose(time);
    two.pose(time);
    let sum = 0;
    let largest = 0;
    for (let k = 0; k < joints; k++) {
      const x = one.positions[3 * k] - two.positions[3 * k];
      const y = one.positions[3 * k + 1] - two.positions[3 * k + 1];
      const z = one.positions[3 * k + 2] - two.positions[3 * k + 2];
      const squared = x * x + y * y + z * z;
      const distance = Math.sqrt(squared);
      values[k * frameCount + f] = distance;
      sum += distance;
      jointMean[k] += distance;
      jointRms[k] += squared;
      if (distance > largest) largest = distance;
      if (distance > jointMost[k]) {
        jointMost[k] = distance;
        jointMostAt[k] = f;
      }
    }
    mean[f] = joints ? sum / joints : 0;
    most[f] = largest;
  }
  for (let k = 0; k < joints; k++) {
    jointMean[k] /= frameCount;
    jointRms[k] = Math.sqrt(jointRms[k] / frameCount);
  }
  return { ...times, match, values, mean, most, jointMean, jointMost, jointRms, jointMostAt };
}
