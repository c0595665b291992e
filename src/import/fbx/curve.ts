/**
 * An animation curve of FBX: keys with slopes and weights on either side, and what comes before and after.
 *
 *     flags: 2 constant (100: the next key's value), 4 linear, 8 cubic
 *            of cubic: 100 auto, 200 TCB, 400 user, 800 broken; 1000 clamp, 2000 time-independent, 4000 progressive clamp
 *            1000000 weighted to the right, 2000000 the next key's left too
 *     data:  four floats per run of keys: slope to the right, slope to the left of the next key, two weights as
 *            ten-thousandths in one word, velocities (not used); or tension, continuity, bias
 *
 * The tangents of automatic keys are not in the file: they are computed as ufbx found the FBX SDK to compute them.
 */
import { lastNotAbove } from '../../math/search.ts';
import type { FbxReport } from './failure.ts';
import type { NumberPool } from './records/number-pool.ts';
import { childOf, type FbxFile, type FbxNumbers, type FbxRecord, numberAt, numbersOf } from './records/record.ts';

/** A curve as columns with an entry per key; values are those of the file, angles in degrees. */
export interface FbxCurve {
  /** Seconds, ascending; several may be equal. */
  readonly times: Float64Array;
  readonly values: Float64Array;
  /** Kind of the span after each key. */
  readonly spans: Uint8Array;
  /** Value per second on the left and on the right of each key. */
  readonly slopesIn: Float64Array;
  readonly slopesOut: Float64Array;
  /** How far a handle reaches, as a fraction of its span: a third, unless weighted. May be longer. */
  readonly weightsIn: Float64Array;
  readonly weightsOut: Float64Array;
  readonly before: Beyond;
  readonly after: Beyond;
  /** Whether it has the same value at all times, and no keys beyond its own. */
  readonly isConstant: boolean;
}

function isConstant({ values, slopesIn, slopesOut, before, after }: FbxCurve): boolean {
  if (before.mode !== 'constant' || after.mode !== 'constant') return false;
  for (let i = 0; i < values.length; i++) {
    if (values[i] !== values[0] || slopesIn[i] !== 0 || slopesOut[i] !== 0) return false;
  }
  return true;
}

/** Behaviour of a curve beyond its keys. */
export interface Beyond {
  readonly mode: 'constant' | 'slope' | 'repeat' | 'repeat with offset' | 'mirror';
  /** How often it is repeated; infinity is the rule. */
  readonly count: number;
}

/** Kinds of spans. `next` holds the value of the key at its end. */
export const HOLD = 0;
/** The span has the next key's value. */
export const HOLD_NEXT = 1;
/** The span is straight. */
export const LINE = 2;
/** The span is a cubic with slopes and weights. */
export const CUBIC = 3;

const CONSTANT_FLAG = 0x2;
const NEXT_FLAG = 0x100;
const CUBIC_FLAG = 0x8;
const TCB_FLAG = 0x200;
const USER_FLAG = 0x400;
const CLAMP_FLAG = 0x1000;
const TIME_INDEPENDENT_FLAG = 0x2000;
const PROGRESSIVE_FLAG = 0x4000;
const WEIGHTED_FLAG = 0x1000000;
const NEXT_WEIGHTED_FLAG = 0x2000000;

const THIRD = 1 / 3;
/** From 7.2 on, texts write the bits of these floats as integers. */
const BITS_IN_TEXT = 7200;

/**
 * Reads a curve from its record.
 * @returns undefined, after a warning, if the curve has no keys or columns of different lengths
 */
export function curveOf(
  record: FbxRecord,
  ticks: number,
  { version, isText, pool }: Pick<FbxFile, 'version' | 'isText' | 'pool'>,
  report: FbxReport,
): FbxCurve | undefined {
  const ownTimes = numbersOf(childOf(record, 'KeyTime'));
  const ownValues = numbersOf(childOf(record, 'KeyValueFloat'));
  const count = ownTimes.length;
  if (count === 0) return undefined;
  const flags = numbersOf(childOf(record, 'KeyAttrFlags'));
  const data = floatsOf(numbersOf(childOf(record, 'KeyAttrDataFloat')), isText && version >= BITS_IN_TEXT);
  const runs = numbersOf(childOf(record, 'KeyAttrRefCount'));
  if (ownValues.length !== count || runs.length < 1 || flags.length < runs.length || data.length < 4 * runs.length) {
    report.warn('bad-curve', `A curve has ${count} times and ${ownValues.length} values.`, record.offset, 'left out');
    return undefined;
  }
  const [times, values] = sorted(ownTimes, ownValues, ticks, pool);
  let allFlags = 0;
  for (let i = 0; i < flags.length; i++) allFlags |= flags[i];
  const isWeighted = (allFlags & (WEIGHTED_FLAG | NEXT_WEIGHTED_FLAG)) !== 0;
  const curve = {
    times,
    values,
    spans: new Uint8Array(count),
    slopesIn: pool.doubles(count),
    slopesOut: pool.doubles(count),
    weightsIn: isWeighted ? new Float64Array(count).fill(THIRD) : thirds(count),
    weightsOut: isWeighted ? new Float64Array(count).fill(THIRD) : thirds(count),
    before: beyondOf(childOf(record, 'Pre-Extrapolation')),
    after: beyondOf(childOf(record, 'Post-Extrapolation')),
    isConstant: false,
  };
  let run = 0;
  let left = runs[0];
  for (let key = 0; key < count; key++) {
    writeKey(curve, key, flags[run], data, 4 * run);
    if (--left <= 0 && run + 1 < runs.length) left = runs[++run];
  }
  curve.isConstant = isConstant(curve);
  return curve;
}

