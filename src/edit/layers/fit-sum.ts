/**
 * The sum of a curve and layers whose weights change over time: products of cubics, which no keys hold exactly. Keys
 * with the sum's own values and slopes are set at the union of all keys, once a frame, and where a weight reaches 0 or
 * 1; then those are left out without which the curve stays within the tolerance.
 */
import { compileChannels } from '../../evaluate/compiled-take.ts';
import { evaluateChannel } from '../../evaluate/curves.ts';
import { hermiteCubic } from '../../math/hermite.ts';
import { clampedWeight } from '../../model/takes/layers.ts';
import { type Channel, type KeyedChannel, NO_EXTRAPOLATION } from '../../model/takes/take.ts';
import { unrolled } from '../channels/bake-extrapolation.ts';
import { meets } from '../channels/sloped-key.ts';
import { withKeyList } from '../keys/columns.ts';
import { type BothSides, Curve, keysAt, unionOfTimes } from './sum-curves.ts';

/** A layer's curve with its weight. */
export interface WeightedCurve {
  readonly channel: KeyedChannel;
  readonly weight: number | KeyedChannel;
  readonly isAdditive: boolean;
}

/** Points of a span between two keys at which the error is measured, and a weight is looked for that reaches 0 or 1. */
const POINTS = 6;
/** The share of the tolerance that measured errors may take: between the points they may be larger. */
const SHARE = 0.5;

/**
 * Keys from the first to the last second of the range, beyond which they are constant.
 * @param base the curve beneath, with keys or at rest
 * @param framesPerSecond at most one key a frame is set besides the union of keys
 * @param tolerance in the channel's unit
 */
export function fittedSum(
  base: Channel,
  layers: readonly WeightedCurve[],
  range: readonly [number, number],
  framesPerSecond: number,
  tolerance: number,
): KeyedChannel {
  const [start, end] = range;
  const over = (channel: KeyedChannel) => unrolled(channel, start, end);
  const written = layers.map(({ channel, weight, isAdditive }) => ({
    channel: over(channel),
    weight: typeof weight === 'number' ? weight : over(weight),
    isAdditive,
  }));
  const sum = {
    base: base.kind === 'keys' ? over(base) : base.kind === 'rest' ? base.value : 0,
    layers: written,
  };
  const weights = written.flatMap(({ weight }) => (typeof weight === 'number' ? [] : [weight]));
  const channels = [...(typeof sum.base === 'number' ? [] : [sum.base]), ...written.map((l) => l.channel), ...weights];
  const keyed = unionOfTimes(channels).filter((time) => time >= start && time <= end);
  const times = candidates(keyed, range, framesPerSecond, weights);
  const evaluator = new SumCurve(sum);
  const knots = times.map((time) => evaluator.at(time));
  const kept = thinned(knots, sum, SHARE * tolerance);
  return withKeyList({ kind: 'rest', value: 0, ...NO_EXTRAPOLATION }, kept.flatMap(keysAt));
}

interface SumOf {
  readonly base: KeyedChannel | number;
  readonly layers: readonly WeightedCurve[];
}

/** The sum at ascending times, from both sides. */
class SumCurve {
  private readonly base: Curve | number;
  private readonly layers: readonly {
    readonly curve: Curve;
    readonly weight: Curve | number;
    readonly isAdditive: boolean;
  }[];

  constructor({ base, layers }: SumOf) {
    this.base = typeof base === 'number' ? base : new Curve(base);
    this.layers = layers.map(({ channel, weight, isAdditive }) => ({
      curve: new Curve(channel),
      weight: typeof weight === 'number' ? weight : new Curve(weight),
      isAdditive,
    }));
  }

  at(time: number): BothSides {
    const v = { ...sidesOf(this.base, time) };
    for (const { curve, weight, isAdditive } of this.layers) {
      const x = curve.at(time);
      const w = clamped(sidesOf(weight, time));
      for (const side of ['In', 'Out'] as const) {
        const [value, slope] = [`value${side}`, `slope${side}`] as const;
        const kept = isAdditive ? 1 : 1 - w[value];
        v[slope] = kept * v[slope] - (isAdditive ? 0 : w[slope] * v[value]) + w[slope] * x[value] + w[value] * x[slope];
        v[value] = kept * v[value] + w[value] * x[value];
      }
    }
    return v;
  }
}

function sidesOf(curve: Curve | number, time: number): BothSides {
  if (typeof curve !== 'number') return curve.at(time);
  return { time, valueIn: curve, valueOut: curve, slopeIn: 0, slopeOut: 0 };
}

