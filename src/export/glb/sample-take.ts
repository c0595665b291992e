/** Turns a take into rows, stretch by stretch: dense where it turns, sparse where it rests. */

import { SAME_TIME, type TakeMotion } from '../shared/take-motion.ts';
import { normalise } from './fit/fit-linear.ts';
import type { Rows } from './rows.ts';
import type { Track } from './tracks.ts';

/** Seconds between the two keys of a step, where floats are as fine. */
const STEP_SECONDS = 1e-5;

/** Seconds between the two keys of a step at a time since the start of a take: they differ as floats. */
export function stepSeconds(since: number): number {
  return Math.max(STEP_SECONDS, since * FLOAT_STEP);
}

/** More than the relative distance of two floats. */
const FLOAT_STEP = 1.25e-7;
/** Fraction of the tolerance by which a straight line between two rows may be off. */
const FINENESS = 0.08;
/** Rows are never closer, in seconds. */
const CLOSEST = 1e-4;
/** Between two breaks at first: per second, and at most. */
const PIECES_PER_SECOND = 30;
const MAX_PIECES = 64;

/**
 * Calls `full` whenever `rows` has that many rows, and at the end; what it has then is a stretch of the take, whose
 * last row is the first one of the next.
 * @param tolerance how far points may be off
 * @param how `swings`: whether what is between two rows on a straight line matters: splines go their own way there
 */
export function sampleTake(
  motion: TakeMotion,
  tracks: readonly Track[],
  tolerance: number,
  rows: Rows,
  { rowsPerStretch, swings }: { readonly rowsPerStretch: number; readonly swings: boolean },
  full: () => void,
): void {
  const { width } = rows;
  const { start, breaks, jumps, isStraight } = motion;
  const fine = FINENESS * tolerance;
  const at = (seconds: number) => {
    const row = new Float64Array(width);
    motion.write(seconds, row);
    return row;
  };
  const end = breaks[breaks.length - 1];
  // Curves that repeat may jump a little later than at the break, by rounding.
  const justAfter = (time: number) => at(jumps.has(time) ? Math.min(end, time + SAME_TIME) : time);
  const add = (seconds: number, row: Float64Array, isJump = false) => {
    // Between a jump's two rows no stretch ends: both are keys of one.
    if (rows.count >= rowsPerStretch && !isJump) {
      full();
      rows.continueFromLast();
    }
    rows.add(seconds - start, row, isJump);
  };
  /** Adds rows up to and with that at b. */
  const refine = (a: number, rowA: Float64Array, b: number, rowB: Float64Array) => {
    if (b - a > 2 * CLOSEST) {
      const middle = (a + b) / 2;
      const row = at(middle);
      const isFine =
        straightness(tracks, rowA, rowB, row, 0.5) <= fine &&
        straightness(tracks, rowA, rowB, at(a + (b - a) / 4), 0.25) <= fine;
      if (!isFine) {
        refine(a, rowA, middle, row);
        refine(middle, row, b, rowB);
        return;
      }
      if (swings) add(middle, row);
    }
    add(b, rowB);
  };
  let from = breaks[0];
  let row = justAfter(from);
  add(from, row);
  for (let i = 1; i < breaks.length; i++) {
    const time = breaks[i];
    const after = justAfter(time);
    if (isStraight && turnsLittle(tracks, row, after)) {
      if (swings) add((from + time) / 2, halfway(tracks, row, after));
      add(time, after);
      row = after;
      from = time;
      continue;
    }
    const step = stepSeconds(time - start);
    const before = jumps.has(time) ? at(time - step) : after;
    const isJump = before !== after && farthest(tracks, before, after) > fine;
    const until = isJump ? time - step : time;
    const last = isJump ? before : after;
    const pieces = Math.min(MAX_PIECES, Math.max(1, Math.ceil((until - from) * PIECES_PER_SECOND)));
    if (until > from) {
      for (let p = 1; p <= pieces; p++) {
        const next = p === pieces ? until : from + ((until - from) * p) / pieces;
        const rowNext = p === pieces ? last : at(next);
        refine(p === 1 ? from : from + ((until - from) * (p - 1)) / pieces, row, next, rowNext);
        row = rowNext;
      }
    }
    if (isJump) add(time, after, true);
    row = after;
    from = time;
  }
  full();
}

/** The row in the middle between two that rotations turn little between: components are an arc there. */
function halfway(tracks: readonly Track[], a: Float64Array, b: Float64Array): Float64Array {
  const out = a.slice();
  for (const { at, width, path } of tracks) {
    const sign = path === 'rotation' && dot4(a, b, at) < 0 ? -1 : 1;
    for (let k = at; k < at + width; k++) out[k] = (a[k] + sign * b[k]) / 2;
    if (path === 'rotation') normalise(out, at);
  }
  return out;
}

/** How far points are off, about, where a straight line is taken between two rows. */
function straightness(
  tracks: readonly Track[],
  a: Float64Array,
  b: Float64Array,
  between: Float64Array,
  u: number,
): number {
  let most = 0;
  for (const { at, width, path, reach } of tracks) {
    const isRotation = path === 'rotation';
    const sign = isRotation && dot4(a, b, at) < 0 ? -1 : 1;
    const other = isRotation && dot4(a, between, at) < 0 ? -1 : 1;
    let sum = 0;
    for (let k = at; k < at + width; k++) {
      const d = a[k] + (sign * b[k] - a[k]) * u - other * between[k];
      sum += d * d;
    }
    most = Math.max(most, (isRotation ? 4 : 1) * sum * reach * reach);
  }
  return Math.sqrt(most);
}

/** Cosine of half the angle up to which an arc is the same by components, nearly: 12°. */
const LITTLE = Math.cos(0.1);

function turnsLittle(tracks: readonly Track[], a: Float64Array, b: Float64Array): boolean {
  return tracks.every(({ path, at }) => path !== 'rotation' || Math.abs(dot4(a, b, at)) > LITTLE);
}

function farthest(tracks: readonly Track[], a: Float64Array, b: Float64Array): number {
  return straightness(tracks, a, a, b, 0);
}

function dot4(a: Float64Array, b: Float64Array, o: number): number {
  return a[o] * b[o] + a[o + 1] * b[o + 1] + a[o + 2] * b[o + 2] + a[o + 3] * b[o + 3];
}
