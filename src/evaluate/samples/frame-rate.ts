/**
 * The frame rate of a take: that of its samples, else the one that its file states, else the common spacing of its
 * keys.
 *
 * Files store the time between frames, rounded: 0.0333333 means 1/30. The intended rate is the whole number or
 * television rate (30/1.001) that the file's digits can't be told from, unless that would lose half a frame by the
 * take's end: frames are counted as in the file.
 */

import { perObject } from '../../model/per-object.ts';
import type { Samples } from '../../model/takes/samples.ts';
import { baseOf, type Motion, type Take } from '../../model/takes/take.ts';
import { LINEAR } from '../../model/takes/tangent-kinds.ts';

/** Television rates are whole numbers divided by this. */
const TELEVISION = 1.001;
/** Rounding never changes a rate by more than this fraction. */
const MAX_ROUNDED = 0.005;
/** Relative error of single precision. */
const MIN_ROUNDED = 1e-6;
const MAX_LOST_FRAMES = 0.5;

/** Frames per second of a take, greater than 0; undefined for keys at uneven times. Cached per take. */
export const frameRateOf = perObject((take: Take): number | undefined => {
  // Keys of layers come where they are wanted.
  const base = baseOf(take);
  if (base.samples) return rateOfSamples(base.samples);
  return take.framesPerSecond ?? rateOfKeys(base);
});

/** Frames per second, greater than 0. */
function rateOfSamples({ frameSeconds, frameCount }: Pick<Samples, 'frameSeconds' | 'frameCount'>): number {
  const decimals = String(frameSeconds).split('.')[1]?.length ?? 0;
  const rounding = Math.min(Math.max(10 ** -decimals, MIN_ROUNDED * frameSeconds), MAX_ROUNDED * frameSeconds);
  const rate = 1 / frameSeconds;
  const isMeant = (usual: number) =>
    Math.abs(1 / usual - frameSeconds) <= rounding && frameCount * Math.abs(usual * frameSeconds - 1) < MAX_LOST_FRAMES;
  return usualNear(rate).find(isMeant) ?? rate;
}

/** The rate that a file states, rounded as it may be: 24/1.001 for 23.976. */
export function statedRate(rate: number): number {
  return usualNear(rate).find((usual) => Math.abs(usual / rate - 1) < ROUNDED) ?? rate;
}

/** The nearest whole number, and the nearest television rate. */
function usualNear(rate: number): readonly number[] {
  return [Math.round(rate), Math.round(rate * TELEVISION) / TELEVISION].filter((usual) => usual > 0);
}

/**
 * Keys set by hand, one per second or so, are evenly spaced too, but sampling at them would lose the curve in between.
 * So their spacing counts from 10 per second if curves are straight between keys, and from 23 (film's 23.976) if not.
 */
const MIN_STRAIGHT = 10;
const MIN_CURVED = 23;
/** Rates at which a few keys may be on a grid of frames and leave most of it empty. */
const COMMON = [24, 25, 30, 60].flatMap((rate) => [rate, rate / TELEVISION]);
/** Fraction of the frames that have keys, at any other rate: times of two decimals are all on a grid of 100 per second. */
const MIN_KEYED = 0.5;
/** Keys that are closer, in seconds, are one moment: a step. */
const SAME_MOMENT = 4e-4;
/** Lists of times of one length, start and end that another is compared with. */
const MAX_COMPARED = 4;
/** Frames between keys that are the closest. */
const MAX_BETWEEN = 12;
/** Times between keys that differ by less than this factor are the same number of frames, if they are few. */
const ALIKE = 1.05;
/** Tolerance of times, as a fraction of a frame: covers times of three decimals. */
const SAME_FRAME = 0.02;
/** Relative error of a rounded frame time, 0.016667; television rates differ from whole ones by ten times as much. */
const ROUNDED = 1e-4;

/** Least rate, per second, whose frames say all of a motion between its keys. */
export function leastRate(isStraight: boolean): number {
  return isStraight ? MIN_STRAIGHT : MIN_CURVED;
}

/** Whether all keyed channels have `linear` tangents only. */
export function isStraight({ channels }: Pick<Take, 'channels'>): boolean {
  return channels.every(
    (channel) =>
      channel.kind !== 'keys' ||
      [channel.tangentsIn, channel.tangentsOut].every(({ kinds }) => kinds.every((kind) => kind === LINEAR)),
  );
}

