/**
 * Takes as frames that can be joined, cut and blended: every DOF of the character sampled, from the first channel on.
 */
import { bakeTake, framesOf, ownFrames } from '../../evaluate/bake.ts';
import { frameRateOf } from '../../evaluate/samples/frame-rate.ts';
import type { Character } from '../../model/document.ts';
import { characterDofs, jointDofCount, rootDofCount } from '../../model/skeleton/dofs.ts';
import { rangeOfSamples, type Samples } from '../../model/takes/samples.ts';
import { SAMPLED, type Take } from '../../model/takes/take.ts';
import { CommandError } from '../command-error.ts';
import { firstFrameFrom, framesBetween, lastFrameTo, requireSamples } from './frames.ts';
import { refuseTooMany } from './most-frames.ts';
import { takeAlone } from './take-alone.ts';

/** Frames per second of takes that have none. */
export const KEYED_RATE = 60;

/**
 * The frames of a take's playback range. Those of captures are the same numbers; keys, and takes with both, are sampled
 * at the take's own frame rate or at the given one.
 */
export function takeFrames(
  character: Character,
  take: Take,
  framesPerSecond = frameRateOf(take) ?? KEYED_RATE,
): Samples {
  const { samples } = take;
  const width = characterDofs(character.skeleton, character.morphs).length;
  const isAll =
    samples?.firstChannel === 0 &&
    samples.scales.length >= width &&
    take.channels.every(({ kind }, c) => c >= width || kind === 'samples');
  if (samples && isAll) {
    const first = firstFrameFrom(samples, take.range[0]);
    const end = lastFrameTo(samples, take.range[1]) + 1;
    return first < end ? framesBetween(samples, first, end) : samples;
  }
  const alone = takeAlone(character, take);
  const own = ownFrames(alone);
  const frames = framesOf(take.range, own ? 1 / own.frameSeconds : framesPerSecond);
  refuseTooMany(frames.frameCount, width);
  return bakeTake(alone, frames);
}

/** The samples of a take whose channels all follow them, and drive all DOFs; refuses others. */
export function framesOnly({ skeleton }: Pick<Character, 'skeleton'>, take: Take): Samples {
  const samples = requireSamples(take);
  const isAll = samples.firstChannel === 0 && samples.scales.length >= take.channels.length;
  const [found, all] = [take.channels.length, rootDofCount(skeleton) + jointDofCount(skeleton)];
  if (found < all) {
    throw new CommandError(
      `${take.name} has frames for ${found} of ${all} DOFs, and they can't be moved without the others.`,
    );
  }
  if (isAll && take.channels.every(({ kind }) => kind === 'samples')) return samples;
  throw new CommandError(`${take.name} has keys as well as samples, and frames can't be moved without the keys.`);
}

/** A take of frames, with their whole time as its range. */
export function takeOfFrames(take: Take, samples: Samples): Take {
  const sampled = take.samples && take.channels.every(({ kind }) => kind === 'samples');
  const channels = sampled ? take.channels : Array.from(samples.scales, () => SAMPLED);
  return { ...take, channels, range: rangeOfSamples(samples), samples };
}

/** Writes the values of a frame in model units. */
export function readFrame({ values, scales }: Samples, frame: number, out: Float64Array): void {
  const at = frame * scales.length;
  for (let k = 0; k < scales.length && k < out.length; k++) out[k] = values[at + k] * scales[k];
}

/** Replaces the values of a frame; those that are unchanged keep their exact number. */
export function writeFrame({ values, scales }: Samples, frame: number, dofs: ArrayLike<number>): void {
  const at = frame * scales.length;
  for (let k = 0; k < scales.length && k < dofs.length; k++) {
    if (values[at + k] * scales[k] !== dofs[k]) values[at + k] = dofs[k] / scales[k];
  }
}