/** Shared by all curves without weights. */
let allThirds = new Float64Array(0);

/** As many thirds, or more, which must not be changed. */
function thirds(count: number): Float64Array {
  if (allThirds.length < count) allThirds = new Float64Array(2 * count).fill(THIRD);
  return allThirds;
}

/** Seconds in ascending order, with their values. Times that are no number, and values that are no single, count as 0. */
function sorted(
  ticks: FbxNumbers,
  values: FbxNumbers,
  ticksPerSecond: number,
  pool: NumberPool,
): [Float64Array, Float64Array] {
  const times = pool.doubles(ticks.length);
  let isSorted = true;
  for (let i = 0; i < times.length; i++) {
    times[i] = finite(ticks[i] / ticksPerSecond);
    if (i > 0 && !(times[i] >= times[i - 1])) isSorted = false;
  }
  const numbers = pool.doubles(values.length);
  // Texts can say more than the format holds: slopes and fitted keys of 1e308 would be no numbers.
  for (let i = 0; i < numbers.length; i++) numbers[i] = Number.isFinite(Math.fround(values[i])) ? values[i] : 0;
  if (isSorted) return [times, numbers];
  const order = [...times.keys()].sort((a, b) => times[a] - times[b] || a - b);
  return [Float64Array.from(order, (i) => times[i]), Float64Array.from(order, (i) => numbers[i])];
}

function floatsOf(data: FbxNumbers, areBits: boolean): Float32Array {
  if (areBits) return new Float32Array(Int32Array.from(data).buffer);
  return data instanceof Float32Array ? data : Float32Array.from(data);
}

/** What nearly all curves have. */
const STAYS: Beyond = { mode: 'constant', count: Number.POSITIVE_INFINITY };

function beyondOf(record: FbxRecord | undefined): Beyond {
  if (!record) return STAYS;
  const type = childOf(record, 'Type')?.values[0];
  const letter = typeof type === 'number' ? String.fromCharCode(type) : type;
  const repetitions = numberAt(childOf(record, 'Repetition')) ?? -1;
  const count = repetitions < 0 ? Number.POSITIVE_INFINITY : repetitions;
  if (letter === 'K') return { mode: 'slope', count };
  if (count === 0) return { mode: 'constant', count };
  if (letter === 'R') return { mode: 'repeat', count };
  if (letter === 'A') return { mode: 'repeat with offset', count };
  if (letter === 'M') return { mode: 'mirror', count };
  return { mode: 'constant', count };
}

/** Fills in a key's right side and the next one's left side. The left side is what the key before said about it. */
function writeKey(curve: FbxCurve, key: number, flags: number, data: Float32Array, at: number): void {
  const { times, values, spans, slopesIn, slopesOut, weightsIn, weightsOut } = curve;
  const next = key + 1;
  const hasNext = next < times.length;
  const duration = hasNext ? times[next] - times[key] : 0;
  const isCubic = (flags & CONSTANT_FLAG) === 0 && (flags & CUBIC_FLAG) !== 0;
  if (!isCubic) {
    const isConstant = (flags & CONSTANT_FLAG) !== 0;
    const chord = duration > 0 && !isConstant ? (values[next] - values[key]) / duration : 0;
    spans[key] = isConstant ? ((flags & NEXT_FLAG) !== 0 ? HOLD_NEXT : HOLD) : LINE;
    slopesOut[key] = chord;
    if (hasNext) slopesIn[next] = chord;
    return;
  }
  spans[key] = CUBIC;
  if ((flags & WEIGHTED_FLAG) !== 0) weightsOut[key] = weightAt(data, at + 2, 0);
  if ((flags & NEXT_WEIGHTED_FLAG) !== 0 && hasNext) weightsIn[next] = weightAt(data, at + 2, 16);
  if ((flags & TCB_FLAG) !== 0) {
    findSides(curve, key);
    writeTcb(curve, key, data[at], data[at + 1], data[at + 2]);
    if (hasNext) slopesIn[next] = 0;
    return;
  }
  if ((flags & USER_FLAG) !== 0) {
    slopesOut[key] = finite(data[at]);
  } else {
    findSides(curve, key);
    // What the file has in place of slopes is a bias: to the right from this key, to the left from the one before.
    const right = finite(data[at]);
    const left = slopesIn[key];
    const isOne = Math.abs(left + right) <= 1e-4;
    slopesOut[key] = autoSlope(weightsIn[key], weightsOut[key], right, flags);
    slopesIn[key] = isOne ? slopesOut[key] : autoSlope(weightsIn[key], weightsOut[key], -left, flags);
  }
  if (hasNext) slopesIn[next] = finite(data[at + 1]);
}

