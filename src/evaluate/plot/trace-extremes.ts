/**
 * Exact smallest and largest value of a channel over a time range: at the ends, and at the extrema of cubics.
 *
 *     p′(τ) = b + 2c·τ + 3d·τ² = 0      τ = q / 3d, b / q      q = −(c ± √(c² − 3bd)), the sign that does not cancel
 *
 * The extremes of each span are stored with the channel, and above them those of 16 spans, of 16 times 16 …, so that a
 * pixel that covers ten thousand keys takes a few dozen comparisons. For consecutive ranges, such as the columns of a
 * picture, each continues where the last ended, with one evaluation and no search.
 */
import { lastNotAbove } from '../../math/search.ts';
import { type Channel, EXTRAPOLATIONS } from '../../model/takes/take.ts';
import type { CompiledTake } from '../compiled-take.ts';
import { evaluateChannel } from '../curves.ts';
import { extremesOver } from './sample-extremes.ts';

const BLOCK = 16;
const CYCLE = EXTRAPOLATIONS.indexOf('cycle');
const CYCLE_OFFSET = EXTRAPOLATIONS.indexOf('cycle_offset');
const BOUNCE = EXTRAPOLATIONS.indexOf('bounce');
/** Neighbours to try before a binary search. */
const NEAR = 4;

/** Extremes of the spans between a channel's keys. */
export interface SpanExtremes {
  /** Level 0 has an entry per span, each level above one per up to 16 of those below. The last has one. */
  readonly lows: readonly Float64Array[];
  readonly highs: readonly Float64Array[];
  /** Two per span: times of its extrema, in seconds since its key; NaN for none. */
  readonly turns: Float64Array;
}

/** Held weakly, as long as some picture shows the channel: the history keeps hundreds of channels. */
const known = new WeakMap<Channel, WeakRef<SpanExtremes>>();

/** @param index of `channel` in the compiled take; it has at least two keys */
function spanExtremes(curves: CompiledTake, index: number, channel: Channel): SpanExtremes {
  const before = known.get(channel)?.deref();
  if (before) return before;
  const first = curves.firstKey[index];
  const count = curves.firstKey[index + 1] - 1 - first;
  const low = new Float64Array(count);
  const high = new Float64Array(count);
  const turns = new Float64Array(2 * count);
  for (let s = 0; s < count; s++) {
    const k = first + s;
    cubicExtremes(curves.cubics, 4 * k, 0, curves.times[k + 1] - curves.times[k]);
    low[s] = foundLow;
    high[s] = foundHigh;
    turns[2 * s] = foundTurn;
    turns[2 * s + 1] = foundOtherTurn;
  }
  const lows: Float64Array[] = [low];
  const highs: Float64Array[] = [high];
  for (let below = count; below > 1; below = lows[lows.length - 1].length) {
    lows.push(smallestOfBlocks(lows[lows.length - 1]));
    highs.push(largestOfBlocks(highs[highs.length - 1]));
  }
  const made = { lows, highs, turns };
  known.set(channel, new WeakRef(made));
  return made;
}

function smallestOfBlocks(values: Float64Array): Float64Array {
  const blocks = new Float64Array(Math.ceil(values.length / BLOCK)).fill(Number.POSITIVE_INFINITY);
  for (let i = 0; i < values.length; i++) if (values[i] < blocks[(i / BLOCK) | 0]) blocks[(i / BLOCK) | 0] = values[i];
  return blocks;
}

function largestOfBlocks(values: Float64Array): Float64Array {
  const blocks = new Float64Array(Math.ceil(values.length / BLOCK)).fill(Number.NEGATIVE_INFINITY);
  for (let i = 0; i < values.length; i++) if (values[i] > blocks[(i / BLOCK) | 0]) blocks[(i / BLOCK) | 0] = values[i];
  return blocks;
}

let foundLow = 0;
let foundHigh = 0;
let foundTurn = 0;
let foundOtherTurn = 0;

