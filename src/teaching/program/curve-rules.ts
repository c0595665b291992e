/**
 * A channel's value by rules that can each be replaced by a mistake. In the textbook's form, so that every step is one
 * that a program has:
 *
 *     slopes      of a key's tangents, in value per second
 *     fold        a time outside the keys to one inside, with the number of the period
 *     u           (t − t_k) / h, h the length of the segment
 *     p(u)        a·u³ + b·u² + c·u + d, with (a b c d) = M · (p0 p1 h·m0 h·m1)
 *
 * With `RIGHT_CURVES` the value is that of `evaluate/curves.ts`.
 */
import { repetitionAt } from '../../evaluate/curves.ts';
import { lastNotAbove } from '../../math/search.ts';
import { autoSlope } from '../../model/takes/auto-slope.ts';
import type { Channel, KeyedChannel, KeyedCurve, Keys, Tangents } from '../../model/takes/take.ts';
import { AUTO_TANGENT, FIXED_TANGENT, FLAT, LINEAR, SMOOTH } from '../../model/takes/tangent-kinds.ts';

/** Rows a b c d, columns p0 p1 m0 m1. */
export type HermiteBasis = readonly number[];

/** The cubic Hermite basis, by rows: (a b c d) = M · (p0 p1 h·m0 h·m1). */
export const HERMITE: HermiteBasis = [2, -2, 1, 1, -3, 3, -2, -1, 0, 0, 1, 0, 1, 0, 0, 0];

/**
 * Consequence of a negative remainder: the first segment runs on or its key holds; `first`: in mirrored periods, too.
 */
type Unfolded = 'run on' | 'hold' | 'run on first' | 'hold first';

/** The rules by which a program evaluates channels; `RIGHT_CURVES` has the right ones. */
export interface CurveRules {
  /** `halved`: the difference of the values over 2, whatever the time between them; `halved ends`: over 1 at the ends. */
  readonly smooth: 'across' | 'mean of segments' | 'halved' | 'halved ends';
  readonly smoothEnds: 'segment' | 'flat';
  readonly linear: 'own side' | 'other side';
  /** `columns`: the tangents are read in the other's place; `slopes`: the slopes are used in it. */
  readonly swapped: 'none' | 'columns' | 'slopes';
  /** Whether slopes of linear extrapolation are right although those between keys are swapped. */
  readonly swapsInsideOnly: boolean;
  readonly isScaled: boolean;
  readonly between: 'cubic' | 'line' | 'step';
  readonly basis: HermiteBasis;
  /** Where the end value is held instead, whatever the channel says. */
  readonly held: 'nowhere' | 'outside' | 'before' | 'after';
  /** Whether what the channel says of one side is done on the other. */
  readonly sides: 'own' | 'exchanged';
  /** How often the change over a period is added; `once` takes it off before the keys, `once added` adds it there, too. */
  readonly cycleOffset:
    | 'times period'
    | 'none'
    | 'always added'
    | 'once'
    | 'once added'
    | 'subtracted'
    | 'once more'
    | 'once further'
    | 'once less';
  readonly bounce: 'odd periods' | 'none' | 'even periods' | 'odd after only';
  /** How a time before the first key is folded: `hold` and `run on` leave it before the keys. */
  readonly modulo: 'floor' | Unfolded | `${Unfolded}, floor`;
  /** `range only`: times within the range are not folded. */
  readonly period: 'keys' | 'range' | 'range, run on' | 'range only' | 'length of range';
  /** `other …`: of the tangent that faces the keys, at both ends or at one. */
  readonly linearSlope: 'tangent' | 'segment' | 'other tangents' | 'other tangent before' | 'other tangent after';
}

/** The rules of channels as the lecture has them. */
export const RIGHT_CURVES: CurveRules = {
  smooth: 'across',
  smoothEnds: 'segment',
  linear: 'own side',
  swapped: 'none',
  swapsInsideOnly: false,
  isScaled: true,
  between: 'cubic',
  basis: HERMITE,
  held: 'nowhere',
  sides: 'own',
  cycleOffset: 'times period',
  bounce: 'odd periods',
  modulo: 'floor',
  period: 'keys',
  linearSlope: 'tangent',
};

