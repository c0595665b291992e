/**
 * Curves of FBX as channels: keys and slopes as they are. Holds become two keys at one time; handles that are not a
 * third of their span long become more keys, within a tolerance; a limited number of repetitions becomes keys.
 */

import { fitKeys } from '../../evaluate/fitting/fit-keys.ts';
import { KeyList, LINE_SLOPE } from '../../evaluate/fitting/key-list.ts';
import type { Extrapolation, KeyedChannel } from '../../model/takes/take.ts';
import { type Beyond, CUBIC, evaluateCurve, type FbxCurve, HOLD, LINE } from './curve.ts';

/** Weights that differ less from a third are one. */
const SAME_WEIGHT = 2e-4;
/** Keys that repetitions are written as at most. */
const MAX_REPEATED = 10000;

/** Scratch. */
const list = new KeyList();

/**
 * An FBX curve as a keyed channel.
 * @param tolerance of its values, for weighted handles
 * @param factor what values and slopes are multiplied by
 * @param offset what is then added to values
 */
export function channelOf(curve: FbxCurve, tolerance: number, factor = 1, offset = 0): KeyedChannel {
  list.clear();
  const before = repetitionsOf(curve, curve.before);
  const after = repetitionsOf(curve, curve.after);
  if (before === 0 && after === 0) {
    addKeys(curve, tolerance);
    return list.channel(factor, offset, extrapolation(curve.before.mode), extrapolation(curve.after.mode));
  }
  addRepeated(curve, before, after);
  const mode = (repeats: number, beyond: Beyond) => (repeats > 0 ? 'constant' : extrapolation(beyond.mode));
  return list.channel(factor, offset, mode(before, curve.before), mode(after, curve.after));
}

/** How many keys a curve becomes, or few more. */
export function channelKeys(curve: FbxCurve): number {
  return curve.times.length * (1 + repetitionsOf(curve, curve.before) + repetitionsOf(curve, curve.after));
}

const EXTRAPOLATIONS: { readonly [M in Beyond['mode']]: Extrapolation } = {
  constant: 'constant',
  slope: 'linear',
  repeat: 'cycle',
  'repeat with offset': 'cycle_offset',
  mirror: 'bounce',
};

function extrapolation(mode: Beyond['mode']): Extrapolation {
  return EXTRAPOLATIONS[mode];
}

/** How often keys are repeated as keys: 0 for constant, linear and unlimited extrapolation. */
function repetitionsOf({ times }: FbxCurve, { mode, count }: Beyond): number {
  if (mode === 'constant' || mode === 'slope' || !Number.isFinite(count)) return 0;
  return Math.min(count, Math.floor(MAX_REPEATED / times.length));
}

function addKeys(curve: FbxCurve, tolerance: number): void {
  const { times, values, spans, slopesIn, slopesOut } = curve;
  const count = times.length;
  list.add(times[0], values[0], count > 1 ? slopesOut[0] : 0, 0);
  for (let key = 0; key + 1 < count; key++) {
    const next = key + 1;
    const t1 = times[next];
    const v1 = values[next];
    const isSpan = t1 > times[key];
    if (!isSpan) {
      list.add(t1, v1, 0, 0);
    } else if (spans[key] === LINE) {
      list.leave(LINE_SLOPE);
      list.add(t1, v1, LINE_SLOPE, 0);
    } else if (spans[key] === CUBIC && isWeighted(curve, key)) {
      addWeighted(curve, key, tolerance);
    } else if (spans[key] === CUBIC) {
      list.leave(slopesOut[key]);
      list.add(t1, v1, slopesIn[next], 0);
    } else {
      const held = spans[key] === HOLD ? values[key] : v1;
      list.leave(0);
      if (held !== values[key]) list.add(times[key], held, 0, 0);
      list.add(t1, held, 0, 0);
      if (held !== v1) list.add(t1, v1, 0, 0);
    }
  }
  // For what follows linearly.
  list.leave(slopesIn[count - 1]);
}

function isWeighted({ weightsIn, weightsOut }: FbxCurve, key: number): boolean {
  return Math.max(Math.abs(weightsOut[key] - 1 / 3), Math.abs(weightsIn[key + 1] - 1 / 3)) > SAME_WEIGHT;
}

/** A span whose handles bend time: fitted. */
function addWeighted(curve: FbxCurve, key: number, tolerance: number): void {
  const { times, values } = curve;
  const [from, to] = [times[key], times[key + 1]];
  // The last value itself, though a step may follow at its time.
  const write = (time: number, _: Float64Array, out: Float64Array) => {
    out[0] = time >= to ? values[key + 1] : evaluateCurve(curve, time);
  };
  const [fitted] = fitKeys(write, [from, to], [values[key]], [tolerance]);
  list.append(fitted);
}

/** The keys of a curve and of its repetitions, as many as it says. */
function addRepeated(curve: FbxCurve, before: number, after: number): void {
  const { times } = curve;
  const duration = times[times.length - 1] - times[0];
  const stops: number[] = [];
  for (let turn = -before; turn <= after; turn++) {
    const runsBack = turn % 2 !== 0 && (turn < 0 ? curve.before : curve.after).mode === 'mirror';
    const own = runsBack ? times.toReversed().map((time) => times[0] + times[times.length - 1] - time) : times;
    for (const time of own) stops.push(time + turn * duration);
  }
  const write = (time: number, _: Float64Array, out: Float64Array) => {
    out[0] = evaluateCurve(curve, time);
  };
  const [fitted] = fitKeys(write, ascending(stops), [curve.values[0]], [1e-6 * spread(curve)]);
  list.append(fitted);
}

function spread({ values }: FbxCurve): number {
  return values.reduce((most, value) => Math.max(most, Math.abs(value - values[0])), 1e-9);
}

/** Sorted, each once: nearly equal times are one. */
export function ascending(times: readonly number[]): number[] {
  const sorted = [...times].sort((a, b) => a - b);
  return sorted.filter((time, i) => i === 0 || time - sorted[i - 1] > 1e-9 * Math.max(1, Math.abs(time)));
}
