/**
 * Baking: what a character does, sampled at uniform times. The same rows of values that motion capture is read as, so
 * that writers and tools have one input, whatever drove the character: keys with their tangents and extrapolation,
 * samples, couples, limits.
 *
 *     frame f     the pose at startSeconds + f · frameSeconds, in seconds of the clip
 */
import type { ChannelClip } from '../model/clip.ts';
import type { Character } from '../model/document.ts';
import { shownClip } from '../model/document.ts';
import type { Samples } from '../model/samples.ts';
import { dofCountOf, poseAt } from './pose.ts';

/** Uniform times. */
export interface Frames {
  readonly startSeconds: number;
  /** Above 0. */
  readonly frameSeconds: number;
  /** At least 1. */
  readonly frameCount: number;
}

/** What a page can bear: takes that were read have fewer, and a rate or range that gives more is a slip. */
export const MAX_FRAMES = 1_000_000;
/** The same for frames times channels: 800 MB. */
export const MAX_VALUES = 100_000_000;

/** Nearer to a frame than this part of one is that frame: 2.3 s at 30 a second are 69 frames, not 68.99. */
const SAME_FRAME = 1e-6;

/** As many frames as fit into a range, the first at its start. */
export function framesOf(range: readonly [number, number], framesPerSecond: number): Frames {
  const [start, end] = range;
  const count = Math.floor((end - start) * framesPerSecond + SAME_FRAME) + 1;
  return { startSeconds: start, frameSeconds: 1 / framesPerSecond, frameCount: Math.max(1, count) };
}

/** The clip that moves a character: another one's where that was put onto it, else its own that is shown. */
export function playedClip(character: Character): ChannelClip | undefined {
  return character.driver?.source.clip ?? shownClip(character);
}

/** The frames that the clip that moves a character was sampled at; undefined where it has no samples. */
export function ownFrames(character: Character): Frames | undefined {
  const samples = playedClip(character)?.samples;
  if (!samples) return undefined;
  const { startSeconds, frameSeconds, frameCount } = samples;
  return { startSeconds, frameSeconds, frameCount };
}

/**
 * Calls `see` with every DOF of the character at each frame: the shown clip over the pose as set, within limits if those
 * hold, without what was set by hand over the clip. The list is the same one each time.
 */
export function eachFrame(
  character: Character,
  frames: Frames,
  see: (dofs: Float64Array<ArrayBuffer>, frame: number) => void,
): void {
  const { unkeyed: _, ...plain } = character;
  const played: Character = { ...plain, timeOffsetSeconds: 0 };
  const startSeconds = frames.startSeconds - (character.driver?.source.timeOffsetSeconds ?? 0);
  const dofs = new Float64Array(dofCountOf(played));
  for (let frame = 0; frame < frames.frameCount; frame++) {
    poseAt(played, startSeconds + frame * frames.frameSeconds, dofs);
    see(dofs, frame);
  }
}

/** The character's DOFs at each frame, morph weights too; in radians and units of length, a column a channel. */
export function bakeClip(character: Character, frames: Frames): Samples {
  const width = dofCountOf(character);
  const values = new Float64Array(frames.frameCount * width);
  eachFrame(character, frames, (dofs, frame) => values.set(dofs, frame * width));
  return { ...frames, firstChannel: 0, values, scales: new Float64Array(width).fill(1), interpolation: 'linear' };
}
