/**
 * Changes the frame rate by sampling what plays at other times. Between frames the samples are interpolated (nearest,
 * linear or cubic), with joints interpolated as rotations, not angle by angle.
 */
import { poseAt } from '../../evaluate/pose.ts';
import type { Steps } from '../../evaluate/steps.ts';
import type { Character } from '../../model/document.ts';
import { rangeOfSamples, type Samples } from '../../model/takes/samples.ts';
import type { Take } from '../../model/takes/take.ts';
import { requireSamples } from './frames.ts';
import { refuseTooMany } from './most-frames.ts';
import { takeAlone } from './take-alone.ts';

/** Frames between two yields. */
const STEP_FRAMES = 64;
/** A last frame missed by less than this fraction is included. */
const SAME_FRAME = 1e-4;

/** The take with samples at this rate, starting at its first frame; the same object if they have it. */
export function* resampling(character: Character, take: Take, framesPerSecond: number): Steps<Take> {
  const samples = requireSamples(take);
  const frameSeconds = 1 / framesPerSecond;
  if (Math.abs(frameSeconds - samples.frameSeconds) <= 1e-12 * frameSeconds) return take;
  const [start, stop] = rangeOfSamples(samples);
  const frameCount = Math.floor((stop - start) * framesPerSecond + SAME_FRAME) + 1;
  const { scales, firstChannel } = samples;
  const width = scales.length;
  refuseTooMany(frameCount, width, samples.frameCount);
  const values = new Float64Array(frameCount * width);
  const alone = takeAlone(character, take);
  const pose = new Float64Array(Math.max(take.channels.length, firstChannel + width) + character.pose.length);
  const driven = Array.from({ length: width }, (_, column) => take.channels[firstChannel + column]?.kind === 'samples');
  for (let f = 0; f < frameCount; f++) {
    const time = Math.min(stop, start + f * frameSeconds);
    poseAt(alone, time, pose);
    for (let column = 0; column < width; column++) {
      const value = driven[column] ? pose[firstChannel + column] / scales[column] : undriven(samples, column, time);
      values[f * width + column] = value;
    }
    if (f % STEP_FRAMES === STEP_FRAMES - 1) yield f / frameCount;
  }
  return { ...take, samples: { ...samples, frameCount, frameSeconds, values } };
}

/** The column beneath a channel that has keys: from the nearest frame. In file units. */
function undriven({ values, scales, startSeconds, frameSeconds, frameCount }: Samples, column: number, time: number) {
  const frame = Math.min(frameCount - 1, Math.max(0, Math.round((time - startSeconds) / frameSeconds)));
  return values[frame * scales.length + column];
}
