/**
 * Weighted sums of channels over time, for layers: between two keys of all its channels, a sum is one cubic, and so are
 * extrapolated parts between two repeated keys. That cubic is kept until the first time that it doesn't hold for.
 * Playing, few times in a row do that, so a frame costs a comparison and a cubic for each sum, however many channels it
 * has.
 *
 *     channel      •────────•──────────────•
 *     channel         •─────────•─────•─────────•
 *     cubics of    ┊  ┊     ┊   ┊     ┊    ┊    ┊
 *     their sum
 *
 * What is kept is determined by the time alone, so that a value never depends on the times before it, up to rounding.
 */
import { lastNotAbove } from '../math/search.ts';
import { EXTRAPOLATIONS } from '../model/takes/take.ts';
import type { CompiledTake } from './compiled-take.ts';
import { evaluateChannel, repetitionAt } from './curves.ts';

/** A channel of a sum, and its factor. */
export interface PieceTerm {
  readonly curves: CompiledTake;
  readonly channel: number;
  readonly factor: number;
}

const CONSTANT = EXTRAPOLATIONS.indexOf('constant');
const LINEAR = EXTRAPOLATIONS.indexOf('linear');
const CYCLE_OFFSET = EXTRAPOLATIONS.indexOf('cycle_offset');
const BOUNCE = EXTRAPOLATIONS.indexOf('bounce');

/** Near a seam of repetitions the evaluation of single channels decides which of them a time is in. */
const SEAM = 16 * Number.EPSILON;

/** Sums of channels, each ready for evaluation. */
export class PieceSums {
  /** The sums at the time that was evaluated last. */
  readonly values: Float64Array;
  /** Times that the cubic of each sum holds for: from, up to (excluding). */
  private readonly from: Float64Array;
  private readonly to: Float64Array;
  private readonly origin: Float64Array;
  private readonly cubics: Float64Array;
  private readonly terms: readonly (readonly PieceTerm[])[];

  /** @param sums without samples */
  constructor(sums: readonly (readonly PieceTerm[])[]) {
    this.terms = sums;
    const column = () => new Float64Array(sums.length);
    [this.values, this.from, this.to, this.origin] = [column(), column(), column(), column()];
    this.from.fill(Number.POSITIVE_INFINITY);
    this.cubics = new Float64Array(4 * sums.length);
  }

  /** Writes the sums at a time to `values`. Allocates nothing while the cubics hold. */
  evaluate(timeSeconds: number): void {
    const { values, from, to, origin, cubics } = this;
    for (let i = 0; i < values.length; i++) {
      // Also false for NaN.
      if (!(timeSeconds >= from[i] && timeSeconds < to[i]) && !this.find(i, timeSeconds)) {
        values[i] = this.direct(i, timeSeconds);
        continue;
      }
      const since = timeSeconds - origin[i];
      const o = 4 * i;
      const value = ((cubics[o + 3] * since + cubics[o + 2]) * since + cubics[o + 1]) * since + cubics[o];
      values[i] = Number.isFinite(value) ? value : this.direct(i, timeSeconds);
    }
  }

  private direct(sum: number, time: number): number {
    let value = 0;
    for (const { curves, channel, factor } of this.terms[sum]) value += factor * evaluateChannel(curves, channel, time);
    return value;
  }

  /** Finds the cubic that holds for a time; false if there is none. */
  private find(sum: number, time: number): boolean {
    const { from, to, origin, cubics } = this;
    const terms = this.terms[sum];
    if (!Number.isFinite(time)) return false;
    let start = Number.NEGATIVE_INFINITY;
    let end = Number.POSITIVE_INFINITY;
    for (const { curves, channel } of terms) {
      if (!findPiece(curves, channel, time)) return false;
      start = Math.max(start, piece.from);
      end = Math.min(end, piece.to);
    }
    // One channel keeps the cubic that it has.
    const about = terms.length === 1 ? piece.origin : Number.isFinite(start) ? start : Number.isFinite(end) ? end : 0;
    const o = 4 * sum;
    cubics.fill(0, o, o + 4);
    for (const { curves, channel, factor } of terms) {
      if (terms.length > 1) findPiece(curves, channel, time);
      const { a, b, c, d } = piece;
      const by = about - piece.origin;
      cubics[o] += factor * (((d * by + c) * by + b) * by + a);
      cubics[o + 1] += factor * ((3 * d * by + 2 * c) * by + b);
      cubics[o + 2] += factor * (3 * d * by + c);
      cubics[o + 3] += factor * d;
    }
    from[sum] = start;
    to[sum] = end;
    origin[sum] = about;
    return true;
  }
}