function rateOfKeys(take: Motion): number | undefined {
  const times = take.channels.flatMap((channel) => (channel.kind === 'keys' ? [channel.times] : []));
  return rateOfTimes(times, isStraight(take));
}

/**
 * Frames per second of keys: the lowest rate that has all of them on frames, counted from the first; undefined if there
 * is none that counts.
 * @param times ascending seconds of each channel
 * @param isStraight whether all curves are straight between keys
 */
export function rateOfTimes(times: readonly Float64Array[], isStraight: boolean): number | undefined {
  const moments = momentsOf(times);
  if (moments.length < 2) return undefined;
  const closest = closestOf(moments);
  for (let between = 1; between <= MAX_BETWEEN; between++) {
    const grid = gridOf(moments, closest / between);
    if (!grid) continue;
    const rate = meantRate(grid);
    const isCommon = COMMON.some((common) => Math.abs(common / rate - 1) < ROUNDED);
    const isKeyed = moments.length >= MIN_KEYED * grid.frames;
    if (rate >= leastRate(isStraight) && (isCommon || isKeyed)) return rate;
    // A finer grid has them too, but nothing says so.
    return undefined;
  }
  return undefined;
}

/** All times, ascending, each once. */
function momentsOf(times: readonly Float64Array[]): Float64Array {
  const lists = distinct(times);
  const all = new Float64Array(lists.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const list of lists) {
    all.set(list, at);
    at += list.length;
  }
  all.sort();
  let count = 0;
  for (const time of all) if (count === 0 || time - all[count - 1] > SAME_MOMENT) all[count++] = time;
  return all.subarray(0, count);
}

/** Without those that have the times of another: of most takes all channels have the same. */
function distinct(times: readonly Float64Array[]): readonly Float64Array[] {
  const alike = new Map<string, Float64Array[]>();
  for (const list of times) {
    const key = `${list.length} ${list[0]} ${list[list.length - 1]}`;
    const known = alike.get(key) ?? [];
    // Few differ in between only: the first few are compared.
    const isKnown = known.slice(0, MAX_COMPARED).some((other) => list.every((time, i) => time === other[i]));
    if (isKnown) continue;
    known.push(list);
    alike.set(key, known);
  }
  return [...alike.values()].flat();
}

/** The mean of the shortest times between two moments: of rounded ones no single one is right. */
function closestOf(moments: Float64Array): number {
  let least = Number.POSITIVE_INFINITY;
  for (let i = 1; i < moments.length; i++) least = Math.min(least, moments[i] - moments[i - 1]);
  let [sum, count] = [0, 0];
  for (let i = 1; i < moments.length; i++) {
    const seconds = moments[i] - moments[i - 1];
    if (seconds > ALIKE * least) continue;
    sum += seconds;
    count++;
  }
  return sum / count;
}

interface Grid {
  readonly frameSeconds: number;
  /** From the first moment to the last. */
  readonly frames: number;
  /** How far a moment is off its frame at most; a fraction of one. */
  readonly off: number;
}

/** The grid of about that spacing with all moments; measured ever more exactly on the way from the first to the last. */
function gridOf(moments: Float64Array, about: number): Grid | undefined {
  const [start] = moments;
  let frameSeconds = about;
  let frames = 0;
  let last = start;
  for (const time of moments) {
    const step = (time - last) / frameSeconds;
    if (Math.abs(step - Math.round(step)) > 2 * SAME_FRAME + ROUNDED * step) return undefined;
    frames += Math.round(step);
    last = time;
    if (frames > 0) frameSeconds = (time - start) / frames;
  }
  let off = 0;
  for (const time of moments) {
    const frame = (time - start) / frameSeconds;
    off = Math.max(off, Math.abs(frame - Math.round(frame)));
  }
  return off <= SAME_FRAME ? { frameSeconds, frames, off } : undefined;
}

/** The usual rate that the grid can't be told from, else its own. */
function meantRate({ frameSeconds, frames, off }: Grid): number {
  const rate = 1 / frameSeconds;
  const isMeant = (usual: number) => {
    const away = Math.abs(usual * frameSeconds - 1);
    return frames * away <= 3 * off || (away < ROUNDED && frames * away < MAX_LOST_FRAMES);
  };
  return usualNear(rate).find(isMeant) ?? rate;
}