/** The value of a channel that follows no samples. @param range of the take */
export function channelValue(
  channel: Channel,
  range: readonly [number, number],
  time: number,
  rules: CurveRules,
): number {
  if (channel.kind === 'rest') return channel.value;
  return channel.kind === 'keys' ? keyedValue(channel, range, time, rules) : 0;
}

function keyedValue(keys: KeyedChannel, range: readonly [number, number], time: number, rules: CurveRules): number {
  const { times, values } = keys;
  const last = times.length - 1;
  const [first, end] = [times[0], times[last]];
  const isBefore = time < first;
  if (!isBefore && time <= end) return inside(keys, time, rules);
  const at = isBefore ? 0 : last;
  const kind = isBefore === (rules.sides === 'own') ? keys.extrapolateIn : keys.extrapolateOut;
  if (kind === 'constant' || isHeld(isBefore, rules)) return values[at];
  if (kind === 'linear') return values[at] + endSlope(keys, isBefore, rules) * (time - times[at]);
  const length = end - first;
  if (!(length > 0)) return values[at];
  if (rules.period === 'range only' && time >= range[0] && time <= range[1]) return values[at];
  const folded = fold(keys, range, time, rules);
  const { period } = folded;
  const isUnmirrored = folded.isUnfolded && rules.modulo.includes('first');
  if (kind === 'bounce')
    return inside(
      keys,
      isMirrored(period, rules) && !isUnmirrored ? folded.mirrored : folded.time,
      rules,
      folded.runsOn,
    );
  const value = inside(keys, folded.time, rules, folded.runsOn);
  if (kind === 'cycle' || rules.cycleOffset === 'none') return value;
  return value + timesAdded(period, rules) * (values[last] - values[0]);
}

/** How often `cycle_offset` adds its offset. @param period 0 is that of the keys */
function timesAdded(period: number, { cycleOffset }: CurveRules): number {
  switch (cycleOffset) {
    case 'always added':
      return Math.abs(period);
    case 'once':
      return Math.sign(period);
    case 'once added':
      return Math.abs(Math.sign(period));
    case 'subtracted':
      return -period;
    case 'once more':
      return period + 1;
    case 'once further':
      return period + Math.sign(period);
    case 'once less':
      return period - 1;
    default:
      return period;
  }
}

function isHeld(isBefore: boolean, { held }: CurveRules): boolean {
  return held === 'outside' || held === (isBefore ? 'before' : 'after');
}

interface Folded {
  readonly period: number;
  readonly time: number;
  /** In a period that runs backwards. */
  readonly mirrored: number;
  /** Whether the time is left before the keys. */
  readonly isUnfolded: boolean;
  /** Whether a time outside the keys continues the segment at that end; else the key holds. */
  readonly runsOn: boolean;
}

function fold(
  { times }: Keys,
  range: readonly [number, number],
  time: number,
  { period: of, modulo }: CurveRules,
): Folded {
  const [first, end] = [times[0], times[times.length - 1]];
  const isOfRange = of !== 'keys' && range[1] > range[0];
  const start = isOfRange && of !== 'length of range' ? range[0] : first;
  const length = isOfRange ? range[1] - range[0] : end - first;
  const stop = start + length;
  let { period, since: rest } = repetitionAt(start, stop, time);
  const isUnfolded = modulo !== 'floor' && time < start && rest !== 0;
  if (isUnfolded) {
    rest -= length;
    if (!modulo.endsWith('floor')) period++;
  }
  return {
    period,
    time: start + rest,
    mirrored: stop - rest,
    isUnfolded,
    runsOn: modulo.startsWith('run on') || of === 'range, run on',
  };
}

function isMirrored(period: number, { bounce }: CurveRules): boolean {
  if (bounce === 'none') return false;
  if (bounce === 'odd after only') return period % 2 === 1;
  return (period % 2 !== 0) === (bounce === 'odd periods');
}

