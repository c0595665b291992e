/** A first look at a take, on a few of its frames: which joints are which, and what is usual in it. */
import { percentile } from '../evaluate/frame-shapes.ts';
import { LIMB_SIDES, partsOf } from '../evaluate/retarget/roles.ts';
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
  readonly ankle: number;
  /** The toe joint, or the ankle without one. */
  readonly ball: number;
  /** Heights of ball and ankle when it is on the ground; metres. */
  readonly ballLevel: number;
  readonly ankleLevel: number;
}

export interface Survey {
  readonly hips: number;
  readonly feet: readonly Foot[];
  readonly hinges: readonly Hinge[];
  /** Metres; 0 without legs. */
  readonly leg: number;
  /** The distance of a joint from the one above, 0 of the root; metres, the median. */
  lengthOf(joint: number): number;
}

export function survey(frames: TakeFrames, space: Space | undefined): Survey {
  const { skeleton, count, pointCount, above } = frames;
  const { single } = partsOf(skeleton, space?.up);
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
  for (const side of LIMB_SIDES) {
    const [arm, forearm, hand] = (['arm', 'forearm', 'hand'] as const).map((part) => single.get(`${side} ${part}`));
    if (arm !== undefined && forearm !== undefined && hand !== undefined) {
      hinges.push({ upper: arm, middle: forearm, lower: hand, isKnee: false });
    }
    const [thigh, shin, ankle] = (['thigh', 'shin', 'foot'] as const).map((part) => single.get(`${side} ${part}`));
    if (thigh === undefined || shin === undefined || ankle === undefined) continue;
    hinges.push({ upper: thigh, middle: shin, lower: ankle, isKnee: true });
    const ball = single.get(`${side} toe`) ?? ankle;
    const levelOf = (joint: number) =>
      percentile(
        points.map((at) => at[3 * joint + 1]),
        STANDING,
      );
    feet.push({ thigh, ankle, ball, ballLevel: levelOf(ball), ankleLevel: levelOf(ankle) });
  }
  const leg = feet.reduce((sum, { thigh, ankle }) => sum + chain(above, lengthOf, ankle, thigh), 0);
  return { hips: single.get('hips') ?? 0, feet, hinges, leg: feet.length ? leg / feet.length : 0, lengthOf };
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
