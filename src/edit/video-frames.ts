/** The times of a video's frames. */
import type { Playback } from './playback.ts';

/** The frames of a video, by the time that each shows. */
export interface VideoFrames {
  /** At least 1. */
  readonly count: number;
  /** Seconds of the transport. */
  timeOf(frame: number): number;
}

/** Parts of a frame that are rounding. */
const ROUND_OFF = 1e-6;

/**
 * Frames of a range, beginning at its start, or at its end if `rate` is negative. A range that loops leaves out the
 * other end, which looks the same: the video loops too.
 *
 * @param framesPerSecond of the video, above 0; `rate` is not 0
 */
export function videoFrames({
  range: [start, end],
  rate,
  loop,
  framesPerSecond,
}: Pick<Playback, 'range' | 'rate' | 'loop' | 'framesPerSecond'>): VideoFrames {
  const frames = ((end - start) / Math.abs(rate)) * framesPerSecond;
  const count = loop === 'loop' ? Math.ceil(frames - ROUND_OFF) : Math.floor(frames + ROUND_OFF) + 1;
  const from = rate < 0 ? end : start;
  return { count: Math.max(1, count), timeOf: (frame) => from + (frame * rate) / framesPerSecond };
}
