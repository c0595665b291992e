/**
 * A character exactly as in one of its takes, for `poseAt`: without unkeyed changes, limits, time offset or
 * retargeting.
 */

import type { Character } from '../../model/document.ts';
import type { Take } from '../../model/takes/take.ts';

/** The character with `take` as its only take, shown; times of the transport are then those of the take. */
export function takeAlone(character: Character, take: Take): Character {
  const { unkeyed: _byHand, driver: _another, ...rest } = character;
  return { ...rest, takes: [take], shownTake: 0, clampsToLimits: false, timeOffsetSeconds: 0 };
}
