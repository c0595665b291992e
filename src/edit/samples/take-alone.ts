/**
 * A character as one of its takes has it: nothing set by hand, no limits held, no offset in time, no other character's
 * take that moves it. For `poseAt`.
 */
import type { ChannelClip } from '../../model/clip.ts';
import type { Character } from '../../model/document.ts';

export function takeAlone(character: Character, clip: ChannelClip): Character {
  const { unkeyed: _byHand, driver: _another, ...rest } = character;
  return { ...rest, clips: [clip], shownClip: 0, clampsToLimits: false, timeOffsetSeconds: 0 };
}