/** Writes the extremes of the cubic at `o` for τ from `from` to `to` (not before it), and its extrema, to `found…`. */
function cubicExtremes(cubics: Float64Array, o: number, from: number, to: number): void {
  const a = cubics[o];
  const b = cubics[o + 1];
  const c = cubics[o + 2];
  const d = cubics[o + 3];
  const start = ((d * from + c) * from + b) * from + a;
  const end = ((d * to + c) * to + b) * to + a;
  foundLow = start < end ? start : end;
  foundHigh = start < end ? end : start;
  foundTurn = foundOtherTurn = Number.NaN;
  // Most spans are monotonic, which is detected without a root: both slopes within 0 … 3 secants (Fritsch, Carlson).
  const h = to - from;
  const rise = end < start ? start - end : end - start;
  const sign = end < start ? -h : h;
  const slope0 = ((3 * d * from + 2 * c) * from + b) * sign;
  const slope1 = ((3 * d * to + 2 * c) * to + b) * sign;
  if (slope0 >= 0 && slope1 >= 0 && slope0 <= 3 * rise && slope1 <= 3 * rise) return;
  const discriminant = c * c - 3 * b * d;
  if (!(discriminant > 0)) return;
  const root = Math.sqrt(discriminant);
  const q = c > 0 ? -c - root : root - c;
  for (let i = 0; i < 2; i++) {
    const at = i === 0 ? q / (3 * d) : b / q;
    if (!(at > from && at < to)) continue;
    if (i === 0) foundTurn = at;
    else foundOtherTurn = at;
    const value = ((d * at + c) * at + b) * at + a;
    if (value < foundLow) foundLow = value;
    if (value > foundHigh) foundHigh = value;
  }
}

/** Queries one channel at a time, keyed or sampled; reuse it by opening the next. */
export class ChannelExtremes {
  /** Smallest value of the last range queried. */
  low = 0;
  high = 0;
  private curves: CompiledTake | undefined;
  private index = 0;
  private times: Float64Array = new Float64Array(0);
  private cubics: Float64Array = new Float64Array(0);
  private first = 0;
  /** The last key. */
  private last = 0;
  private lowLevels: readonly Float64Array[] = [];
  private highLevels: readonly Float64Array[] = [];
  private turns: Float64Array = new Float64Array(0);
  /** Result of the last search. */
  private key = 0;
  /** Where `next` continues: time since the key, and the value there. */
  private since = 0;
  private value = 0;
  /** The repetition that `next` is in, and the key time that it reached. */
  private sweptPeriod = Number.NaN;
  private sweptTo = 0;

  /**
   * Starts queries of a channel of the compiled take.
   * @returns an object to keep alive while the channel is queried repeatedly
   */
  open(curves: CompiledTake, index: number, channel: Channel): SpanExtremes | undefined {
    this.curves = curves;
    this.index = index;
    this.times = curves.times;
    this.cubics = curves.cubics;
    this.first = curves.firstKey[index];
    this.last = curves.firstKey[index + 1] - 1;
    this.key = this.first;
    this.sweptPeriod = Number.NaN;
    if (this.last <= this.first) return undefined;
    const spans = spanExtremes(curves, index, channel);
    this.lowLevels = spans.lows;
    this.highLevels = spans.highs;
    this.turns = spans.turns;
    return spans;
  }

  /** Extremes of the evaluated values from one take time to another, not before it, both included. */
  over(from: number, to: number): void {
    this.low = Number.POSITIVE_INFINITY;
    this.high = Number.NEGATIVE_INFINITY;
    if (!this.curves) return;
    const { samples, columns } = this.curves;
    if (samples && columns[this.index] >= 0) {
      ({ low: this.low, high: this.high } = extremesOver(samples, columns[this.index], from, to));
      return;
    }
    const start = this.times[this.first];
    const stop = this.times[this.last];
    if (this.last <= this.first || !(stop > start)) {
      this.ends(from, to);
      return;
    }
    if (from < start) this.outside(from, Math.min(to, start), 0);
    if (to > stop) this.outside(Math.max(from, stop), to, 1);
    if (from <= stop && to >= start) this.keyed(Math.max(from, start), Math.min(to, stop), 0);
  }

