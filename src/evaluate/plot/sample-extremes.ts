/**
 * Smallest and largest sample of a column over a range of frames, for pixels that cover hundreds of frames.
 *
 *     level 0     the samples themselves        v₀ v₁ … v₁₅ │ v₁₆ …
 *     level 1     of each 16 of them            one entry   │ one …
 *     level 2     of each 16 entries below      one …
 *
 * A range takes a few dozen entries, whatever its length. A column's levels are built on first use; for many columns
 * they are built together, row by row (`building`), since a single column jumps through memory. 20 million samples take
 * about 0.1 s in rows, in slices.
 *
 * Values are those of the file; the caller applies the scale. Overshoot of cubics between frames is ignored: it is
 * invisible when frames are.
 */
import { rangeOfSamples, type Samples } from '../../model/takes/samples.ts';
import { sampleColumn } from '../samples/sampling.ts';

const BLOCK = 16;
/** Samples that `building` processes before it yields. */
const SLICE_SAMPLES = 1 << 17;

/** Level 1 and up of one column: an entry per up to 16 of those below. The last level has one. */
interface Levels {
  readonly lows: Float64Array[];
  readonly highs: Float64Array[];
}

const known = new WeakMap<Float64Array, SampleExtremes>();

/** The extremes of these samples' values, cached. */
export function sampleExtremes(samples: Samples): SampleExtremes {
  let made = known.get(samples.values);
  if (!made) {
    made = new SampleExtremes(samples.values, samples.scales.length, samples.frameCount);
    known.set(samples.values, made);
  }
  return made;
}

class SampleExtremes {
  /** Smallest value of the last range queried. */
  low = 0;
  high = 0;
  private readonly columns: (Levels | undefined)[] = [];

  constructor(
    private readonly values: Float64Array,
    private readonly width: number,
    private readonly frameCount: number,
  ) {}

  /** Frames `from` to `to`, both included and valid, `from` not after `to`. */
  over(column: number, from: number, to: number): void {
    const { values, width } = this;
    let low = Number.POSITIVE_INFINITY;
    let high = Number.NEGATIVE_INFINITY;
    let first = from;
    let end = to + 1;
    // Samples up to block boundaries, then blocks, then blocks of blocks.
    const wide = end - first >= 2 * BLOCK;
    const headEnd = wide ? Math.ceil(first / BLOCK) * BLOCK : end;
    for (let at = first * width + column; first < headEnd; first++, at += width) {
      const value = values[at];
      if (value < low) low = value;
      if (value > high) high = value;
    }
    const tail = wide ? end - (end % BLOCK) : end;
    for (let f = tail, at = f * width + column; f < end; f++, at += width) {
      const value = values[at];
      if (value < low) low = value;
      if (value > high) high = value;
    }
    if (wide) {
      const { lows, highs } = this.levels(column);
      first /= BLOCK;
      end = tail / BLOCK;
      for (let level = 0; first < end; level++) {
        const l = lows[level];
        const h = highs[level];
        const top = level + 1 === lows.length || end - first < 2 * BLOCK;
        while (first < end && (top || first % BLOCK !== 0)) {
          if (l[first] < low) low = l[first];
          if (h[first] > high) high = h[first];
          first++;
        }
        while (first < end && end % BLOCK !== 0) {
          end--;
          if (l[end] < low) low = l[end];
          if (h[end] > high) high = h[end];
        }
        first /= BLOCK;
        end /= BLOCK;
      }
    }
    this.low = low;
    this.high = high;
  }

