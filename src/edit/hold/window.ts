/**
 * When something is held: the frames that are changed, and how much of the hold each of them gets.
 *
 *     weight   1 ┤        ┌────────────┐
 *              0 ┼───────╱              ╲───────
 *                 first  from          to   last        the ways up and down are smoothsteps, outside of the range
 *
 * Where the range begins or ends with the take there is no way up or down: nothing is seen beyond. Elsewhere it takes a
 * frame at least, so that nothing jumps.
 */
import type { Samples } from '../../model/samples.ts';
import { sameTime } from '../keys/same-time.ts';
import { firstFrameFrom, lastFrameTo } from '../samples/frames.ts';
import { CommandError } from '../store.ts';

export interface HoldWindow {
  /** Seconds of the clip, ascending strictly: nothing changes before the first and after the last. */
  readonly times: Float64Array;
  /** One for each: 0 as it was, 1 held. */
  readonly weights: Float64Array;
  /** The first and the last that is held wholly. */
  readonly firstHeld: number;
  readonly lastHeld: number;
  /** The frames at which the take turns sharply. */
  readonly corners: ReadonlySet<number>;
}

/**
 * The frames of a hold over keys: both ends of the range are frames, those of the ways there and back, and the moments
 * at which the take turns sharply, instead of frames close by.
 *
 * @param range what is held, seconds of the clip
 * @param played of the clip: nothing beyond is changed. Refuses a range that lies wholly outside.
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
  // Nothing lies between a moment and itself.
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

/** Frames from a time on, evenly, up to but not with another. */
function division(from: number, to: number, framesPerSecond: number): number[] {
  const count = Math.max(1, Math.ceil((to - from) * framesPerSecond - SAME_FRAME));
  return Array.from({ length: count }, (_, f) => from + ((to - from) * f) / count);
}

/** Of a frame: what is nearer to a corner is none beside it. */
const NEAR_CORNER = 0.3;
/** Of a frame: 0.3 s at 30 a second are 9 frames, not 9.0000001. */
const SAME_FRAME = 1e-6;

/** The frames of samples that a hold changes, and one on each side that it doesn't. Refuses a range without any. */
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
    if (f < firstHeld) return smoothstep((time - times[0]) / (times[firstHeld] - times[0]));
    if (f > lastHeld) return smoothstep((times[last] - time) / (times[last] - times[lastHeld]));
    return 1;
  });
  return { times, weights, firstHeld, lastHeld, corners };
}

function smoothstep(x: number): number {
  return x * x * (3 - 2 * x);
}

function outside(played: readonly [number, number]): CommandError {
  const [start, end] = played.map((seconds) => Number(seconds.toFixed(6)));
  return new CommandError(`There is nothing to play there: the take runs from ${start} s to ${end} s of its own time.`);
}