  /** Positions `next` at a time within the keys. */
  begin(from: number): void {
    const key = this.seek(from);
    this.since = from - this.times[key];
    this.value = this.valueAt(key, this.since);
  }

  /**
   * Extremes from where the last range ended (or `begin`) to a time not before it, within the keys: the same as `over`,
   * for consecutive ranges.
   */
  next(to: number): void {
    // Inlined with local variables: pictures of a hundred dense channels depend on it.
    const { times, cubics, turns, first, last } = this;
    let { key, since, value } = this;
    let low = value;
    let high = value;
    let until = to - times[key];
    while (true) {
      const ends = key < last && times[key + 1] <= to;
      const o = 2 * (key - first);
      const turn = turns[o];
      const other = turns[o + 1];
      // NaN if there is no extremum.
      if (turn > since && (ends || turn < until)) {
        const turned = this.valueAt(key, turn);
        low = Math.min(low, turned);
        high = Math.max(high, turned);
      }
      if (other > since && (ends || other < until)) {
        const turned = this.valueAt(key, other);
        low = Math.min(low, turned);
        high = Math.max(high, turned);
      }
      if (!ends) break;
      key++;
      if (key + 2 <= last && times[key + 2] <= to) {
        const begin = key;
        this.key = key;
        key = this.seek(to);
        this.low = low;
        this.high = high;
        this.whole(begin - first, key - first, 0);
        low = this.low;
        high = this.high;
      }
      const o4 = 4 * key;
      value = cubics[o4];
      low = Math.min(low, value);
      high = Math.max(high, value);
      since = 0;
      until = to - times[key];
    }
    const o = 4 * key;
    value =
      key === last ? cubics[o] : ((cubics[o + 3] * until + cubics[o + 2]) * until + cubics[o + 1]) * until + cubics[o];
    this.low = value < low ? value : low;
    this.high = value > high ? value : high;
    this.value = value;
    this.since = until;
    this.key = key;
  }

  private valueAt(key: number, t: number): number {
    const { cubics } = this;
    const o = 4 * key;
    return key === this.last ? cubics[o] : ((cubics[o + 3] * t + cubics[o + 2]) * t + cubics[o + 1]) * t + cubics[o];
  }

  /**
   * Extremes from one time to another within the keys, with an offset on the values; merges into the current result.
   */
  private keyed(from: number, to: number, add: number): void {
    this.sweptPeriod = Number.NaN;
    const { times, cubics, first, last } = this;
    let key = this.seek(from);
    let spanEnd = key < last ? times[key + 1] : times[last];
    if (key === last || to < spanEnd) {
      this.part(key, from - times[key], to - times[key], add);
      return;
    }
    this.part(key, from - times[key], spanEnd - times[key], add);
    const begin = key + 1;
    this.key = begin;
    key = this.seek(to);
    this.whole(begin - first, key - first, add);
    spanEnd = times[key];
    if (key < last) this.part(key, 0, to - spanEnd, add);
    else this.include(cubics[4 * last] + add);
  }

  /** Part of one span: its ends and extrema. */
  private part(key: number, from: number, to: number, add: number): void {
    const { cubics, turns } = this;
    if (key === this.last) {
      this.include(cubics[4 * key] + add);
      return;
    }
    this.include(this.valueAt(key, from) + add);
    this.include(this.valueAt(key, to) + add);
    const o = 2 * (key - this.first);
    for (let i = o; i < o + 2; i++)
      if (turns[i] > from && turns[i] < to) this.include(this.valueAt(key, turns[i]) + add);
  }

  private include(value: number): void {
    if (value < this.low) this.low = value;
    if (value > this.high) this.high = value;
  }