  /** Builds the levels of all columns, yielding now and then. Single columns are built on demand. */
  *building(): Generator<void, void> {
    const { values, width, frameCount, columns } = this;
    if (frameCount < 2 * BLOCK) return;
    const missing = Array.from({ length: width }, (_, c) => c).filter((c) => !columns[c]);
    if (missing.length === 0) return;
    const count = Math.ceil(frameCount / BLOCK);
    const lows = missing.map(() => new Float64Array(count));
    const highs = missing.map(() => new Float64Array(count));
    const low = new Float64Array(width);
    const high = new Float64Array(width);
    const blocksASlice = Math.max(1, Math.floor(SLICE_SAMPLES / (BLOCK * width)));
    for (let b = 0; b < count; b++) {
      const begin = b * BLOCK;
      const end = Math.min(frameCount, begin + BLOCK);
      low.set(values.subarray(begin * width, (begin + 1) * width));
      high.set(low);
      for (let at = (begin + 1) * width, c = 0; at < end * width; at++) {
        const value = values[at];
        if (value < low[c]) low[c] = value;
        else if (value > high[c]) high[c] = value;
        if (++c === width) c = 0;
      }
      for (let m = 0; m < missing.length; m++) {
        lows[m][b] = low[missing[m]];
        highs[m][b] = high[missing[m]];
      }
      if (b % blocksASlice === blocksASlice - 1) yield;
    }
    const columnsASlice = Math.max(1, Math.floor(SLICE_SAMPLES / count));
    for (const [m, c] of missing.entries()) {
      columns[c] ??= withUpperLevels(lows[m], highs[m]);
      if (m % columnsASlice === columnsASlice - 1) yield;
    }
  }

  private levels(column: number): Levels {
    const made = this.columns[column];
    if (made) return made;
    const { values, width, frameCount } = this;
    const count = Math.ceil(frameCount / BLOCK);
    const low = new Float64Array(count).fill(Number.POSITIVE_INFINITY);
    const high = new Float64Array(count).fill(Number.NEGATIVE_INFINITY);
    for (let f = 0, at = column; f < frameCount; f++, at += width) {
      const block = (f / BLOCK) | 0;
      if (values[at] < low[block]) low[block] = values[at];
      if (values[at] > high[block]) high[block] = values[at];
    }
    const levels = withUpperLevels(low, high);
    this.columns[column] = levels;
    return levels;
  }
}

function withUpperLevels(low: Float64Array, high: Float64Array): Levels {
  const lows = [low];
  const highs = [high];
  while (lows[lows.length - 1].length > 1) {
    const [l, h] = [lows[lows.length - 1], highs[highs.length - 1]];
    const count = Math.ceil(l.length / BLOCK);
    const [nextLow, nextHigh] = [new Float64Array(count), new Float64Array(count)];
    for (let b = 0, at = 0; b < count; b++) {
      const end = Math.min(l.length, at + BLOCK);
      let low = l[at];
      let high = h[at];
      for (at++; at < end; at++) {
        if (l[at] < low) low = l[at];
        if (h[at] > high) high = h[at];
      }
      nextLow[b] = low;
      nextHigh[b] = high;
    }
    lows.push(nextLow);
    highs.push(nextHigh);
  }
  return { lows, highs };
}

/** Smallest and largest value of the last range; scratch of `extremesOver`. */
const found = { low: 0, high: 0 };

/**
 * The extremes of a column from one take time to another, both included, `to` not before `from`.
 * @returns scratch that the next call overwrites
 */
export function extremesOver(samples: Samples, column: number, from: number, to: number): Readonly<typeof found> {
  const start = sampleColumn(samples, column, from);
  const end = sampleColumn(samples, column, to);
  found.low = Math.min(start, end);
  found.high = Math.max(start, end);
  const { startSeconds, frameSeconds, frameCount } = samples;
  const first = Math.max(0, Math.ceil((from - startSeconds) / frameSeconds));
  const last = Math.min(frameCount - 1, Math.floor((to - startSeconds) / frameSeconds));
  if (first > last) return found;
  const extremes = sampleExtremes(samples);
  extremes.over(column, first, last);
  const scale = samples.scales[column];
  found.low = Math.min(found.low, extremes.low * scale, extremes.high * scale);
  found.high = Math.max(found.high, extremes.low * scale, extremes.high * scale);
  return found;
}

/** Smallest and largest sample of a column. */
export function extremesOfColumn(samples: Samples, column: number): Readonly<typeof found> {
  const [from, to] = rangeOfSamples(samples);
  return extremesOver(samples, column, from, to);
}
