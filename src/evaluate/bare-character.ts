/** Frames of a character that is not in the document yet, evenly over its take; used for guesses when a file is opened. */

import type { Character } from '../model/document.ts';
import { newCharacter } from '../model/new-character.ts';
import { filePose } from '../model/skeleton/dofs.ts';
import type { Skeleton } from '../model/skeleton/skeleton.ts';
import type { Take } from '../model/takes/take.ts';
import { poseFrom, poseSource } from './pose.ts';

/** A character with nothing but a skeleton and perhaps a take; its limits are not enforced. */
export function bareCharacter(skeleton: Skeleton, take: Take | undefined): Character {
  return {
    ...newCharacter('', ''),
    skeleton,
    takes: take ? [take] : [],
    shownTake: take ? 0 : -1,
    pose: filePose(skeleton, 0),
    clampsToLimits: false,
  };
}

/**
 * Calls `visit` with the character's DOFs (`model/dofs.ts`) at up to `most` times, first and last included; once, with
 * the file pose, if there is no take. The array is reused.
 */
export function forFrames(
  skeleton: Skeleton,
  take: Take | undefined,
  most: number,
  visit: (dofs: Float64Array) => void,
): void {
  const character = bareCharacter(skeleton, take);
  const source = poseSource(character);
  const dofs = new Float64Array(source.count);
  const [start, end] = take?.range ?? [0, 0];
  const count = end > start ? Math.max(2, Math.min(most, take?.samples?.frameCount ?? most)) : 1;
  for (let i = 0; i < count; i++) {
    poseFrom(source, start + ((end - start) * i) / Math.max(1, count - 1), dofs);
    visit(dofs);
  }
}