  /** Spans `from` up to (excluding) `to`, counted from the channel's first. */
  private whole(from: number, to: number, add: number): void {
    const { lowLevels, highLevels } = this;
    let low = Number.POSITIVE_INFINITY;
    let high = Number.NEGATIVE_INFINITY;
    for (let level = 0; from < to; level++) {
      const lows = lowLevels[level];
      const highs = highLevels[level];
      const top = level + 1 === lowLevels.length || to - from < 2 * BLOCK;
      while (from < to && (top || from % BLOCK !== 0)) {
        if (lows[from] < low) low = lows[from];
        if (highs[from] > high) high = highs[from];
        from++;
      }
      while (from < to && to % BLOCK !== 0) {
        to--;
        if (lows[to] < low) low = lows[to];
        if (highs[to] > high) high = highs[to];
      }
      from /= BLOCK;
      to /= BLOCK;
    }
    if (low + add < this.low) this.low = low + add;
    if (high + add > this.high) this.high = high + add;
  }

  /** Before the keys (`side` 0) or after them (1): straight lines, or repetitions of the keys. */
  private outside(from: number, to: number, side: 0 | 1): void {
    const { curves, index, times, first, last } = this;
    if (!curves) return;
    const code = curves.extrapolations[2 * index + side];
    if (code !== CYCLE && code !== CYCLE_OFFSET && code !== BOUNCE) {
      this.ends(from, to);
      return;
    }
    const start = times[first];
    const length = curves.beyond[4 * index];
    const drift = code === CYCLE_OFFSET ? curves.beyond[4 * index + 1] : 0;
    // Includes what the evaluator snaps to the start of the next period.
    to += 8 * Number.EPSILON * Math.max(Math.abs(to), Math.abs(start), Math.abs(times[last]));
    // Rounding may move a boundary to the neighbouring repetition, but never into the keys themselves.
    const least = side === 0 ? Number.NEGATIVE_INFINITY : 1;
    const most = side === 0 ? -1 : Number.POSITIVE_INFINITY;
    const begin = Math.min(most, Math.max(least, Math.floor((from - start) / length)));
    const end = Math.min(most, Math.max(begin, Math.floor((to - start) / length)));
    const since = from - start - begin * length;
    const until = to - start - end * length;
    if (begin === end) {
      if (code === BOUNCE && begin % 2 !== 0) this.period(begin, since, until, code, drift);
      else this.sweep(begin, Math.min(times[last], start + since), Math.min(times[last], start + until), drift);
      return;
    }
    this.period(begin, since, length, code, drift);
    this.period(end, 0, until, code, drift);
    if (end - begin < 2) return;
    const count = this.last - this.first;
    this.whole(0, count, drift * (begin + 1));
    if (drift !== 0) this.whole(0, count, drift * (end - 1));
  }

  /** Part of one repetition, usually adjacent to the previous part. */
  private sweep(period: number, from: number, to: number, drift: number): void {
    const { low, high } = this;
    const gap = from - this.sweptTo;
    if (this.sweptPeriod !== period || !(Math.abs(gap) <= 1e-12 * (Math.abs(from) + 1))) this.begin(from);
    this.next(Math.max(from, to));
    this.sweptPeriod = period;
    this.sweptTo = Math.max(from, to);
    this.low = Math.min(low, this.low + drift * period);
    this.high = Math.max(high, this.high + drift * period);
  }

  /** Part of one repetition. */
  private period(period: number, since: number, until: number, code: number, drift: number): void {
    const start = this.times[this.first];
    const stop = this.times[this.last];
    const mirrored = code === BOUNCE && period % 2 !== 0;
    const from = mirrored ? stop - until : start + since;
    const to = mirrored ? stop - since : start + until;
    const low = Math.min(stop, Math.max(start, from));
    this.keyed(low, Math.min(stop, Math.max(low, to)), drift * period);
  }

  private ends(from: number, to: number): void {
    if (!this.curves) return;
    this.include(evaluateChannel(this.curves, this.index, from));
    this.include(evaluateChannel(this.curves, this.index, to));
  }

  /** The last key not after a time. */
  private seek(time: number): number {
    const { times, last } = this;
    let key = this.key;
    if (times[key] <= time) {
      for (let i = 0; i < NEAR; i++) {
        if (key === last || times[key + 1] > time) {
          this.key = key;
          return key;
        }
        key++;
      }
      key = lastNotAbove(times, key, last + 1, time);
    } else key = lastNotAbove(times, this.first, key + 1, time);
    this.key = key;
    return key;
  }
}
