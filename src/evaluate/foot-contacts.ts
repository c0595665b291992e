/**
 * When a foot is on the ground: while its ball (the toe joint, or the ankle without one) is slow and low.
 *
 *     speed  < 0.35 leg lengths a second        height above its most frequent minimum  < 0.08 leg lengths
 *
 * for at least 0.08 s. The speed is measured over 1/30 s, or two frames if these are longer, so that it does not depend
 * on the frame rate. Shorter gaps than 0.05 s are noise within a contact.
 */
import type { Skeleton } from '../model/skeleton/skeleton.ts';
import type { Space } from '../model/space.ts';
import { distance } from './retarget/body.ts';
import { LIMB_SIDES, rolesOf } from './retarget/roles.ts';
import { percentile } from './space/frame-shapes.ts';

const SLOW = 0.35;
const LOW = 0.08;
const SHORTEST = 0.08;
const SHORTEST_GAP = 0.05;
/** Half the time over which the speed is measured. */
const HALF_WINDOW = 1 / 60;
/** Percentile of all heights that counts as standing. */
const STANDING = 0.12;

/** Positions of joints in evenly spaced frames. */
export interface JointPaths {
  readonly count: number;
  /** Seconds of the first frame, and between frames. */
  readonly start: number;
  readonly step: number;
  /** Number of joints. */
  readonly width: number;
  /** x y z per joint, frame by frame; metres, y up. */
  readonly points: Float64Array;
}

/** Height of a path when its foot stands; metres. */
export function standingHeight({ count, width, points }: JointPaths, column: number): number {
  const heights = new Float64Array(count);
  for (let f = 0; f < count; f++) heights[f] = points[3 * (f * width + column) + 1];
  return percentile(heights, STANDING) || 0;
}

/**
 * Seconds, ascending: start and end of each contact of one of the joints.
 * @param height of `standingHeight`
 * @param leg its length; metres
 */
export function contactSpans(paths: JointPaths, column: number, height: number, leg: number): Float64Array {
  const { count, start, step, width, points } = paths;
  if (!(step > 0)) return new Float64Array(0);
  const reach = Math.max(1, Math.round(HALF_WINDOW / step));
  const spans: [number, number][] = [];
  for (let f = 0; f < count; f++) {
    if (!(points[3 * (f * width + column) + 1] < height + LOW * leg)) continue;
    const [a, b] = [Math.max(0, f - reach), Math.min(count - 1, f + reach)];
    const from = 3 * (a * width + column);
    const to = 3 * (b * width + column);
    const x = points[to] - points[from];
    const y = points[to + 1] - points[from + 1];
    const z = points[to + 2] - points[from + 2];
    if (!(Math.sqrt(x * x + y * y + z * z) < SLOW * leg * step * (b - a))) continue;
    const seconds = start + f * step;
    const last = spans.at(-1);
    if (last && seconds - last[1] <= Math.max(SHORTEST_GAP, 1.5 * step)) last[1] = seconds;
    else spans.push([seconds, seconds]);
  }
  return Float64Array.from(spans.filter(([from, to]) => to - from >= SHORTEST).flat());
}

/** First and last frame of each span, at most `count − 1`. */
export function framesOfSpans(
  { count, start, step }: Pick<JointPaths, 'count' | 'start' | 'step'>,
  spans: Float64Array,
): Int32Array {
  return Int32Array.from(spans, (seconds) => Math.min(count - 1, Math.max(0, Math.round((seconds - start) / step))));
}

/** The feet of a skeleton. */
export interface Feet {
  /** The toe joint of each foot, or its ankle; the left one first. */
  readonly balls: readonly number[];
  /** From hip joint to ankle, on average; metres. */
  readonly leg: number;
}

/** Those with a whole leg, recognised by name or by shape; none if the skeleton has none. */
export function feetOf(skeleton: Skeleton, space: Space | undefined): Feet {
  const { single, rest } = rolesOf(skeleton, space);
  const legs = LIMB_SIDES.flatMap((side) => {
    const [thigh, shin, foot] = (['thigh', 'shin', 'foot'] as const).map((part) => single.get(`${side} ${part}`));
    if (thigh === undefined || shin === undefined || foot === undefined) return [];
    const length = distance(rest, thigh, shin) + distance(rest, shin, foot);
    return [{ ball: single.get(`${side} toe`) ?? foot, length }];
  });
  const leg = legs.reduce((sum, { length }) => sum + length, 0) / Math.max(1, legs.length);
  return leg > 0 ? { balls: legs.map(({ ball }) => ball), leg } : { balls: [], leg: 0 };
}
