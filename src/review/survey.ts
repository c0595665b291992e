/** A first look at a take, on a few of its frames: which joints are which, and what is usual in it. */

import { fingerBases } from '../evaluate/retarget/fingers.ts';
import { LIMB_SIDES, partsOf } from '../evaluate/retarget/roles.ts';
import { footTip, type PointTree, tipBelow } from '../evaluate/retarget/tip.ts';
import { percentile } from '../evaluate/space/frame-shapes.ts';
import type { Space } from '../model/space.ts';
import type { TakeFrames } from './frames.ts';

/** Frames that are looked at, evenly over the take. */
const MOST = 128;
/** Percentile of all heights of a foot at which it is on the ground. */
const STANDING = 0.12;

/** An elbow or a knee: the joints at its ends, and itself in the middle. */
export interface Hinge {
  readonly upper: number;
  readonly middle: number;
  readonly lower: number;
  readonly isKnee: boolean;
}

export interface Foot {
  readonly thigh: number;
  readonly shin: number;
  readonly ankle: number;
  /** The point that it points to: the toe joint, another one below, or an End Site; -1 for none. */
  readonly tip: number;
  /** Heights of both when it is on the ground; metres. */
  readonly tipLevel: number;
  readonly ankleLevel: number;
}

export interface Hand {
  readonly elbow: number;
  readonly wrist: number;
  /** Where a finger begins, the middle one if there is one, or an End Site. */
  readonly tip: number;
}

export interface Survey {
  readonly hips: number;
  /** Left first. */
  readonly feet: readonly Foot[];
  /** Those whose direction is known. */
  readonly hands: readonly Hand[];
  readonly hinges: readonly Hinge[];
  /** Metres; 0 without legs. */
  readonly leg: number;
  /** The distance of a joint from the one above, 0 of the root; metres, the median. */
  lengthOf(joint: number): number;
}

export function survey(frames: TakeFrames, space: Space | undefined): Survey {
  const { skeleton, count, pointCount, above } = frames;
  const parts = partsOf(skeleton, space?.up);
  const { single } = parts;
  const { joints } = skeleton;
  const dofs = new Float64Array(frames.dofCount);
  const looked = Math.min(MOST, count);
  const points = Array.from({ length: looked }, (_, i) => {
    const out = new Float64Array(3 * pointCount);
    frames.write(Math.round((i * (count - 1)) / Math.max(1, looked - 1)), dofs, out);
    return out;
  });
  // Of the few bones that are asked for.
  const lengthOf = (joint: number) =>
    above[joint] < 0
      ? 0
      : percentile(
          points.map((at) => between(at, joint, above[joint])),
          0.5,
        );
  const hinges: Hinge[] = [];
  const feet: Foot[] = [];
  const hands: Hand[] = [];
  const tree: PointTree = { above, lengthOf };
  const heights = (point: number, isMeant = (_: Float64Array) => true) =>
    points.filter(isMeant).map((at) => at[3 * point + 1]);
  const levelOf = (point: number) => percentile(heights(point), STANDING);
  for (const side of LIMB_SIDES) {
    const [arm, forearm, hand] = (['arm', 'forearm', 'hand'] as const).map((part) => single.get(`${side} ${part}`));
    if (arm !== undefined && forearm !== undefined && hand !== undefined) {
      hinges.push({ upper: arm, middle: forearm, lower: hand, isKnee: false });
      const fingers = fingerBases(skeleton, parts, hand);
      const tip = fingers.get('middle') ?? [...fingers.values()][0] ?? tipBelow(tree, hand);
      if (tip >= 0) hands.push({ elbow: forearm, wrist: hand, tip });
    }
    const [thigh, shin, ankle] = (['thigh', 'shin', 'foot'] as const).map((part) => single.get(`${side} ${part}`));
    if (thigh === undefined || shin === undefined || ankle === undefined) continue;
    hinges.push({ upper: thigh, middle: shin, lower: ankle, isKnee: true });
    const tip = footTip(tree, parts, ankle);
    const ankleLevel = levelOf(ankle);
    // A foot without a toe joint is rigid: rolling over its end, it puts that below the ground.
    const tipLevel =
      tip < joints.length
        ? levelOf(tip)
        : percentile(
            heights(tip, (at) => at[3 * ankle + 1] <= ankleLevel),
            0.5,
          );
    feet.push({ thigh, shin, ankle, tip, tipLevel, ankleLevel });
  }
  const leg = feet.reduce((sum, { thigh, ankle }) => sum + chain(above, lengthOf, ankle, thigh), 0);
  return { hips: single.get('hips') ?? 0, feet, hands, hinges, leg: feet.length ? leg / feet.length : 0, lengthOf };
}

/** Sum of the bones from a joint up to one above it. */
function chain(above: Int32Array, lengthOf: (joint: number) => number, from: number, to: number): number {
  let sum = 0;
  for (let j = from; j > to; j = above[j]) sum += lengthOf(j);
  return sum;
}

export function between(points: Float64Array, a: number, b: number): number {
  const x = points[3 * a] - points[3 * b];
  const y = points[3 * a + 1] - points[3 * b + 1];
  const z = points[3 * a + 2] - points[3 * b + 2];
  return Math.sqrt(x * x + y * y + z * z);
}
