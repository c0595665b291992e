/** What of a character is compared with dumps. */
import { type Character, shownClip, shownSkin } from '../../model/document.ts';
import { vertexCount } from '../../model/skin.ts';
import { offsetOf } from './dump-times.ts';

/** What is compared of a character: the rest needn't be copied to the worker. Its times are those of the clip. */
export function lean(character: Character): Character {
  const [skin, clip] = [shownSkin(character), shownClip(character)];
  const { poses: _poses, parts: _parts, unkeyed, ...rest } = character;
  const offset = offsetOf(character);
  return {
    ...rest,
    skins: skin ? [skin] : [],
    shownSkin: 0,
    clips: clip ? [clip] : [],
    shownClip: clip ? 0 : -1,
    timeOffsetSeconds: character.timeOffsetSeconds - offset,
    textures: [],
    sources: [],
    ...(unkeyed && { unkeyed: { ...unkeyed, timeSeconds: unkeyed.timeSeconds + offset } }),
  };
}

/** Whether two states of a character give the same numbers. */
export function isSameFor(a: Character, b: Character): boolean {
  return (
    a.skeleton === b.skeleton &&
    shownSkin(a) === shownSkin(b) &&
    shownClip(a) === shownClip(b) &&
    a.morphs === b.morphs &&
    a.pose === b.pose &&
    a.unkeyed === b.unkeyed &&
    a.driver === b.driver &&
    a.clampsToLimits === b.clampsToLimits
  );
}

/** Whether arrays of numbers of one state of a character fit another. */
export function fits(was: Character, is: Character): boolean {
  const sizesOf = (character: Character) => {
    const skin = shownSkin(character);
    return [
      character.skeleton?.joints.length ?? 0,
      skin ? vertexCount(skin) : 0,
      shownClip(character)?.channels.length ?? 0,
    ];
  };
  const before = sizesOf(was);
  return sizesOf(is).every((size, i) => size === before[i]);
}
