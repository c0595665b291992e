/** The review's checks of takes that are exported. */
import type { ArrayTake } from '../../dataset/take.ts';
import { runToEnd } from '../../evaluate/steps.ts';
import type { Character } from '../../model/document.ts';
import { isUnlimited } from '../../model/skeleton/skeleton.ts';
import { checkDisplayed, checkTake, TakeCheck } from '../../review/check-take.ts';
import { flagText } from '../../review/flags.ts';
import { takeFrames } from '../../review/frames.ts';

/**
 * What the checks find, as texts: in a take as it was read, at all of its frames; in one that is mirrored or
 * retargeted, in the result, whose joints are others.
 */
export function flagsOf(take: ArrayTake, read: Character): readonly string[] {
  const { character } = take;
  const { skeleton, takes, shownTake, space } = read;
  if (character !== read) return runToEnd(checkDisplayed(character)).map(flagText);
  return skeleton ? checkTake(skeleton, takes[shownTake], space).map(flagText) : [];
}

/**
 * Checks to which the frames of the exported take can be given; undefined if these are other ones than those that were
 * read: mirrored, retargeted, at other times, in another space, or kept within limits.
 */
export function checkOf(take: ArrayTake, read: Character): TakeCheck | undefined {
  const { character, skeleton, space, frames } = take;
  const { clampsToLimits, unkeyed, driver, timeOffsetSeconds } = character;
  if (character !== read || !space || driver || unkeyed || timeOffsetSeconds !== 0) return undefined;
  if (skeleton.joints.length === 0) return undefined;
  if (clampsToLimits && skeleton.joints.some(({ limits }) => !limits.every(isUnlimited))) return undefined;
  const own = takeFrames(skeleton, character.takes[character.shownTake], space);
  const areSame =
    own.count === frames.frameCount &&
    own.frameSeconds === frames.frameSeconds &&
    own.startSeconds === frames.startSeconds;
  return areSame ? new TakeCheck(own, space) : undefined;
}
