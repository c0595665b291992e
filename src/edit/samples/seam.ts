/**
 * The range of a filter, with a gradual transition at either end, so that there is no jump.
 *
 *     weight(f) = smoothstep((d + 1) / (s + 1))      d frames from the range's nearer end, s the seam's
 *     s = the filter's reach, or half of the range if that is less
 *
 * The seam is within the range: nothing changes outside. There is none where the range ends with the take.
 */
import { smoothstep } from '../../math/smoothstep.ts';
import { rangeOfSamples, type Samples } from '../../model/takes/samples.ts';
import { CommandError } from '../command-error.ts';
import { firstFrameFrom, lastFrameTo } from './frames.ts';

/** Frames `first` up to (excluding) `end` of a take of `frameCount`. */
export interface FrameRange {
  readonly first: number;
  readonly end: number;
  readonly frameCount: number;
}

/** The frames from one time to another, both included; all without a range. Refuses if there are none. */
export function frameRange(samples: Samples, range: readonly [number, number] | undefined): FrameRange {
  const { frameCount } = samples;
  if (!range) return { first: 0, end: frameCount, frameCount };
  const first = firstFrameFrom(samples, range[0]);
  const end = lastFrameTo(samples, range[1]) + 1;
  if (first < end) return { first, end, frameCount };
  const [start, stop] = rangeOfSamples(samples).map((seconds) => Number(seconds.toFixed(6)));
  throw new CommandError(`There are no frames there: the samples run from ${start} s to ${stop} s of the take.`);
}

/** Whether a range is the whole take, so that it has no seams. */
export function isWhole({ first, end, frameCount }: FrameRange): boolean {
  return first === 0 && end === frameCount;
}

/** The filter's weight for a frame, from 0 outside of the range to 1. */
export function weightAt({ first, end, frameCount }: FrameRange, reach: number, frame: number): number {
  if (frame < first || frame >= end) return 0;
  const seam = Math.min(reach, Math.floor((end - first) / 2));
  const into = first === 0 ? Number.POSITIVE_INFINITY : frame - first;
  const left = end === frameCount ? Number.POSITIVE_INFINITY : end - 1 - frame;
  return smoothstep(0, seam + 1, Math.min(into, left) + 1);
}
