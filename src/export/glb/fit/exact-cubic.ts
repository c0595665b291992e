/**
 * Curves that are cubics piece by piece, such as a root's translation driven by keys: found again exactly from their
 * values alone. Between two breaks four values give the cubic, and others check it. If they don't fit, a limit is
 * reached in between: the place is found by halving. Then neighbours that one cubic covers are joined.
 */

import type { TakeMotion } from '../../shared/take-motion.ts';
import { stepSeconds } from '../sample-take.ts';
import type { Track } from '../tracks.ts';

/** A cubic of each number of a track, over a time: `a + b·t + c·t² + d·t³`, t since the start of the piece. */
interface Piece {
  /** Seconds since the start of the take, as floats. */
  readonly from: number;
  readonly to: number;
  /** Seconds by which `from` is after the start of the take, before it was rounded. */
  readonly start: number;
  /** Four per number. */
  readonly cubics: Float64Array;
}

/** Keys of cubics that give a curve exactly; one column per property. */
export interface ExactKeys {
  readonly seconds: readonly number[];
  readonly values: Float64Array;
  /** Per second. */
  readonly slopesIn: Float64Array;
  readonly slopesOut: Float64Array;
}

/** Where values are taken, as fractions of a piece: four that give the cubic, four that check it. */
const GIVEN = [0.02, 0.35, 0.65, 0.98];
const CHECKED = [0.005, 0.18, 0.5, 0.83, 0.995];
/** Halvings down to the place of a limit. */
const HALVINGS = 40;
const DEEPEST = 12;

/**
 * Keys of the tracks that are exact within `allowed` of their values; undefined for those that are not cubics.
 * @param allowed one per track
 */
export function exactKeys(
  motion: TakeMotion,
  tracks: readonly Track[],
  allowed: readonly number[],
  width: number,
): readonly (ExactKeys | undefined)[] {
  const { breaks, jumps, start } = motion;
  const pieces: Piece[][] = tracks.map(() => []);
  const isCubic = tracks.map(() => true);
  const rows = Array.from({ length: GIVEN.length + CHECKED.length }, () => new Float64Array(width));
  const single = new Float64Array(width);

  /** The cubic of a track between two times; undefined if it isn't one. */
  const cubicOf = (t: number, a: number, b: number): Float64Array | undefined => {
    const { at, width: dims } = tracks[t];
    const span = b - a;
    const cubics = new Float64Array(4 * dims);
    for (let k = 0; k < dims; k++) {
      const values = GIVEN.map((_, i) => rows[i][at + k]);
      solve(values, span, cubics, 4 * k);
      for (let i = 0; i < CHECKED.length; i++) {
        const made = evaluate(cubics, 4 * k, CHECKED[i] * span);
        if (!(Math.abs(made - rows[GIVEN.length + i][at + k]) <= allowed[t])) return undefined;
      }
    }
    return cubics;
  };
  const take = (a: number, b: number) => {
    [...GIVEN, ...CHECKED].forEach((u, i) => {
      motion.write(a + (b - a) * u, rows[i]);
    });
  };
  const push = (t: number, a: number, b: number, cubics: Float64Array) => {
    const from = Math.fround(a - start);
    const to = Math.fround(b - start);
    if (!(to > from)) return;
    const before = pieces[t].at(-1);
    // Not every track jumps where one may.
    if (before && before.to < from && isContinuous(before, from, cubics, allowed[t])) pieces[t].pop();
    if (before && pieces[t].at(-1) !== before) pieces[t].push({ ...before, to: from });
    pieces[t].push({ from, to, start: a - start, cubics });
  };
  /** The pieces of one track where one cubic doesn't do; false if many don't. */
  const split = (t: number, a: number, b: number, depth: number): boolean => {
    take(a, b);
    const cubics = cubicOf(t, a, b);
    if (cubics) {
      push(t, a, b, cubics);
      return true;
    }
    if (depth >= DEEPEST) return false;
    // One end or the other of [low, high] is where the curve bends.
    let low = a;
    let high = b;
    for (let i = 0; i < HALVINGS && high - low > 1e-9; i++) {
      const middle = (low + high) / 2;
      take(low, middle);
      const isFirst = cubicOf(t, low, middle) === undefined;
      take(middle, high);
      const isSecond = cubicOf(t, middle, high) === undefined;
      if (isFirst) high = middle;
      else if (isSecond) low = middle;
      else {
        low = high = middle;
        break;
      }
    }
    const bend = (low + high) / 2;
    if (!(bend > a && bend < b)) return false;
    return split(t, a, bend, depth + 1) && split(t, bend, b, depth + 1);
  };

  for (let i = 0; i + 1 < breaks.length; i++) {
    const a = breaks[i];
    const step = stepSeconds(breaks[i + 1] - start);
    const isStepEnd = jumps.has(breaks[i + 1]) && breaks[i + 1] - a > 2 * step;
    const b = isStepEnd ? breaks[i + 1] - step : breaks[i + 1];
    take(a, b);
    const found = tracks.map((_, t) => (isCubic[t] ? cubicOf(t, a, b) : undefined));
    found.forEach((cubics, t) => {
      if (cubics) push(t, a, b, cubics);
      else if (isCubic[t] && !split(t, a, b, 0)) isCubic[t] = false;
    });
  }
  return tracks.map((track, t) => {
    if (!isCubic[t]) return undefined;
    if (pieces[t].length === 0) motion.write(start, single);
    return keysOf(joined(pieces[t], allowed[t], track.width), track, single);
  });
}