function finite(value: number): number {
  return Number.isFinite(value) ? value : 0;
}

/** One of the two weights in a word of the data. A handle reaches no further than its span. */
function weightAt(data: Float32Array, at: number, shift: number): number {
  const word = new DataView(data.buffer, data.byteOffset).getUint32(4 * at, true);
  return Math.min(((word >>> shift) & 0xffff) / 10000, 1);
}

/** Scratch: seconds of the spans before and after a key, 0 for none, and by how much the value changes in them. */
const sides = { before: 0, after: 0, changeBefore: 0, changeAfter: 0 };

function findSides({ times, values }: FbxCurve, key: number): void {
  const [last, next] = [key - 1, key + 1];
  sides.before = last >= 0 && times[key] > times[last] ? times[key] - times[last] : 0;
  sides.after = next < times.length && times[next] > times[key] ? times[next] - times[key] : 0;
  sides.changeBefore = sides.before > 0 ? values[key] - values[last] : 0;
  sides.changeAfter = sides.after > 0 ? values[next] - values[key] : 0;
}

/** Tension, continuity and bias, with `sides`. */
function writeTcb(curve: FbxCurve, key: number, t: number, c: number, b: number): void {
  const { before, after, changeBefore, changeAfter } = sides;
  const left = before > 0 ? changeBefore / before : 0;
  const right = after > 0 ? changeAfter / after : 0;
  const factor = (1 - t) * (before > 0 && after > 0 ? 0.5 : 1);
  curve.slopesIn[key] = finite(factor * ((1 + b) * (1 - c) * left + (1 - b) * (1 + c) * right));
  curve.slopesOut[key] = finite(factor * ((1 + b) * (1 + c) * left + (1 - b) * (1 - c) * right));
}

/**
 * The slope of an automatic key, with `sides`.
 * @param bias to the right if positive; from 500 on it adds to the slope
 */
function autoSlope(weightIn: number, weightOut: number, bias: number, flags: number): number {
  const { before, after, changeBefore, changeAfter } = sides;
  const isIndependent = (flags & TIME_INDEPENDENT_FLAG) !== 0;
  const isProgressive = (flags & PROGRESSIVE_FLAG) !== 0;
  const isBetween = before > 0 && after > 0;
  if (!isBetween && before === after) return 0;
  // Clamped keys are flat beside a key of the same value.
  const nearest = Math.min(
    Math.abs(before > 0 ? changeBefore : changeAfter),
    Math.abs(after > 0 ? changeAfter : changeBefore),
  );
  if ((flags & CLAMP_FLAG) !== 0 && nearest <= 1e-5 && !(isProgressive && !isBetween)) return 0;
  const strength = Math.abs(bias) / 100;
  const excess = Math.max(0, strength - 5);
  if (!isBetween) {
    if (isProgressive) return 0;
    const own = before > 0 ? changeBefore / before : changeAfter / after;
    return isIndependent ? own : own + excess * excess * (bias > 0 ? 1 : -1) * 40;
  }
  const left = changeBefore / before;
  const right = changeAfter / after;
  const total = before + after;
  let slope = (changeBefore + changeAfter) / total;
  if (!isIndependent) {
    const part = before / total;
    slope = (slope + left * (1 - part) + right * part) / 2;
    if (strength > 1e-4) {
      const target = bias > 0 ? right : left;
      const pull = target - slope;
      slope = slope * (1 - strength) + target * strength;
      slope += excess * excess * ((Math.abs(pull) > 1e-5 ? pull : bias) > 0 ? 1 : -1) * 40;
    }
  }
  if (!isProgressive) return slope;
  // No handle reaches beyond the value of its neighbour.
  const sign = slope >= 0 ? 1 : -1;
  const limitOf = (change: number, reach: number) => (reach > 0 ? Math.max(0, (sign * change) / reach) : 0);
  const most = Math.min(limitOf(changeBefore, weightIn * before), limitOf(changeAfter, weightOut * after));
  return sign * Math.min(Math.abs(slope), most);
}

