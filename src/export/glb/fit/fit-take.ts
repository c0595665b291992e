/** The keys of a take: the channels of a glTF animation. */

import type { JointNode } from '../../shared/joint-nodes.ts';
import type { TakeMotion } from '../../shared/take-motion.ts';
import { Rows } from '../rows.ts';
import { sampleTake } from '../sample-take.ts';
import type { Track } from '../tracks.ts';
import { exactKeys } from './exact-cubic.ts';
import { fitCubic } from './fit-cubic.ts';
import { type FittedKeys, keysAt } from './fit-linear.ts';
import { fitStretch, type KeyStyle } from './fit-stretch.ts';
import type { WatchPoints } from './watch-points.ts';

/** The keys of one track. */
export interface TrackKeys {
  readonly track: Track;
  readonly interpolation: 'LINEAR' | 'STEP' | 'CUBICSPLINE';
  /** Since the start of the take, ascending, from 0 to its end. */
  readonly seconds: Float32Array<ArrayBuffer>;
  /** As glTF has them: of a spline the slope before, the value and the slope after of each key. */
  readonly values: Float32Array<ArrayBuffer>;
  /** Whether the value never changes. */
  readonly isConstant: boolean;
}

/** How the keys of a take are found; lengths are in the file's units. */
export interface FitOptions {
  readonly style: KeyStyle;
  /** How far points may be off. */
  readonly tolerance: number;
  /** The character's size: what is exact is within a millionth of it. */
  readonly size: number;
  readonly framesPerSecond?: number;
  /** Called from time to time with the fraction of the take that is done. */
  readonly onProgress?: (fraction: number) => void;
}

/** The nodes that move, and the points by which that is seen. */
export interface MovedNodes {
  readonly nodes: readonly JointNode[];
  readonly points: WatchPoints;
  readonly tracks: readonly Track[];
  /** Numbers in a row. */
  readonly width: number;
}

/**
 * The share of the tolerance that each track gets at first: errors along a chain rarely all add up. Half of it takes
 * fewest keys, and many rounds of correcting them; a smaller one takes 7 % more keys and half the time.
 */
const SHARE = 0.6;
const SHARE_OF_LONG = 0.3;
/** Breaks of a take that is long. */
const LONG = 6_000;
/** Rows of a stretch, as many as this many numbers are, within bounds. */
const NUMBERS = 2_000_000;
const MAX_ROWS = 4096;
const MIN_ROWS = 256;
/** Fraction of the size that counts as exact. */
const EXACT = 1e-6;

/**
 * Finds the keys of each track of a take: one per frame if a frame rate is given, else as few as the tolerance allows.
 */
export function fitTake(motion: TakeMotion, moved: MovedNodes, options: FitOptions): readonly TrackKeys[] {
  if (options.framesPerSecond !== undefined) return framesOf(motion, moved, options.framesPerSecond, options.style);
  const { nodes, points, tracks, width } = moved;
  const { style, tolerance, size, onProgress } = options;
  const exact = new Map<Track, TrackKeys>();
  if (style === 'cubic' && motion.isKeyed) {
    const curves = tracks.filter(({ path }) => path !== 'rotation');
    const allowed = curves.map(({ reach }) => (EXACT * size) / Math.max(reach, EXACT));
    exactKeys(motion, curves, allowed, width).forEach((keys, c) => {
      if (keys) exact.set(curves[c], keysOfTrack(curves[c], 'cubic', keys));
    });
  }
  const collected = tracks.map(() => new Collected());
  const rows = new Rows(width, nodes.length);
  const numbersPerRow = 3 * width + 16 * nodes.length;
  const perStretch = Math.min(MAX_ROWS, Math.max(MIN_ROWS, Math.floor(NUMBERS / numbersPerRow)));
  const seconds = motion.end - motion.start;
  const thins = motion.breaks.length <= LONG;
  const share = thins ? SHARE : SHARE_OF_LONG;
  const isExact = (track: Track) => exact.has(track);
  sampleTake(motion, tracks, tolerance, rows, { rowsPerStretch: perStretch, swings: style === 'cubic' }, () => {
    fitStretch(rows, tracks, nodes, points, { style, tolerance, share, thins, isExact }).forEach((fit, t) => {
      collected[t].add(rows, fit, tracks[t].width);
    });
    onProgress?.(seconds > 0 ? Math.min(1, rows.seconds[rows.count - 1] / seconds) : 1);
  });
  return tracks.map((track, t) => exact.get(track) ?? keysOfTrack(track, style, collected[t].takeAll()));
}

/** Keys in a row. */
interface KeyColumns {
  readonly seconds: ArrayLike<number>;
  readonly values: ArrayLike<number>;
  /** Slopes of splines. */
  readonly slopesIn: ArrayLike<number>;
  readonly slopesOut: ArrayLike<number>;
  /** 1 where the values jump from the key before; absent: nowhere. */
  readonly jumps?: Uint8Array;
}

/** Keys of successive stretches, of one track. They are most of what a long take needs in memory. */
class Collected {
  private readonly seconds: Float64Array[] = [];
  private readonly values: Float64Array[] = [];
  private readonly slopesIn: Float64Array[] = [];
  private readonly slopesOut: Float64Array[] = [];
  private readonly jumps: Uint8Array[] = [];

