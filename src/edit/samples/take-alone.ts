/**
 * A character exactly as in one of its takes, for `poseAt`: without unkeyed changes, limits, time offset or
 * retargeting.
 */

import { inTakes } from '../../evaluate/in-takes.ts';
import type { Character } from '../../model/document.ts';
import type { Take } from '../../model/takes/take.ts';

/** The character with `take` as its only take, shown; times of the transport are then those of the take. */
export function takeAlone(character: Character, take: Take): Character {
  const { driver: _another, ...rest } = inTakes(character);
  return { ...rest, takes: [take], shownTake: 0, clampsToLimits: false, timeOffsetSeconds: 0 };
}
