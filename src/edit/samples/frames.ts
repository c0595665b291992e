/**
 * Which frames of a take lie where in time, and takes of some of them: what trimming, cropping and splitting have in
 * common. Frames keep their times.
 *
 * Many rows that stay are a view of those that were there: copying 100 MB takes longer than a frame of the screen, and
 * the history holds on to what went anyway. Few are copied, or a second of an hour would hold all of it for good.
 */
import type { ChannelClip } from '../../model/clip.ts';
import { rangeOfSamples, type Samples } from '../../model/samples.ts';
import { CommandError } from '../store.ts';

/** Up to so many values are copied: 8 MB. */
const COPIED_VALUES = 1 << 20;
/** Nearer to a frame than this part of one is that frame. */
const SAME_FRAME = 1e-4;

/** The samples of a take; refuses where it has none. */
export function requireSamples(clip: ChannelClip): Samples {
  if (clip.samples) return clip.samples;
  throw new CommandError(`${clip.name} has no samples, only keys.`);
}

/** The first frame at a time or after it, from 0 up to and with the count of frames. */
export function firstFrameFrom({ startSeconds, frameSeconds, frameCount }: Samples, seconds: number): number {
  const frame = Math.ceil((seconds - startSeconds) / frameSeconds - SAME_FRAME);
  return Math.min(frameCount, Math.max(0, frame));
}

/** Frames `first` up to (not including) `end`; the very same samples where that is all of them. */
export function framesBetween(samples: Samples, first: number, end: number): Samples {
  const { frameCount, frameSeconds, startSeconds, scales } = samples;
  if (first === 0 && end === frameCount) return samples;
  const values = samples.values.subarray(first * scales.length, end * scales.length);
  return {
    ...samples,
    frameCount: end - first,
    startSeconds: startSeconds + first * frameSeconds,
    values: values.length > COPIED_VALUES ? values : values.slice(),
  };
}

/**
 * The take with the frames from one time to another, both included, and nothing else played; keys stay. The very same
 * where nothing goes. Refuses where no frame lies there.
 */
export function cropped(clip: ChannelClip, from: number, to: number): ChannelClip {
  const samples = requireSamples(clip);
  const first = firstFrameFrom(samples, from);
  const end = lastFrameTo(samples, to) + 1;
  if (first >= end) {
    const [start, stop] = rangeOfSamples(samples).map((seconds) => Number(seconds.toFixed(6)));
    throw new CommandError(`There are no frames there: the samples run from ${start} s to ${stop} s of the take.`);
  }
  const kept = framesBetween(samples, first, end);
  const range = rangeOfSamples(kept);
  if (kept === samples && range[0] === clip.range[0] && range[1] === clip.range[1]) return clip;
  return { ...clip, range, samples: kept };
}

/** The last frame at a time or before it; −1 where there is none. */
export function lastFrameTo({ startSeconds, frameSeconds, frameCount }: Samples, seconds: number): number {
  const frame = Math.floor((seconds - startSeconds) / frameSeconds + SAME_FRAME);
  return Math.min(frameCount - 1, Math.max(-1, frame));
}

/** Without the frames before a time, or after it; the frame there stays. */
export function trimmed(clip: ChannelClip, side: 'start' | 'end', seconds: number): ChannelClip {
  const everything = Number.MAX_VALUE;
  return side === 'start' ? cropped(clip, seconds, everything) : cropped(clip, -everything, seconds);
}

/**
 * Two takes: the frames before a time, and those from it on. Keys are in both, for they say what lies between them.
 * Refuses where one of the two would have no frame.
 */
export function split(clip: ChannelClip, seconds: number): readonly [ChannelClip, ChannelClip] {
  const samples = requireSamples(clip);
  const at = firstFrameFrom(samples, seconds);
  if (at === 0 || at === samples.frameCount) {
    throw new CommandError('There is nothing to split here: all frames are on one side of the playhead.');
  }
  const parts = [framesBetween(samples, 0, at), framesBetween(samples, at, samples.frameCount)];
  const [before, after] = parts.map((part) => ({ ...clip, range: rangeOfSamples(part), samples: part }));
  return [before, after];
}
