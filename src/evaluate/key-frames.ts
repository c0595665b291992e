/**
 * Finds the frame rate of a keyed clip, if its keys have one: motion capture converted to keys has a key at every
 * frame, and sampling it at that rate gives the original.
 *
 * A clip has a rate if one channel has evenly spaced keys over the whole range, and all other keys are at some of these
 * times. Keys set by hand, one per second or so, are evenly spaced too, but sampling at them would lose the curve in
 * between. So a rate counts from 10 per second if curves are straight between keys, and from 23 (film's 23.976) if not.
 */
import { type ChannelClip, type KeyedChannel, LINEAR } from '../model/clip.ts';
import { perObject } from '../model/per-object.ts';
import type { Frames } from './bake.ts';

const MIN_STRAIGHT = 10;
const MIN_CURVED = 23;
/** Tolerance of times, as a fraction of a frame: covers the rounding of decimals in files. */
const SAME_FRAME = 1e-4;

/** The frames of all keys of a clip; undefined if it has samples or no such rate. Cached per clip. */
export const keyFrames = perObject(find);

function find({ channels, range, samples }: ChannelClip): Frames | undefined {
  if (samples) return undefined;
  const keyed = channels.filter((channel) => channel.kind === 'keys');
  const longest = keyed.reduce<KeyedChannel | undefined>(
    (best, channel) => (channel.times.length > (best?.times.length ?? 1) ? channel : best),
    undefined,
  );
  const frames = longest && evenTimes(longest.times);
  if (!frames) return undefined;
  const { startSeconds, frameSeconds, frameCount } = frames;
  const least = keyed.every(isStraight) ? MIN_STRAIGHT : MIN_CURVED;
  if (!(frameSeconds * least <= 1)) return undefined;
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

function isStraight({ tangentsIn, tangentsOut }: KeyedChannel): boolean {
  return tangentsIn.kinds.every((kind) => kind === LINEAR) && tangentsOut.kinds.every((kind) => kind === LINEAR);
}
