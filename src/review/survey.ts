/** A first look at a take, on a few of its frames: which joints are which, and what is usual in it. */
import { percentile } from '../evaluate/frame-shapes.ts';
import { fingerBases } from '../evaluate/retarget/fingers.ts';
import { LIMB_SIDES, partsOf } from '../evaluate/retarget/roles.ts';
import type { Space } from '../model/space.ts';
import type { TakeFrames } from './frames.ts';

/** Frames that are looked at, evenly over the take. */
const MOST = 128;
/** Metres; what is nearer to its joint points nowhere. */
const SOMEWHERE = 0.01;
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
  /** The toe joint, or the ankle without one. */
  readonly ball: number;
  /** Heights of ball and ankle when it is on the ground; metres. */
  readonly ballLevel: number;
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
  // A joint, or else an End Site, that is somewhere else.
  const below = (joint: number) => above.findIndex((parent, p) => parent === joint && lengthOf(p) > SOMEWHERE);
  for (const side of LIMB_SIDES) {
    const [arm, forearm, hand] = (['arm', 'forearm', 'hand'] as const).map((part) => single.get(`${side} ${part}`));
    if (arm !== undefined && forearm !== undefined && hand !== undefined) {
      hinges.push({ upper: arm, middle: forearm, lower: hand, isKnee: false });
      const fingers = fingerBases(skeleton, parts, hand);
      const tip = fingers.get('middle') ?? [...fingers.values()][0] ?? below(hand);
      if (tip >= 0) hands.push({ elbow: forearm, wrist: hand, tip });
    }
    const [thigh, shin, ankle] = (['thigh', 'shin', 'foot'] as const).map((part) => single.get(`${side} ${part}`));
    if (thigh === undefined || shin === undefined || ankle === undefined) continue;
    hinges.push({ upper: thigh, middle: shin, lower: ankle, isKnee: true });
    const toe = single.get(`${side} toe`);
    const ball = toe ?? ankle;
    const levelOf = (joint: number) =>
      percentile(
        points.map((at) => at[3 * joint + 1]),
        STANDING,
      );
    const tip = toe ?? below(ankle);
    feet.push({ thigh, shin, ankle, tip, ball, ballLevel: levelOf(ball), ankleLevel: levelOf(ankle) });
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
