/**
 * Finds keys for a stretch of a take: few, and such that no point is off by more than the tolerance at any row. Errors
 * of joints add up along the skeleton, and mostly don't: so each track gets keys by a share of the tolerance, their
 * values are moved so that joints make up for each other's errors, the result is measured at all points and rows, keys
 * are added where the tolerance is exceeded, and those that turn out not to be needed are removed.
 */

import type { JointNode } from '../../shared/joint-nodes.ts';
import type { Rows } from '../rows.ts';
import type { Track } from '../tracks.ts';
import { verticesBeyond } from './check-vertices.ts';
import { cubicHolds, fitCubic } from './fit-cubic.ts';
import {
  type FittedKeys,
  fitLinear,
  greedyKeys,
  guarded,
  lastNotAbove,
  linearHolds,
  refitLinear,
} from './fit-linear.ts';
import { Measured } from './measured.ts';
import { moveKeys } from './move-key.ts';
import { removeKeys } from './remove-keys.ts';
import type { WatchPoints } from './watch-points.ts';

/** How keys are joined. */
export type KeyStyle = 'linear' | 'cubic';

/** How the keys of a stretch are found. */
export interface StretchOptions {
  readonly style: KeyStyle;
  /** How far points may be off. */
  readonly tolerance: number;
  /** The share of the tolerance that each track gets at first, from 0 to 1. */
  readonly share: number;
  /** Whether keys of straight lines are moved and removed where possible: fewer keys for several times the time. */
  readonly thins: boolean;
  /** Tracks that need no keys here: they are exact anyway. */
  readonly isExact: (track: Track) => boolean;
}

/** The tolerance of morph weights, of the whole: they add to what joints do. */
const OF_WEIGHTS = 0.1;
/** Rounds after which every so many rows get a key, so that the number of rounds is bounded. */
const PATIENCE = 60;
const HASTE = 16;
/** Fraction of the tolerance: between two rows points are off by a little more than at them. */
const MARGIN = 0.95;
/** Straight lines through moved keys are off by half as much, nearly. */
const HALVED = 1.8;

/** How often vertices are looked for that are off where nothing was watched. */
const CHECKS = 3;

/** Keys of each track. */
export function fitStretch(
  rows: Rows,
  tracks: readonly Track[],
  nodes: readonly JointNode[],
  points: WatchPoints,
  { style, tolerance, share, thins, isExact }: StretchOptions,
): readonly FittedKeys[] {
  const isCubic = style === 'cubic';
  const keysFor = isCubic ? fitCubic : fitLinear;
  const limit = MARGIN * tolerance;
  const keys = tracks.map((track) => {
    if (isExact(track)) return [];
    const own = track.path === 'weights' ? OF_WEIGHTS * tolerance : share * limit;
    // A track that moves nothing still has its values.
    const budget = (own * (isCubic ? 1 : HALVED)) / Math.max(track.reach, 1e-9 * tolerance);
    return greedyKeys(rows, (isCubic ? cubicHolds : linearHolds)(rows, track, budget));
  });
  const fits: FittedKeys[] = tracks.map((track, t) => keysFor(rows, track, keys[t]));
  let measured = new Measured(rows, tracks, nodes, points.watch, isCubic, fits);
  const improves = thins && !isCubic;
  if (improves) moveKeys(measured, limit, false);
  settle(measured, limit, isCubic);
  if (improves) removeKeys(measured, limit);
  for (let check = 0; check < CHECKS; check++) {
    const before = points.watch;
    measured.measure();
    points.addVertices(verticesBeyond(measured, points, limit));
    if (points.watch === before) break;
    measured = new Measured(rows, tracks, nodes, points.watch, isCubic, fits);
    settle(measured, limit, isCubic);
  }
  return isCubic ? fits : fits.map((fit, t) => guarded(rows, tracks[t], fit, measured.made[0]));
}

/** Adds keys until no row is off by more than the limit. */
function settle(measured: Measured, limit: number, isCubic: boolean): void {
  const { rows, tracks, fits } = measured;
  const keys = fits.map((fit) => fit.rows.slice());
  measured.measure();
  for (let round = 0; ; round++) {
    const changed = addKeys(measured, keys, limit, round < PATIENCE ? rows.count : HASTE);
    if (changed.size === 0) break;
    for (const [t, added] of changed) {
      fits[t] = isCubic
        ? fitCubic(rows, tracks[t], keys[t], fits[t])
        : refitLinear(rows, tracks[t], keys[t], fits[t], added);
      for (const row of added) measured.replace(t, ...around(keys[t], row));
    }
    measured.measure();
  }
}

/** The rows that a key at a row, or its absence, has an effect on: two segments on either side. */
function around(keys: readonly number[], row: number): readonly [number, number] {
  const k = lastNotAbove(keys, row);
  return [keys[Math.max(0, k - 2)], keys[Math.min(keys.length - 1, k + 3)]];
}

/**
 * Adds a key at the worst row of each run of rows that are off by too much, to the track that is off most there.
 * Returns the rows of each track that are keys to be computed.
 * @param longest rows of a run
 */
function addKeys(measured: Measured, keys: number[][], limit: number, longest: number): Map<number, number[]> {
  const changed = new Map<number, number[]>();
  const { errors } = measured;
  const limit2 = limit * limit;
  for (let m = 0; m < errors.length; m++) {
    if (!(errors[m] > limit2)) continue;
    let worst = m;
    const end = Math.min(errors.length, m + longest);
    for (; m < end && errors[m] > limit2; m++) if (errors[m] > errors[worst]) worst = m;
    for (const t of measured.worstTracks(worst)) {
      // Where every row is a key already, it was moved: it gets its own value back.
      changed.set(t, [...(changed.get(t) ?? []), addKey(keys[t], worst) ?? worst]);
      break;
    }
  }
  return changed;
}

/** Adds a key at a row, or, if there is one, halfway in the longer segment beside it; undefined if all rows are keys. */
function addKey(keys: number[], row: number): number | undefined {
  const k = lastNotAbove(keys, row);
  if (keys[k] !== row) {
    keys.splice(k + 1, 0, row);
    return row;
  }
  const before = k > 0 ? row - keys[k - 1] : 0;
  const after = k + 1 < keys.length ? keys[k + 1] - row : 0;
  if (Math.max(before, after) < 2) return undefined;
  const isBefore = before > after;
  const middle = isBefore ? row - (before >> 1) : row + (after >> 1);
  keys.splice(isBefore ? k : k + 1, 0, middle);
  return middle;
}
