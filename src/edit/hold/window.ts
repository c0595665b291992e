/**
 * The time window of a hold: the frames that change, and the weight of the hold in each.
 *
 *     weight   1 ┤        ┌────────────┐
 *              0 ┼───────╱              ╲───────
 *                 first  from          to   last        ease in and out are smoothsteps, outside of the range
 *
 * Where the range starts or ends with the take there is no ease: nothing beyond is visible. Elsewhere it takes at least
 * one frame, so that nothing jumps.
 */

import { smoothstep } from '../../math/smoothstep.ts';
import type { Samples } from '../../model/takes/samples.ts';
import { CommandError } from '../command-error.ts';
import { sameTime } from '../keys/same-time.ts';
import { firstFrameFrom, lastFrameTo } from '../samples/frames.ts';
import { refuseTooMany } from '../samples/most-frames.ts';

/** The frames of a hold, with their weights. */
export interface HoldWindow {
  /** Seconds of the take, strictly ascending: nothing changes before the first and after the last. */
  readonly times: Float64Array;
  /** One for each: 0 unchanged, 1 held. */
  readonly weights: Float64Array;
  /** The first and last with full weight. */
  readonly firstHeld: number;
  readonly lastHeld: number;
  /** The frames at which the take turns sharply. */
  readonly corners: ReadonlySet<number>;
}

/**
 * The frames of a hold on keys: both ends of the range, those of ease in and out, and the times at which the take turns
 * sharply, replacing frames close by.
 *
 * @param range to hold, seconds of the take
 * @param played playback range of the take; nothing beyond is changed. Refuses a range outside it.
 */
export function keyedWindow(
  range: readonly [number, number],
  played: readonly [number, number],
  framesPerSecond: number,
  easeSeconds: number,
  corners: readonly number[],
): HoldWindow {
  const from = Math.max(range[0], played[0]);
  const to = Math.min(range[1], played[1]);
  if (from > to) throw outside(played);
  const ease = Math.max(easeSeconds, 1 / framesPerSecond);
  const first = Math.max(played[0], from - ease);
  const last = Math.min(played[1], to + ease);
  // Drops empty intervals.
  const marks = [first, from, to, last].filter((time, i, all) => i === 0 || !sameTime(time, all[i - 1]));
  if (marks.length < 2) throw outside(played);
  const near = NEAR_CORNER / framesPerSecond;
  const inside = corners.filter((time) => marks.every((mark) => Math.abs(mark - time) > near) && time > first);
  const kept = inside.filter((time, i) => time < last && (i === 0 || time - inside[i - 1] > near));
  const grid = marks.slice(1).flatMap((mark, i) => division(marks[i], mark, framesPerSecond));
  const clear = grid.filter((time) => marks.includes(time) || kept.every((corner) => Math.abs(corner - time) > near));
  const times = Float64Array.from([...clear, ...kept, marks[marks.length - 1]].sort((a, b) => a - b));
  const at = (seconds: number) => times.findIndex((time) => sameTime(time, seconds));
  return windowOf(times, at(from), at(to), new Set(kept.map((time) => times.indexOf(time))));
}

/** Evenly spaced frames from one time up to (excluding) another. */
function division(from: number, to: number, framesPerSecond: number): number[] {
  const count = Math.max(1, Math.ceil((to - from) * framesPerSecond - SAME_FRAME));
  refuseTooMany(count, 1);
  return Array.from({ length: count }, (_, f) => from + ((to - from) * f) / count);
}

/** Fraction of a frame within which a corner replaces it. */
const NEAR_CORNER = 0.3;
/** Fraction of a frame: 0.3 s at 30 FPS are 9 frames, not 9.0000001. */
const SAME_FRAME = 1e-6;

/** The frames of samples that a hold changes, and an unchanged one on each side. Refuses a range without frames. */
export function sampledWindow(samples: Samples, range: readonly [number, number], easeSeconds: number): HoldWindow {
  const { startSeconds, frameSeconds, frameCount } = samples;
  const from = firstFrameFrom(samples, range[0]);
  const to = lastFrameTo(samples, range[1]);
  if (from > to || frameCount < 2) throw outside([startSeconds, startSeconds + (frameCount - 1) * frameSeconds]);
  const ease = Math.max(1, Math.round(easeSeconds / frameSeconds));
  const first = Math.max(0, from - ease);
  const last = Math.min(frameCount - 1, to + ease);
  const times = Float64Array.from({ length: last - first + 1 }, (_, f) => startSeconds + (first + f) * frameSeconds);
  return windowOf(times, from - first, to - first, new Set());
}

function windowOf(times: Float64Array, firstHeld: number, lastHeld: number, corners: ReadonlySet<number>): HoldWindow {
  const last = times.length - 1;
  const weights = times.map((time, f) => {
    if (f < firstHeld) return smoothstep(times[0], times[firstHeld], time);
    if (f > lastHeld) return smoothstep(times[last], times[lastHeld], time);
    return 1;
  });
  return { times, weights, firstHeld, lastHeld, corners };
}

function outside(played: readonly [number, number]): CommandError {
  const [start, end] = played.map((seconds) => Number(seconds.toFixed(6)));
  return new CommandError(`There is nothing to play there: the take runs from ${start} s to ${end} s of its own time.`);
}