/** The cubic through four values at GIVEN. */
function solve(values: readonly number[], span: number, out: Float64Array, o: number): void {
  // Newton's divided differences, then expanded.
  const x = GIVEN.map((u) => u * span);
  const d = [...values];
  for (let order = 1; order < 4; order++) {
    for (let i = 3; i >= order; i--) d[i] = (d[i] - d[i - 1]) / (x[i] - x[i - order]);
  }
  const polynomial = [d[3], 0, 0, 0];
  for (let i = 2; i >= 0; i--) {
    for (let k = 3; k > 0; k--) polynomial[k] = polynomial[k - 1] - x[i] * polynomial[k];
    polynomial[0] = d[i] - x[i] * polynomial[0];
  }
  out.set(polynomial, o);
}

function evaluate(cubics: Float64Array, o: number, t: number): number {
  return ((cubics[o + 3] * t + cubics[o + 2]) * t + cubics[o + 1]) * t + cubics[o];
}

function slopeAt(cubics: Float64Array, o: number, t: number): number {
  return (3 * cubics[o + 3] * t + 2 * cubics[o + 2]) * t + cubics[o + 1];
}

/** Whether a piece leads to the beginning of the next one, at a time shortly after its end. */
function isContinuous(before: Piece, time: number, cubics: Float64Array, allowed: number): boolean {
  for (let o = 0; o < cubics.length; o += 4) {
    if (!(Math.abs(evaluate(before.cubics, o, time - before.start) - cubics[o]) <= allowed)) return false;
  }
  return true;
}

/** Joins pieces that the cubic of the first of them covers. */
function joined(pieces: readonly Piece[], allowed: number, dims: number): readonly Piece[] {
  const made: Piece[] = [];
  for (const piece of pieces) {
    const last = made.at(-1);
    if (last && last.to === piece.from && covers(last, piece, allowed, dims))
      made[made.length - 1] = { ...last, to: piece.to };
    else made.push(piece);
  }
  return made;
}

function covers(one: Piece, next: Piece, allowed: number, dims: number): boolean {
  for (const u of [0, 0.25, 0.5, 0.75, 1]) {
    const time = next.from + (next.to - next.from) * u;
    for (let k = 0; k < dims; k++) {
      const a = evaluate(one.cubics, 4 * k, time - one.start);
      const b = evaluate(next.cubics, 4 * k, time - next.start);
      if (!(Math.abs(a - b) <= allowed)) return false;
    }
  }
  return true;
}

/** @param single the only row of a take without duration */
function keysOf(pieces: readonly Piece[], { at, width: dims }: Track, single: Float64Array): ExactKeys {
  const seconds: number[] = [];
  const values: number[] = [];
  const slopesIn: number[] = [];
  const slopesOut: number[] = [];
  const key = (
    time: number,
    of: (k: number) => number,
    slopeIn: (k: number) => number,
    slopeOut: (k: number) => number,
  ) => {
    seconds.push(time);
    for (let k = 0; k < dims; k++) {
      values.push(of(k));
      slopesIn.push(slopeIn(k));
      slopesOut.push(slopeOut(k));
    }
  };
  const none = () => 0;
  pieces.forEach((piece, p) => {
    const { cubics, start, from, to } = piece;
    const next: Piece | undefined = pieces[p + 1];
    const at0 = (k: number) => evaluate(cubics, 4 * k, from - start);
    const slope0 = (k: number) => slopeAt(cubics, 4 * k, from - start);
    const at1 = (k: number) => evaluate(cubics, 4 * k, to - start);
    const slope1 = (k: number) => slopeAt(cubics, 4 * k, to - start);
    if (p === 0) key(from, at0, none, slope0);
    if (next && next.from === to) key(to, at1, slope1, (k) => slopeAt(next.cubics, 4 * k, next.from - next.start));
    else {
      key(to, at1, slope1, none);
      if (next) {
        const { cubics: after, start: begin, from: first } = next;
        key(
          first,
          (k) => evaluate(after, 4 * k, first - begin),
          none,
          (k) => slopeAt(after, 4 * k, first - begin),
        );
      }
    }
  });
  if (pieces.length === 0) {
    key(0, (k) => single[at + k], none, none);
  }
  return {
    seconds,
    values: Float64Array.from(values),
    slopesIn: Float64Array.from(slopesIn),
    slopesOut: Float64Array.from(slopesOut),
  };
}
