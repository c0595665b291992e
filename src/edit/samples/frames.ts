/**
 * Finding frames by time, and takes with some of the frames: what trimming, cropping and splitting share. Frames keep
 * their times.
 *
 * Many remaining rows are a view of the originals: copying 100 MB takes longer than a display frame, and the history
 * retains the originals anyway. Few are copied, or one second would retain a whole hour.
 */

import { rangeOfSamples, type Samples } from '../../model/takes/samples.ts';
import type { Take } from '../../model/takes/take.ts';
import { withMarkers } from '../../model/takes/with-markers.ts';
import { CommandError } from '../command-error.ts';
import { markersBeside, markersWithin } from '../markers.ts';

/** Up to this many values are copied: 8 MB. */
const COPIED_VALUES = 1 << 20;
/** A time this near to a frame counts as that frame: times are shown, and so typed, with three decimals. */
const SAME_FRAME_SECONDS = 5.1e-4;

/** The same as a fraction of a frame; of many frames in a millisecond, the nearest is meant. */
function sameFrame({ frameSeconds }: Samples): number {
  return Math.min(0.5, SAME_FRAME_SECONDS / frameSeconds);
}

/** The samples of a take; refuses if it has none. */
export function requireSamples(take: Take): Samples {
  if (take.samples) return take.samples;
  throw new CommandError(`${take.name} has no samples, only keys.`);
}

/** The first frame at or after a time, from 0 to the number of frames. */
export function firstFrameFrom(samples: Samples, seconds: number): number {
  const { startSeconds, frameSeconds, frameCount } = samples;
  const frame = Math.ceil((seconds - startSeconds) / frameSeconds - sameFrame(samples));
  return Math.min(frameCount, Math.max(0, frame));
}

/** Frames `first` up to (excluding) `end`; the same samples if that is all of them. */
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
 * The take with the frames from one time to another, both included, as its playback range; keys are kept. The same
 * object if nothing is removed. Refuses if there are no frames in between.
 */
export function cropped(take: Take, from: number, to: number): Take {
  const samples = requireSamples(take);
  const first = firstFrameFrom(samples, from);
  const end = lastFrameTo(samples, to) + 1;
  if (first >= end) {
    const [start, stop] = rangeOfSamples(samples).map((seconds) => Number(seconds.toFixed(6)));
    throw new CommandError(`There are no frames there: the samples run from ${start} s to ${stop} s of the take.`);
  }
  const kept = framesBetween(samples, first, end);
  const range = rangeOfSamples(kept);
  if (kept === samples && range[0] === take.range[0] && range[1] === take.range[1]) return take;
  return withMarkers({ ...take, range, samples: kept }, markersWithin(take.markers, ...range));
}

/** The last frame at or before a time; −1 if there is none. */
export function lastFrameTo(samples: Samples, seconds: number): number {
  const { startSeconds, frameSeconds, frameCount } = samples;
  const frame = Math.floor((seconds - startSeconds) / frameSeconds + sameFrame(samples));
  return Math.min(frameCount - 1, Math.max(-1, frame));
}

/** Without the frames before a time, or after it; the frame there is kept. */
export function trimmed(take: Take, side: 'start' | 'end', seconds: number): Take {
  const everything = Number.MAX_VALUE;
  return side === 'start' ? cropped(take, seconds, everything) : cropped(take, -everything, seconds);
}

/**
 * Two takes: the frames before a time, and the others. Both keep all keys, since these determine the curve in between;
 * a marker between their frames is in the nearer one. Refuses if one would have no frame.
 */
export function split(take: Take, seconds: number): readonly [Take, Take] {
  const samples = requireSamples(take);
  const at = firstFrameFrom(samples, seconds);
  if (at === 0 || at === samples.frameCount) {
    throw new CommandError('There is nothing to split here: all frames are on one side of the playhead.');
  }
  const parts = [framesBetween(samples, 0, at), framesBetween(samples, at, samples.frameCount)];
  const ranges = parts.map(rangeOfSamples);
  const markers = markersBeside(take.markers, ranges[0][1], ranges[1][0]);
  const [before, after] = parts.map((part, i) =>
    withMarkers({ ...take, range: ranges[i], samples: part }, markersWithin(markers, ...ranges[i])),
  );
  return [before, after];
}
