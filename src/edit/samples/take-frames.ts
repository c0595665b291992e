/**
 * Takes as frames that can be joined, cut and blended: every DOF of the character sampled, from the first channel on.
 */
import { bakeClip, framesOf, ownFrames } from '../../evaluate/bake.ts';
import { frameRateOf } from '../../evaluate/samples/frame-rate.ts';
import type { Character } from '../../model/document.ts';
import { characterDofs, jointDofCount, rootDofCount } from '../../model/skeleton/dofs.ts';
import { type ChannelClip, SAMPLED } from '../../model/takes/clip.ts';
import { rangeOfSamples, type Samples } from '../../model/takes/samples.ts';
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
  clip: ChannelClip,
  framesPerSecond = frameRateOf(clip) ?? KEYED_RATE,
): Samples {
  const { samples } = clip;
  const width = characterDofs(character.skeleton, character.morphs).length;
  const isAll =
    samples?.firstChannel === 0 &&
    samples.scales.length >= width &&
    clip.channels.every(({ kind }, c) => c >= width || kind === 'samples');
  if (samples && isAll) {
    const first = firstFrameFrom(samples, clip.range[0]);
    const end = lastFrameTo(samples, clip.range[1]) + 1;
    return first < end ? framesBetween(samples, first, end) : samples;
  }
  const alone = takeAlone(character, clip);
  const own = ownFrames(alone);
  const frames = framesOf(clip.range, own ? 1 / own.frameSeconds : framesPerSecond);
  refuseTooMany(frames.frameCount, width);
  return bakeClip(alone, frames);
}

/** The samples of a take whose channels all follow them, and drive all DOFs; refuses others. */
export function framesOnly({ skeleton }: Pick<Character, 'skeleton'>, clip: ChannelClip): Samples {
  const samples = requireSamples(clip);
  const isAll = samples.firstChannel === 0 && samples.scales.length >= clip.channels.length;
  const [found, all] = [clip.channels.length, rootDofCount(skeleton) + jointDofCount(skeleton)];
  if (found < all) {
    throw new CommandError(
      `${clip.name} has frames for ${found} of ${all} DOFs, and they can't be moved without the others.`,
    );
  }
  if (isAll && clip.channels.every(({ kind }) => kind === 'samples')) return samples;
  throw new CommandError(`${clip.name} has keys as well as samples, and frames can't be moved without the keys.`);
}

/** A clip of frames, with their whole time as its range. */
export function clipOfFrames(clip: ChannelClip, samples: Samples): ChannelClip {
  const sampled = clip.samples && clip.channels.every(({ kind }) => kind === 'samples');
  const channels = sampled ? clip.channels : Array.from(samples.scales, () => SAMPLED);
  return { ...clip, channels, range: rangeOfSamples(samples), samples };
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