  add(rows: Rows, { rows: keys, values, slopesIn = NONE, slopesOut = NONE }: FittedKeys, width: number): void {
    // The first key is the last of the stretch before, but for what follows it.
    const first = Math.min(1, this.seconds.length);
    const before = this.slopesOut.at(-1);
    if (before?.length) before.set(slopesOut.subarray(0, width), before.length - width);
    if (keys.length === first) return;
    const own = keys.slice(first);
    this.seconds.push(Float64Array.from(own, (row) => rows.seconds[row]));
    this.jumps.push(Uint8Array.from(own, (row, k) => (first + k > 0 ? rows.jumps[row] : 0)));
    this.values.push(values.slice(first * width));
    this.slopesIn.push(slopesIn.slice(first * width));
    this.slopesOut.push(slopesOut.slice(first * width));
  }

  /** All keys, which are let go of. */
  takeAll(): KeyColumns {
    return {
      seconds: joined(this.seconds),
      values: joined(this.values),
      slopesIn: joined(this.slopesIn),
      slopesOut: joined(this.slopesOut),
      jumps: Uint8Array.from(joined(this.jumps)),
    };
  }
}

const NONE = new Float64Array();

/** One after the other; `parts` is empty then. */
function joined(parts: (Float64Array | Uint8Array)[]): Float64Array {
  const all = new Float64Array(parts.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const part of parts.splice(0)) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}

/** Differences of values that are none: what rounding to floats hides. */
const SAME = 1e-9;

function keysOfTrack(track: Track, style: KeyStyle, keys: KeyColumns): TrackKeys {
  const { width } = track;
  const { seconds, values, slopesIn, slopesOut, jumps } = keys;
  const count = seconds.length;
  const isSame = (k: number, l: number) => {
    for (let c = 0; c < width; c++) {
      const a = values[k * width + c];
      const b = values[l * width + c];
      if (Math.abs(a - b) > SAME * Math.max(1, Math.abs(a))) return false;
    }
    return true;
  };
  const isFlat = (k: number) => {
    if (!isSame(k, k + 1)) return false;
    if (style === 'linear') return true;
    const span = seconds[k + 1] - seconds[k];
    for (let c = 0; c < width; c++) {
      const most = Math.max(Math.abs(slopesOut[k * width + c]), Math.abs(slopesIn[(k + 1) * width + c]));
      if (most * span > 10 * SAME * Math.max(1, Math.abs(values[k * width + c]))) return false;
    }
    return true;
  };
  const of = (
    indices: readonly number[],
    interpolation: TrackKeys['interpolation'],
    isConstant: boolean,
  ): TrackKeys => ({
    track,
    interpolation,
    seconds: Float32Array.from(indices, (k) => seconds[k]),
    values: Float32Array.from({ length: indices.length * width }, (_, i) => {
      const key = indices[Math.floor(i / width)];
      return values[key * width + (i % width)];
    }),
    isConstant,
  });
  let flat = 0;
  const starts: number[] = [0];
  for (let k = 0; k + 1 < count; k++) {
    if (jumps?.[k + 1]) starts.push(k + 1);
    else if (isFlat(k)) flat++;
  }
  const isStepped = flat + starts.length === count;
  if (isStepped && starts.every((k) => isSame(0, k))) return of(count > 1 ? [0, count - 1] : [0], 'LINEAR', true);
  if (isStepped) return of(starts.at(-1) === count - 1 ? starts : [...starts, count - 1], 'STEP', false);
  if (style === 'linear')
    return of(
      Array.from({ length: count }, (_, k) => k),
      'LINEAR',
      false,
    );
  const triples = new Float32Array(3 * count * width);
  for (let k = 0; k < count; k++) {
    for (let c = 0; c < width; c++) {
      const o = 3 * k * width + c;
      triples[o] = k === 0 ? 0 : slopesIn[k * width + c];
      triples[o + width] = values[k * width + c];
      triples[o + 2 * width] = k === count - 1 ? 0 : slopesOut[k * width + c];
    }
  }
  return {
    track,
    interpolation: 'CUBICSPLINE',
    seconds: Float32Array.from(seconds),
    values: triples,
    isConstant: false,
  };
}

/** Rows between two frames by which the slopes of a spline are found. */
const BETWEEN = 6;

/** A key at each frame, and at the end of the range. */
function framesOf(
  motion: TakeMotion,
  moved: MovedNodes,
  framesPerSecond: number,
  style: KeyStyle,
): readonly TrackKeys[] {
  const { tracks, width, nodes } = moved;
  const rows = new Rows(width, nodes.length);
  const row = new Float64Array(width);
  const keys: number[] = [];
  const seconds = motion.end - motion.start;
  const count = Math.floor(seconds * framesPerSecond + 1e-6);
  const parts = style === 'cubic' ? BETWEEN : 1;
  const last = count / framesPerSecond < seconds - 1e-6 / framesPerSecond ? count + 1 : count;
  for (let frame = 0; frame <= last; frame++) {
    for (let part = frame === 0 ? parts : 1; part <= parts; part++) {
      const time = Math.min(seconds, (frame - 1 + part / parts) / framesPerSecond);
      motion.write(motion.start + time, row);
      if (rows.add(time, row, false) && part === parts) keys.push(rows.count - 1);
    }
  }
  return tracks.map((track) => {
    const collected = new Collected();
    collected.add(rows, style === 'cubic' ? fitCubic(rows, track, keys) : keysAt(rows, track, keys), track.width);
    return keysOfTrack(track, style, collected.takeAll());
  });
}