/** A weight within 0 … 1: where it leaves that, it has no slope. */
function clamped({ time, valueIn, valueOut, slopeIn, slopeOut }: BothSides): BothSides {
  const before = (valueIn >= 1 && slopeIn <= 0) || (valueIn <= 0 && slopeIn >= 0) || valueIn > 1 || valueIn < 0;
  const after = (valueOut >= 1 && slopeOut >= 0) || (valueOut <= 0 && slopeOut <= 0) || valueOut > 1 || valueOut < 0;
  return {
    time,
    valueIn: clampedWeight(valueIn),
    valueOut: clampedWeight(valueOut),
    slopeIn: before ? 0 : slopeIn,
    slopeOut: after ? 0 : slopeOut,
  };
}

/** All times at which there may be a key: those of keys, and in each frame its own or where a weight reaches 0 or 1. */
function candidates(
  keyed: readonly number[],
  [start, end]: readonly [number, number],
  framesPerSecond: number,
  weights: readonly KeyedChannel[],
): readonly number[] {
  const frameCount = Math.floor((end - start) * framesPerSecond + 1e-6) + 1;
  const frames = Array.from({ length: frameCount }, (_, f) => start + f / framesPerSecond);
  const times = new Set([start, end, ...keyed]);
  const corners = weights.flatMap((weight) =>
    cornersOf(
      weight,
      [...times, ...frames].sort((a, b) => a - b),
    ),
  );
  corners.sort((a, b) => a - b);
  let next = 0;
  frames.forEach((frame, f) => {
    const until = f + 1 < frameCount ? frames[f + 1] : Infinity;
    while (next < corners.length && corners[next] < frame) next++;
    times.add(corners[next] < until ? corners[next] : frame);
  });
  const sorted = [...times].filter((time) => time >= start && time <= end).sort((a, b) => a - b);
  const isNear = (a: number, b: number) => Math.abs(a - b) <= 1e-9;
  // A frame that meets a key by rounding is that key.
  const own = new Set([start, end, ...keyed]);
  return sorted.filter((time, i) => {
    if (own.has(time)) return true;
    return !(i > 0 && isNear(time, sorted[i - 1])) && !(i + 1 < sorted.length && isNear(time, sorted[i + 1]));
  });
}

/** Times between the given ones at which a weight reaches 0 or 1. */
function cornersOf(weight: KeyedChannel, times: readonly number[]): readonly number[] {
  const found: number[] = [];
  const compiled = compileChannels([weight]);
  const value = (time: number) => evaluateChannel(compiled, 0, time);
  for (let i = 0; i + 1 < times.length; i++) {
    const step = (times[i + 1] - times[i]) / POINTS;
    for (let p = 0; p < POINTS && step > 0; p++) {
      const [from, to] = [times[i] + p * step, times[i] + (p + 1) * step];
      const [a, b] = [value(from), value(to)];
      for (const level of [0, 1]) {
        if ((a - level) * (b - level) < 0) found.push(crossing(value, level, from, to, a < level));
      }
    }
  }
  return found;
}

function crossing(value: (time: number) => number, level: number, from: number, to: number, rises: boolean): number {
  let [low, high] = [from, to];
  for (let i = 0; i < 50; i++) {
    const middle = (low + high) / 2;
    if (value(middle) < level === rises) low = middle;
    else high = middle;
  }
  return (low + high) / 2;
}

/** The knots that are needed: from each on the farthest one that a cubic reaches within the tolerance. */
function thinned(knots: readonly BothSides[], sum: SumOf, tolerance: number): readonly BothSides[] {
  const evaluator = new SumCurve(sum);
  const points = knots.slice(0, -1).map(({ time }, i) =>
    Array.from({ length: POINTS }, (_, p) => {
      const at = time + ((p + 1) / (POINTS + 1)) * (knots[i + 1].time - time);
      return { time: at, value: evaluator.at(at).valueOut };
    }),
  );
  const cubic = new Float64Array(4);
  const reaches = (from: number, to: number) => {
    const [a, b] = [knots[from], knots[to]];
    hermiteCubic(a.valueOut, a.slopeOut, b.valueIn, b.slopeIn, b.time - a.time, cubic, 0);
    const isOff = (time: number, value: number) => {
      const t = time - a.time;
      return Math.abs(((cubic[3] * t + cubic[2]) * t + cubic[1]) * t + cubic[0] - value) > tolerance;
    };
    for (let i = from; i < to; i++) {
      if (i > from && isOff(knots[i].time, knots[i].valueOut)) return false;
      if (points[i].some(({ time, value }) => isOff(time, value))) return false;
    }
    return true;
  };
  const kept = [knots[0]];
  for (let from = 0; from + 1 < knots.length; ) {
    let to = from + 1;
    while (to + 1 < knots.length && meets(knots[to].valueIn, knots[to].valueOut) && reaches(from, to + 1)) to++;
    kept.push(knots[to]);
    from = to;
  }
  return kept;
}
