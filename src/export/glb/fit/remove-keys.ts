/**
 * Removes keys of straight lines that turn out not to be needed: those without which no point is off by too much at any
 * row, once the neighbours are moved so that points are off least.
 */

import type { Rows } from '../rows.ts';
import type { Track } from '../tracks.ts';
import { lastNotAbove, withoutKey } from './fit-linear.ts';
import type { Measured } from './measured.ts';
import { moveKey, moveKeys } from './move-key.ts';

/** A key that may not be needed. */
interface Candidate {
  readonly t: number;
  readonly row: number;
  /** How far points would be off there, about, without it. */
  readonly off: number;
}

/** Keys whose absence would be off by more than this many times the limit are needed: moved neighbours halve it. */
const HOPELESS = 1.8;
/** Points off by more than this many times the limit are not brought back by moving keys. */
const WITHIN_REACH = 1.5;
/** How often both neighbours are moved. */
const ROUNDS = 2;
/** After the first, all keys are moved: that gives room for a few more to be removed. */
const PASSES = 2;

/** Removes what it can, keys that matter least first. No row is off by more than the limit before, nor after. */
export function removeKeys(measured: Measured, limit: number): void {
  const { rows, tracks, fits } = measured;
  for (let pass = 0; pass < PASSES; pass++) {
    if (pass > 0) moveKeys(measured, limit, true);
    const candidates: Candidate[] = [];
    tracks.forEach((track, t) => {
      const own = fits[t].rows;
      for (let k = 1; k + 1 < own.length; k++) {
        if (rows.jumps[own[k]] || rows.jumps[own[k + 1]]) continue;
        const off = offWithout(rows, track, own[k - 1], own[k], own[k + 1]);
        if (off < HOPELESS * limit) candidates.push({ t, row: own[k], off });
      }
    });
    candidates.sort((a, b) => a.off - b.off);
    for (const { t, row } of candidates) removeKey(measured, t, row, limit);
  }
}

function removeKey(measured: Measured, t: number, row: number, limit: number): void {
  const { rows, tracks, fits } = measured;
  const before = fits[t];
  const k = lastNotAbove(before.rows, row);
  const from = before.rows[Math.max(0, k - 2)];
  const to = before.rows[Math.min(before.rows.length - 1, k + 2)];
  fits[t] = withoutKey(rows, tracks[t], before, k);
  measured.replace(t, from, to);
  const last = fits[t].rows.length - 1;
  const limit2 = limit * limit;
  let farthest = measured.farthest(t, from, row, to, limit2, WITHIN_REACH * WITHIN_REACH * limit2);
  for (let round = 0; round < ROUNDS && farthest > limit2; round++) {
    if (farthest > WITHIN_REACH * WITHIN_REACH * limit2) break;
    if (k > 1) moveKey(measured, t, k - 1, limit, false);
    if (k < last) moveKey(measured, t, k, limit, false);
    farthest = measured.farthest(t, from, row, to, limit2, limit2);
  }
  if (farthest <= limit2) return;
  fits[t] = before;
  measured.replace(t, from, to);
}

/** How far points are off at a key, about, where a straight line is taken from a row before it to one after. */
function offWithout({ values, seconds, width }: Rows, track: Track, a: number, key: number, b: number): number {
  const u = (seconds[key] - seconds[a]) / (seconds[b] - seconds[a]);
  let sum = 0;
  for (let c = track.at; c < track.at + track.width; c++) {
    const d = values[a * width + c] * (1 - u) + values[b * width + c] * u - values[key * width + c];
    sum += d * d;
  }
  return Math.sqrt(sum) * track.reach * (track.path === 'rotation' ? 2 : 1);
}
