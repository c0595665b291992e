/**
 * Keys for functions of time that are no curves: each span between two given times is a cubic by its values and slopes
 * at both ends, cut in two where that is off by more than a tolerance.
 */
import { hermiteCubic } from '../../math/hermite.ts';
import { KeyList } from './key-list.ts';

/** Writes `width` values of a time; angles are those nearest to `near`. */
export type Fitted = (time: number, near: Float64Array, out: Float64Array) => void;

/** Cuts of a span; real motion needs few. */
const MAX_CUTS = 8;
/** Where a span is compared with the function. */
const CHECKED = [0.1, 0.3, 0.5, 0.7, 0.9];
/** How far from its end, as part of a span, slopes are measured. */
const STEP = 1e-4;

/**
 * Fits keys to functions of time, between stops.
 * @param stops ascending, at least one: where the function may jump or bend
 * @param start the values nearest to which the first ones are
 * @param tolerances one per value
 * @param most keys until which spans are cut
 * @returns the keys of each value, all at the same times
 */
export function fitKeys(
  write: Fitted,
  stops: readonly number[],
  start: ArrayLike<number>,
  tolerances: readonly number[],
  most = Number.POSITIVE_INFINITY,
): KeyList[] {
  const width = tolerances.length;
  const lists = tolerances.map(() => new KeyList());
  const last = Float64Array.from(start);
  const value = new Float64Array(width);
  write(stops[0], last, value);
  last.set(value);
  for (let k = 0; k < width; k++) lists[k].add(stops[0], value[k], 0, 0);
  const span = new Span(write, width, tolerances, most);
  for (let i = 0; i < stops.length; i++) {
    if (i > 0) span.fit(stops[i - 1], stops[i], last, lists, 0);
    // What the function is from here on, if it jumps.
    write(stops[i], last, value);
    if (i + 1 < stops.length) span.writeOnwards(stops[i], stops[i + 1], last, value);
    let jumps = false;
    for (let k = 0; k < width; k++) jumps ||= Math.abs(value[k] - last[k]) > tolerances[k];
    if (jumps) for (let k = 0; k < width; k++) lists[k].add(stops[i], value[k], 0, 0);
    last.set(value);
  }
  return lists;
}

class Span {
  private readonly a: Float64Array;
  private readonly b: Float64Array;
  private readonly c: Float64Array;
  private readonly end: Float64Array;
  private readonly from: Float64Array;
  private readonly to: Float64Array;
  private readonly expected: Float64Array;
  private readonly cubics: Float64Array;

  constructor(
    private readonly write: Fitted,
    private readonly width: number,
    private readonly tolerances: readonly number[],
    private readonly most: number,
  ) {
    const scratch = () => new Float64Array(width);
    [this.a, this.b, this.c, this.end] = [scratch(), scratch(), scratch(), scratch()];
    [this.from, this.to, this.expected] = [scratch(), scratch(), scratch()];
    this.cubics = new Float64Array(4 * width);
  }

  /**
   * Replaces the values at a time by those just after it, where they differ: what holds the value of the next key has
   * its own at its key only, and times may differ by the rounding of repetitions.
   */
  writeOnwards(start: number, stop: number, last: Float64Array, values: Float64Array): void {
    const { a, b, c, tolerances, width } = this;
    const step = (stop - start) * STEP;
    this.write(start + step, last, a);
    this.write(start + 2 * step, a, b);
    this.write(start + 3 * step, b, c);
    let jumps = false;
    for (let k = 0; k < width; k++) jumps ||= Math.abs(3 * a[k] - 3 * b[k] + c[k] - values[k]) > tolerances[k];
    if (jumps) for (let k = 0; k < width; k++) values[k] = 3 * a[k] - 3 * b[k] + c[k];
  }

  /** Appends what leads from one time, whose values are `last`, to another, whose values `last` then is. */
  fit(start: number, stop: number, last: Float64Array, lists: readonly KeyList[], cuts: number): void {
    const { a, b, c, end, from, to, width } = this;
    const duration = stop - start;
    const step = duration * STEP;
    this.write(start + step, last, a);
    this.write(start + 2 * step, a, b);
    for (let k = 0; k < width; k++) from[k] = (4 * a[k] - b[k] - 3 * last[k]) / (2 * step);
    // The end is approached from its left, where the function may jump.
    this.write(stop - step, last, a);
    this.write(stop - 2 * step, a, b);
    this.write(stop - 3 * step, b, c);
    for (let k = 0; k < width; k++) {
      end[k] = 3 * a[k] - 3 * b[k] + c[k];
      to[k] = (5 * a[k] - 8 * b[k] + 3 * c[k]) / (2 * step);
    }
    if (cuts < MAX_CUTS && lists[0].count < this.most && !this.holds(start, duration, last)) {
      const middle = start + duration / 2;
      this.fit(start, middle, last, lists, cuts + 1);
      this.fit(middle, stop, last, lists, cuts + 1);
      return;
    }
    for (let k = 0; k < width; k++) {
      lists[k].leave(from[k]);
      lists[k].add(stop, end[k], to[k], to[k]);
    }
    last.set(end);
  }

  private holds(start: number, duration: number, last: Float64Array): boolean {
    const { end, from, to, a, cubics, expected, width, tolerances } = this;
    for (let k = 0; k < width; k++) hermiteCubic(last[k], from[k], end[k], to[k], duration, cubics, 4 * k);
    for (let i = 0; i < CHECKED.length; i++) {
      const since = CHECKED[i] * duration;
      for (let k = 0; k < width; k++) {
        const o = 4 * k;
        expected[k] = ((cubics[o + 3] * since + cubics[o + 2]) * since + cubics[o + 1]) * since + cubics[o];
      }
      this.write(start + since, expected, a);
      for (let k = 0; k < width; k++) if (!(Math.abs(a[k] - expected[k]) <= tolerances[k])) return false;
    }
    return true;
  }
}