/** Scratch of `findPiece`: a + b·τ + c·τ² + d·τ³, τ the time since `origin`, and the times that it holds for. */
const piece = { a: 0, b: 0, c: 0, d: 0, origin: 0, from: 0, to: 0 };

/** Writes the cubic of a channel at a time to `piece`; false if there is none, as just at a seam. */
function findPiece(curves: CompiledTake, channel: number, time: number): boolean {
  const { firstKey, times, extrapolations, beyond } = curves;
  const first = firstKey[channel];
  const last = firstKey[channel + 1] - 1;
  if (last < first) return setLine(0, 0, 0, Number.NEGATIVE_INFINITY, Number.POSITIVE_INFINITY);
  const [start, stop] = [times[first], times[last]];
  if (time >= start && time < stop) {
    const key = lastNotAbove(times, first, last + 1, time);
    return setCubic(curves, key, times[key], times[key], times[key + 1]);
  }
  const isBefore = time < start;
  const code = extrapolations[2 * channel + (isBefore ? 0 : 1)];
  if (code !== CONSTANT && code !== LINEAR) return findRepeated(curves, channel, code, time);
  const slope = code === LINEAR ? beyond[4 * channel + (isBefore ? 2 : 3)] : 0;
  const value = curves.cubics[4 * (isBefore ? first : last)];
  return isBefore
    ? setLine(value, slope, start, Number.NEGATIVE_INFINITY, start)
    : setLine(value, slope, stop, stop, Number.POSITIVE_INFINITY);
}

function findRepeated(curves: CompiledTake, channel: number, code: number, time: number): boolean {
  const { firstKey, times, beyond } = curves;
  const first = firstKey[channel];
  const last = firstKey[channel + 1] - 1;
  const [start, stop] = [times[first], times[last]];
  // The last key itself is none of its repetitions.
  if (time === stop) return false;
  const { period, since } = repetitionAt(start, stop, time);
  const begin = start + period * beyond[4 * channel];
  const isMirrored = code === BOUNCE && period % 2 !== 0;
  const within = isMirrored ? stop - since : start + since;
  const key = lastNotAbove(times, first, last + 1, within);
  if (!(within >= start) || key === last) return false;
  const [low, high] = isMirrored
    ? [begin + (stop - times[key + 1]), begin + (stop - times[key])]
    : [begin + (times[key] - start), begin + (times[key + 1] - start)];
  const margin = SEAM * Math.max(Math.abs(low), Math.abs(high), Math.abs(start), Math.abs(stop));
  const [from, to] = [low + margin, high - margin];
  if (!(time >= from && time < to)) return false;
  setCubic(curves, key, low, from, to);
  if (isMirrored) mirror(times[key + 1] - times[key]);
  if (code === CYCLE_OFFSET) piece.a += period * beyond[4 * channel + 1];
  return true;
}

/** The cubic run backwards: its origin becomes its end. */
function mirror(length: number): void {
  const { a, b, c, d } = piece;
  piece.a = ((d * length + c) * length + b) * length + a;
  piece.b = -((3 * d * length + 2 * c) * length + b);
  piece.c = 3 * d * length + c;
  piece.d = -d;
}

function setCubic({ cubics }: CompiledTake, key: number, origin: number, from: number, to: number): true {
  const o = 4 * key;
  [piece.a, piece.b, piece.c, piece.d] = [cubics[o], cubics[o + 1], cubics[o + 2], cubics[o + 3]];
  [piece.origin, piece.from, piece.to] = [origin, from, to];
  return true;
}

function setLine(value: number, slope: number, origin: number, from: number, to: number): true {
  [piece.a, piece.b, piece.c, piece.d] = [value, slope, 0, 0];
  [piece.origin, piece.from, piece.to] = [origin, from, to];
  return true;
}
