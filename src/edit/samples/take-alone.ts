/**
 * A character exactly as in one of its takes, for `poseAt`: without unkeyed changes, limits, time offset or
 * retargeting.
 */

import type { Character } from '../../model/document.ts';
import type { ChannelClip } from '../../model/takes/clip.ts';

/** The character with `clip` as its only take, shown; times of the transport are then those of the clip. */
export function takeAlone(character: Character, clip: ChannelClip): Character {
  const { unkeyed: _byHand, driver: _another, ...rest } = character;
  return { ...rest, clips: [clip], shownClip: 0, clampsToLimits: false, timeOffsetSeconds: 0 };
}
