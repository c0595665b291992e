/**
 * A channel as columns of pixels, with the smallest and largest value in each, for spans too narrow to tell apart.
 *
 * With few spans per column, each key and each extremum between keys is added to its column, and the curve's value at
 * each edge to the columns on both sides: no search, and one cubic per column. With many, each column queries its
 * extremes (`trace-extremes.ts`), which does not visit each key.
 */
import { lastNotAbove } from '../../math/search.ts';
import type { Channel } from '../../model/takes/take.ts';
import type { CompiledTake } from '../compiled-take.ts';
import { ChannelExtremes, type SpanExtremes } from './trace-extremes.ts';
import { FAR_PIXELS, heightOf, type TraceMap } from './trace-path.ts';

/** Kind of a column that the curve does not pass through. */
export const NO_COLUMN = 0;
/** Kind of a column in which the curve is drawn solid. */
export const SOLID_COLUMN = 1;
/** Kind of a column outside the keys, where they repeat: drawn dotted. */
export const DOTTED_COLUMN = 2;

/** Spans per column above which extremes are queried. */
const MANY_SPANS = 6;

const extremes = new ChannelExtremes();

/** A channel's extent in each column of pixels; reused from one channel to the next. */
export class TracedColumns {
  /** Extent of the curve in each column, CSS pixels. */
  tops = new Float32Array(0);
  bottoms = new Float32Array(0);
  /** NO_COLUMN, SOLID_COLUMN or DOTTED_COLUMN for each. */
  kinds = new Uint8Array(0);
  /** First used column, and one past the last. Equal if there is none. */
  from = 0;
  to = 0;
  /** Kept alive; otherwise it would be recomputed whenever the view moves. */
  private held: SpanExtremes | undefined;

  /** Forgets all columns; the arrays are kept. */
  clear(): void {
    this.from = this.to = 0;
  }

  /** Adds a time range within the channel's keys. @param perPixel columns per CSS pixel */
  keyed(
    curves: CompiledTake,
    index: number,
    channel: Channel,
    map: TraceMap,
    from: number,
    to: number,
    perPixel: number,
  ): void {
    this.held = extremes.open(curves, index, channel);
    const range = this.columnsOf(map, from, to, perPixel);
    if (!range || !this.held) return;
    const [begin, end] = range;
    const { times } = curves;
    const first = curves.firstKey[index];
    const last = curves.firstKey[index + 1] - 1;
    const left = lastNotAbove(times, first, last + 1, from);
    const right = lastNotAbove(times, first, last + 1, to);
    this.mark(begin, end, SOLID_COLUMN);
    if (right - left > MANY_SPANS * (end - begin)) {
      const perSecond = map.perSecond * perPixel;
      extremes.begin(Math.max(from, map.left + begin / perSecond));
      for (let i = begin; i < end; i++) {
        extremes.next(Math.min(to, map.left + (i + 1) / perSecond));
        this.include(i, heightOf(map, extremes.high), heightOf(map, extremes.low));
      }
      return;
    }
    this.edges(curves, last, left, map, from, to, begin, end, perPixel);
    this.points(curves, first, last, left, right, this.held.turns, map, from, to, begin, end, perPixel);
  }

  /** Adds a time range outside the channel's keys, where they repeat. */
  repeated(
    curves: CompiledTake,
    index: number,
    channel: Channel,
    map: TraceMap,
    from: number,
    to: number,
    perPixel: number,
  ): void {
    this.held = extremes.open(curves, index, channel);
    const range = this.columnsOf(map, from, to, perPixel);
    if (!range) return;
    const [begin, end] = range;
    const perSecond = map.perSecond * perPixel;
    this.mark(begin, end, DOTTED_COLUMN);
    for (let i = begin; i < end; i++) {
      extremes.over(Math.max(from, map.left + i / perSecond), Math.min(to, map.left + (i + 1) / perSecond));
      this.include(i, heightOf(map, extremes.high), heightOf(map, extremes.low));
    }
  }

  /**
   * Adds a time range whose columns the caller fills by `include`.
   * @returns the first of them and one past the last; undefined if the range is not visible
   */
  solid(map: TraceMap, from: number, to: number, perPixel: number): readonly [number, number] | undefined {
    const range = this.columnsOf(map, from, to, perPixel);
    if (range) this.mark(range[0], range[1], SOLID_COLUMN);
    return range;
  }

  /** Extends a column's extent, CSS pixels. */
  include(column: number, top: number, bottom: number): void {
    const { tops, bottoms } = this;
    if (top < tops[column]) tops[column] = top;
    if (bottom > bottoms[column]) bottoms[column] = bottom;
  }

