/**
 * Fits a channel with few keys to a function of time: cubic Hermite segments with the function's slopes, halved (on a
 * grid of frames) until each is within tolerance.
 *
 * Slopes are written as numbers. `smooth` would be shorter to read, but at the ends of a channel it uses one segment's
 * slope, and a cycle would have a corner there.
 */
import type { Channel, Extrapolation, Tangents } from '../../../src/model/takes/take.ts';
import { FIXED_TANGENT } from '../../../src/model/takes/tangent-kinds.ts';
import { round } from '../shape/vectors.ts';

export interface FitOptions {
  readonly from: number;
  readonly to: number;
  /** Key times are multiples of this, counted from `from`. Seconds. */
  readonly frame: number;
  /** In the channel's own unit. */
  readonly tolerance: number;
  readonly extrapolation: Extrapolation;
  /** Times (on the grid) at which the motion has a corner, such as a heel strike: tangents are broken there. */
  readonly corners?: readonly number[];
}

const VALUE_DECIMALS = 4;
const SLOPE_DECIMALS = 2;
/** Step of one-sided differences. */
const STEP = 1e-5;

interface Key {
  readonly time: number;
  readonly value: number;
  readonly slopeIn: number;
  readonly slopeOut: number;
}

export function fitChannel(motion: (seconds: number) => number, options: FitOptions): Channel {
  const { from, to, frame, tolerance, extrapolation } = options;
  const frames = Math.round((to - from) / frame);
  const corners = new Set((options.corners ?? []).map((t) => Math.round((t - from) / frame)));
  const slope = (t: number, side: number) => {
    const [a, b, c] = [motion(t), motion(t + side * STEP), motion(t + 2 * side * STEP)];
    return (side * (4 * b - 3 * a - c)) / (2 * STEP);
  };
  const keyAt = (i: number): Key => {
    const t = from + i * frame;
    const before = slope(t, -1);
    const after = slope(t, 1);
    const isCorner = corners.has(i);
    return {
      time: round(t, 4),
      value: round(motion(t), VALUE_DECIMALS),
      slopeIn: round(isCorner ? before : (before + after) / 2, SLOPE_DECIMALS),
      slopeOut: round(isCorner ? after : (before + after) / 2, SLOPE_DECIMALS),
    };
  };
  let lowest = Number.POSITIVE_INFINITY;
  let highest = Number.NEGATIVE_INFINITY;
  for (let i = 0; i <= frames; i++) {
    const value = motion(from + i * frame);
    lowest = Math.min(lowest, value);
    highest = Math.max(highest, value);
  }
  if (highest - lowest < tolerance) {
    return channelOf([{ time: from, value: round((lowest + highest) / 2, 4), slopeIn: 0, slopeOut: 0 }], 'constant');
  }
  const keys: Key[] = [keyAt(0)];
  const halve = (a: number, b: number) => {
    if (b - a > 1 && worstError(motion, keyAt(a), keyAt(b)) > tolerance) {
      const middle = (a + b) >> 1;
      halve(a, middle);
      halve(middle, b);
    } else keys.push(keyAt(b));
  };
  const stops = [0, ...[...corners].filter((i) => i > 0 && i < frames).sort((a, b) => a - b), frames];
  for (let i = 0; i + 1 < stops.length; i++) halve(stops[i], stops[i + 1]);
  return channelOf(keys, extrapolation);
}

function worstError(motion: (seconds: number) => number, a: Key, b: Key): number {
  const span = b.time - a.time;
  let worst = 0;
  const steps = Math.max(8, Math.ceil(span / 0.01));
  for (let i = 1; i < steps; i++) {
    const t = i / steps;
    const [t2, t3] = [t * t, t * t * t];
    const value =
      (2 * t3 - 3 * t2 + 1) * a.value +
      (t3 - 2 * t2 + t) * span * a.slopeOut +
      (3 * t2 - 2 * t3) * b.value +
      (t3 - t2) * span * b.slopeIn;
    worst = Math.max(worst, Math.abs(value - motion(a.time + t * span)));
  }
  return worst;
}

function channelOf(keys: readonly Key[], extrapolation: Extrapolation): Channel {
  const tangents = (slopes: number[]): Tangents => ({
    kinds: new Uint8Array(slopes.length).fill(FIXED_TANGENT),
    slopes: Float64Array.from(slopes),
  });
  return {
    kind: 'keys',
    extrapolateIn: extrapolation,
    extrapolateOut: extrapolation,
    times: Float64Array.from(keys, (k) => k.time),
    values: Float64Array.from(keys, (k) => k.value),
    tangentsIn: tangents(keys.map((k) => k.slopeIn)),
    tangentsOut: tangents(keys.map((k) => k.slopeOut)),
  };
}