/** The value at a time, in seconds. */
export function evaluateCurve(curve: FbxCurve, time: number): number {
  const { times, values, before, after } = curve;
  const last = times.length - 1;
  if (last === 0) return values[0];
  if (time < times[0]) return beyond(curve, before, time, true);
  if (time > times[last]) return beyond(curve, after, time, false);
  return inside(curve, time);
}

/** Whether a curve is never further from a value than the tolerance. */
export function staysAt(curve: FbxCurve, value: number, tolerance: number): boolean {
  const { times, values, spans, slopesIn, slopesOut, before, after } = curve;
  const last = times.length - 1;
  if (before.mode === 'slope' && slopesOut[0] !== 0) return false;
  if (after.mode === 'slope' && slopesIn[last] !== 0) return false;
  const isFlat = (slope: number, seconds: number) => Math.abs(slope * seconds) <= tolerance;
  return times.every((time, key) => {
    if (!(Math.abs(values[key] - value) <= tolerance)) return false;
    if (key === last || spans[key] !== CUBIC) return true;
    const seconds = times[key + 1] - time;
    return isFlat(slopesOut[key], seconds) && isFlat(slopesIn[key + 1], seconds);
  });
}

function inside(curve: FbxCurve, time: number): number {
  const { times, values, spans } = curve;
  const key = lastNotAbove(times, 0, times.length, time);
  if (key + 1 >= times.length || time <= times[key]) return values[key];
  const duration = times[key + 1] - times[key];
  const part = (time - times[key]) / duration;
  const v0 = values[key];
  const v1 = values[key + 1];
  switch (spans[key]) {
    case HOLD:
      return v0;
    case HOLD_NEXT:
      return v1;
    case LINE:
      return v0 + (v1 - v0) * part;
    default: {
      const w0 = curve.weightsOut[key];
      const w1 = curve.weightsIn[key + 1];
      // With handles of a third, time is even along the curve.
      const t = isThird(w0) && isThird(w1) ? part : bezierParameter(w0, 1 - w1, part);
      const u = 1 - t;
      const a = v0 + curve.slopesOut[key] * w0 * duration;
      const b = v1 - curve.slopesIn[key + 1] * w1 * duration;
      return u * u * u * v0 + 3 * u * t * (u * a + t * b) + t * t * t * v1;
    }
  }
}

function isThird(weight: number): boolean {
  return Math.abs(weight - THIRD) < 1e-9;
}

/** Where x(t) of a Bézier curve from 0 to 1 with handles at `a` and `b`, both within, is `x`: by bisected Newton steps. */
function bezierParameter(a: number, b: number, x: number): number {
  let low = 0;
  let high = 1;
  let t = x;
  for (let i = 0; i < 60; i++) {
    const u = 1 - t;
    const off = 3 * u * t * (u * a + t * b) + t * t * t - x;
    if (Math.abs(off) < 1e-15) break;
    if (off > 0) high = t;
    else low = t;
    const slope = 3 * (u * u * a + 2 * u * t * (b - a) + t * t * (1 - b));
    const step = t - off / slope;
    t = step > low && step < high ? step : (low + high) / 2;
  }
  return t;
}

function beyond(curve: FbxCurve, { mode, count }: Beyond, time: number, isBefore: boolean): number {
  const { times, values, slopesIn, slopesOut } = curve;
  const last = times.length - 1;
  const end = isBefore ? 0 : last;
  const duration = times[last] - times[0];
  if (mode === 'slope') return values[end] + (isBefore ? slopesOut[0] : slopesIn[last]) * (time - times[end]);
  if (mode === 'constant' || !(duration > 0)) return values[end];
  const distance = Math.abs(time - times[end]);
  let turns = Math.floor(distance / duration);
  let rest = distance - turns * duration;
  if (turns >= count) {
    turns = count - 1;
    rest = duration;
  }
  // The first repetition of a mirrored curve runs backwards.
  const runsBack = (mode === 'mirror' && turns % 2 === 0) !== isBefore;
  const value = inside(curve, runsBack ? times[last] - rest : times[0] + rest);
  if (mode !== 'repeat with offset') return value;
  return value + (values[last] - values[0]) * (turns + 1) * (isBefore ? -1 : 1);
}