/** At a time between the keys; outside them the end keys hold, or the end segments run on. */
function inside(keys: KeyedCurve, time: number, rules: CurveRules, runsOn = false): number {
  const { times, values } = keys;
  const last = times.length - 1;
  if (!runsOn && time <= times[0] && times[0] !== times[Math.min(1, last)]) return values[0];
  if (!runsOn && time >= times[last]) return values[last];
  if (last === 0) return values[0];
  let key = time <= times[0] ? 0 : lastNotAbove(times, 0, times.length, time);
  if (key === last) key--;
  const h = times[key + 1] - times[key];
  if (!(h > 0)) return values[key + 1];
  const [p0, p1] = [values[key], values[key + 1]];
  const u = (time - times[key]) / h;
  if (rules.between === 'step') return u < 1 ? p0 : p1;
  if (rules.between === 'line') return p0 + (p1 - p0) * u;
  const scale = rules.isScaled ? h : 1;
  const m0 = scale * slopeBy(keys, key, 'out', rules);
  const m1 = scale * slopeBy(keys, key + 1, 'in', rules);
  const m = rules.basis;
  const a = m[0] * p0 + m[1] * p1 + m[2] * m0 + m[3] * m1;
  const b = m[4] * p0 + m[5] * p1 + m[6] * m0 + m[7] * m1;
  const c = m[8] * p0 + m[9] * p1 + m[10] * m0 + m[11] * m1;
  const d = m[12] * p0 + m[13] * p1 + m[14] * m0 + m[15] * m1;
  return ((a * u + b) * u + c) * u + d;
}

function endSlope(keys: KeyedCurve, isBefore: boolean, rules: CurveRules): number {
  const last = keys.times.length - 1;
  if (rules.linearSlope === 'segment')
    return isBefore ? secant(keys, 0, Math.min(1, last)) : secant(keys, Math.max(0, last - 1), last);
  const by: CurveRules = rules.swapsInsideOnly ? { ...rules, swapped: 'none' } : rules;
  const isOther =
    rules.linearSlope === 'other tangents' || rules.linearSlope === `other tangent ${isBefore ? 'before' : 'after'}`;
  return slopeBy(keys, isBefore ? 0 : last, isBefore === isOther ? 'out' : 'in', by);
}

/** The slope on one side of a key. */
function slopeBy(keys: KeyedCurve, key: number, side: 'in' | 'out', rules: CurveRules): number {
  const other = side === 'in' ? 'out' : 'in';
  const column = rules.swapped === 'none' ? side : other;
  const tangents = column === 'in' ? keys.tangentsIn : keys.tangentsOut;
  return slopeOf(keys, key, tangents, rules.swapped === 'slopes' ? other : side, rules);
}

function slopeOf(keys: KeyedCurve, key: number, tangents: Tangents, side: 'in' | 'out', rules: CurveRules): number {
  const last = keys.times.length - 1;
  const kind = tangents.kinds[key];
  if (kind === FLAT) return 0;
  if (kind === FIXED_TANGENT) return tangents.slopes[key];
  // In a file it is a number like any other.
  if (kind === AUTO_TANGENT) return autoSlope(keys, key);
  const isEnd = key === 0 || key === last;
  if (kind === SMOOTH && rules.smoothEnds === 'flat' && isEnd) return 0;
  if (kind === SMOOTH && rules.smooth === 'halved ends' && isEnd)
    return keys.values[Math.min(key + 1, last)] - keys.values[Math.max(key - 1, 0)];
  if (key === 0) return secant(keys, 0, Math.min(1, last));
  if (key === last) return secant(keys, last - 1, last);
  if (kind === SMOOTH) {
    if (rules.smooth === 'across') return secant(keys, key - 1, key + 1);
    if (rules.smooth.startsWith('halved')) return (keys.values[key + 1] - keys.values[key - 1]) / 2;
    return (secant(keys, key - 1, key) + secant(keys, key, key + 1)) / 2;
  }
  const isIn = (side === 'in') === (rules.linear === 'own side');
  return kind === LINEAR && isIn ? secant(keys, key - 1, key) : secant(keys, key, key + 1);
}

function secant({ times, values }: Keys, from: number, to: number): number {
  const slope = (values[to] - values[from]) / (times[to] - times[from]);
  return Number.isFinite(slope) ? slope : 0;
}
