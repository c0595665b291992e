/**
 * The frames of a take. Motion capture converted to keys has a key at every frame, and sampling it at exactly these
 * times gives the original: if one channel has evenly spaced keys over the whole range, and all other keys are at some
 * of these times, they are the frames.
 */

import { perObject } from '../../model/per-object.ts';
import { baseOf, type KeyedChannel, type Take } from '../../model/takes/take.ts';
import { type Frames, framesOf } from '../bake.ts';
import { frameRateOf, isStraight, leastRate } from './frame-rate.ts';

/** Relative difference of frame rates that are the same. */
const SAME_RATE = 1e-3;
/** Tolerance of times, as a fraction of a frame: covers the rounding of decimals in files. */
const SAME_FRAME = 1e-4;

/**
 * Frames over a take: those of its samples or keys, else at its frame rate.
 * @param framesPerSecond of a take that has none
 */
export function framesOfTake(take: Take, framesPerSecond: number): Frames {
  const { range } = take;
  const { samples } = baseOf(take);
  if (samples) {
    const { startSeconds, frameSeconds, frameCount } = samples;
    return { startSeconds, frameSeconds, frameCount };
  }
  const rate = frameRateOf(take);
  const keyed = keyFrames(take);
  const isSame = keyed && rate !== undefined && Math.abs(rate * keyed.frameSeconds - 1) < SAME_RATE;
  return isSame ? keyed : framesOf(range, rate ?? framesPerSecond);
}

/** The frames of all keys of a take; undefined if it has samples or uneven keys. Cached per take. */
export const keyFrames = perObject(find);

function find(take: Take): Frames | undefined {
  const { range } = take;
  const base = baseOf(take);
  const { channels, samples } = base;
  if (samples) return undefined;
  const keyed = channels.filter((channel) => channel.kind === 'keys');
  const longest = keyed.reduce<KeyedChannel | undefined>(
    (best, channel) => (channel.times.length > (best?.times.length ?? 1) ? channel : best),
    undefined,
  );
  const frames = longest && evenTimes(longest.times);
  if (!frames) return undefined;
  const { startSeconds, frameSeconds, frameCount } = frames;
  if (!(frameSeconds * leastRate(isStraight(base)) <= 1)) return undefined;
  const frameOf = (seconds: number) => (seconds - startSeconds) / frameSeconds;
  const isFrame = (seconds: number) => {
    const frame = Math.round(frameOf(seconds));
    return frame >= 0 && frame < frameCount && Math.abs(frameOf(seconds) - frame) < SAME_FRAME;
  };
  const isAtEnds = Math.round(frameOf(range[0])) === 0 && Math.round(frameOf(range[1])) === frameCount - 1;
  if (!isAtEnds || !range.every(isFrame)) return undefined;
  return keyed.every(({ times }) => times === longest.times || times.every(isFrame)) ? frames : undefined;
}

/** The frame duration that reproduces these times exactly, if any; otherwise their average. */
function evenTimes(times: Float64Array): Frames | undefined {
  const frameCount = times.length;
  const [startSeconds, last] = [times[0], times[frameCount - 1]];
  const mean = (last - startSeconds) / (frameCount - 1);
  if (!(mean > 0)) return undefined;
  if (!times.every((t, f) => Math.abs(t - startSeconds - f * mean) < SAME_FRAME * mean)) return undefined;
  const first = times[1] - startSeconds;
  const isExact = times.every((t, f) => t === startSeconds + f * first);
  return { startSeconds, frameSeconds: isExact ? first : mean, frameCount };
}
