/**
 * Baking: samples what a character does at uniform times. The result has the layout of motion capture, so that writers
 * and tools have one input, whatever drove the character: keys with tangents and extrapolation, samples, linked DOFs,
 * limits.
 *
 *     frame f     the pose at startSeconds + f · frameSeconds, in seconds of the take
 */

import type { Character } from '../model/document.ts';
import { shownTake } from '../model/document.ts';
import type { Samples } from '../model/takes/samples.ts';
import type { Take } from '../model/takes/take.ts';
import { inTakes } from './in-takes.ts';
import { dofCountOf, poseAt } from './pose.ts';

/** Evenly spaced times. */
export interface Frames {
  readonly startSeconds: number;
  /** Greater than 0. */
  readonly frameSeconds: number;
  /** At least 1. */
  readonly frameCount: number;
}

/** More than this is refused: real takes have fewer frames, so such a rate or range is a mistake. */
export const MAX_FRAMES = 1_000_000;
/** Most values that may be baked, frames times channels: 800 MB. */
export const MAX_VALUES = 100_000_000;

/** Fraction of a frame below which a time counts as that frame: 2.3 s at 30 FPS are 69 frames, not 68.99. */
const SAME_FRAME = 1e-6;

/**
 * Files round the time of a frame to six or seven digits, 0.0333333 s for a thirtieth: part of a range by which its
 * last frame is missed, though never half a frame.
 */
const ROUNDED = 2e-6;

/** As many frames as fit into a range, the first at its start. */
export function framesOf(range: readonly [number, number], framesPerSecond: number): Frames {
  const [start, end] = range;
  const exact = (end - start) * framesPerSecond;
  const count = Math.floor(exact + Math.min(0.5, SAME_FRAME + ROUNDED * exact)) + 1;
  return { startSeconds: start, frameSeconds: 1 / framesPerSecond, frameCount: Math.max(1, count) };
}

/** The take that drives a character: a retargeted one, or else its own shown take. */
export function playedTake(character: Character): Take | undefined {
  return character.driver?.source.take ?? shownTake(character);
}

/** The frames at which the take that drives a character was sampled; undefined if it has no samples. */
export function ownFrames(character: Character): Frames | undefined {
  const samples = playedTake(character)?.samples;
  if (!samples) return undefined;
  const { startSeconds, frameSeconds, frameCount } = samples;
  return { startSeconds, frameSeconds, frameCount };
}

/**
 * Calls `see` with every DOF of the character at each frame: the shown take over the pose as set, within limits if they
 * are enforced, without unkeyed changes. The array is reused.
 */
export function eachFrame(
  character: Character,
  frames: Frames,
  see: (dofs: Float64Array<ArrayBuffer>, frame: number) => void,
): void {
  const played: Character = { ...inTakes(character), timeOffsetSeconds: 0 };
  const startSeconds = frames.startSeconds - (character.driver?.source.timeOffsetSeconds ?? 0);
  const dofs = new Float64Array(dofCountOf(played));
  for (let frame = 0; frame < frames.frameCount; frame++) {
    poseAt(played, startSeconds + frame * frames.frameSeconds, dofs);
    see(dofs, frame);
  }
}

/** The character's DOFs at each frame, including morph weights, in radians and length units, one column per channel. */
export function bakeTake(character: Character, frames: Frames): Samples {
  const width = dofCountOf(character);
  const values = new Float64Array(frames.frameCount * width);
  eachFrame(character, frames, (dofs, frame) => values.set(dofs, frame * width));
  return { ...frames, firstChannel: 0, values, scales: new Float64Array(width).fill(1), interpolation: 'linear' };
}