  /** The columns of a time range; allocates them if needed. */
  private columnsOf(map: TraceMap, from: number, to: number, perPixel: number): [number, number] | undefined {
    const count = Math.ceil(map.width * perPixel);
    if (this.kinds.length !== count) {
      this.tops = new Float32Array(count);
      this.bottoms = new Float32Array(count);
      this.kinds = new Uint8Array(count);
    }
    if (this.from === this.to) this.kinds.fill(NO_COLUMN);
    const perSecond = map.perSecond * perPixel;
    const begin = Math.max(0, Math.floor((from - map.left) * perSecond));
    const end = Math.min(count, Math.ceil((to - map.left) * perSecond));
    return begin < end ? [begin, end] : undefined;
  }

  /** A column in which the keys end contains both kinds, and counts as solid. */
  private mark(begin: number, end: number, kind: number): void {
    const { tops, bottoms, kinds } = this;
    if (this.from === this.to) {
      tops.fill(Number.POSITIVE_INFINITY, begin, end);
      bottoms.fill(Number.NEGATIVE_INFINITY, begin, end);
      kinds.fill(kind, begin, end);
    }
    for (let i = begin; i < end && this.from < this.to; i++) {
      if (kinds[i] === NO_COLUMN) {
        tops[i] = Number.POSITIVE_INFINITY;
        bottoms[i] = Number.NEGATIVE_INFINITY;
      }
      if (kinds[i] !== SOLID_COLUMN) kinds[i] = kind;
    }
    const had = this.from < this.to;
    this.from = had ? Math.min(this.from, begin) : begin;
    this.to = had ? Math.max(this.to, end) : end;
  }

  /** Adds the value at each edge of columns `begin` … `end` to the columns on both sides. @param key at `from` */
  private edges(
    curves: CompiledTake,
    last: number,
    key: number,
    map: TraceMap,
    from: number,
    to: number,
    begin: number,
    end: number,
    perPixel: number,
  ): void {
    const { times, cubics } = curves;
    const { tops, bottoms } = this;
    const { left, low, perUnit, bottom } = map;
    const seconds = 1 / (map.perSecond * perPixel);
    const ceiling = map.top - FAR_PIXELS;
    const floor = bottom + FAR_PIXELS;
    for (let i = begin; i <= end; i++) {
      const time = Math.min(to, Math.max(from, left + i * seconds));
      while (key < last && times[key + 1] <= time) key++;
      const o = 4 * key;
      const t = time - times[key];
      const value =
        key === last ? cubics[o] : ((cubics[o + 3] * t + cubics[o + 2]) * t + cubics[o + 1]) * t + cubics[o];
      const y = Math.min(floor, Math.max(ceiling, bottom - (value - low) * perUnit));
      if (i > begin) {
        tops[i - 1] = Math.min(tops[i - 1], y);
        bottoms[i - 1] = Math.max(bottoms[i - 1], y);
      }
      if (i < end) {
        tops[i] = Math.min(tops[i], y);
        bottoms[i] = Math.max(bottoms[i], y);
      }
    }
  }

  /** Adds keys and extrema of the spans `leftKey` … `rightKey`, each to its column. @param turns see SpanExtremes */
  private points(
    curves: CompiledTake,
    first: number,
    last: number,
    leftKey: number,
    rightKey: number,
    turns: Float64Array,
    map: TraceMap,
    from: number,
    to: number,
    begin: number,
    end: number,
    perPixel: number,
  ): void {
    const { times, cubics } = curves;
    const { tops, bottoms } = this;
    const { left, low, perUnit, bottom } = map;
    const perSecond = map.perSecond * perPixel;
    const ceiling = map.top - FAR_PIXELS;
    const floor = bottom + FAR_PIXELS;
    for (let key = leftKey; key <= rightKey; key++) {
      const begins = times[key];
      const o = 4 * key;
      if (begins >= from) {
        const column = Math.min(end - 1, Math.max(begin, Math.floor((begins - left) * perSecond)));
        const y = Math.min(floor, Math.max(ceiling, bottom - (cubics[o] - low) * perUnit));
        tops[column] = Math.min(tops[column], y);
        bottoms[column] = Math.max(bottoms[column], y);
      }
      if (key === last) break;
      for (let i = 2 * (key - first); i < 2 * (key - first) + 2; i++) {
        const t = turns[i];
        const time = begins + t;
        // NaN if the span has no extremum.
        if (!(time >= from && time <= to)) continue;
        const value = ((cubics[o + 3] * t + cubics[o + 2]) * t + cubics[o + 1]) * t + cubics[o];
        const column = Math.min(end - 1, Math.max(begin, Math.floor((time - left) * perSecond)));
        const y = Math.min(floor, Math.max(ceiling, bottom - (value - low) * perUnit));
        tops[column] = Math.min(tops[column], y);
        bottoms[column] = Math.max(bottoms[column], y);
      }
    }
  }
}
