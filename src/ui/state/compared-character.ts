/** What of a character is compared with dumps. */
import { type Character, shownSkin, shownTake } from '../../model/document.ts';
import { vertexCount } from '../../model/skin.ts';
import { offsetOf } from './dump-times.ts';

/** What is compared of a character: the rest needn't be copied to the worker. Its times are those of the take. */
export function lean(character: Character): Character {
  const [skin, take] = [shownSkin(character), shownTake(character)];
  const { poses: _poses, parts: _parts, unkeyed, ...rest } = character;
  const offset = offsetOf(character);
  return {
    ...rest,
    skins: skin ? [skin] : [],
    shownSkin: 0,
    takes: take ? [take] : [],
    shownTake: take ? 0 : -1,
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
    shownTake(a) === shownTake(b) &&
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
      shownTake(character)?.channels.length ?? 0,
    ];
  };
  const before = sizesOf(was);
  return sizesOf(is).every((size, i) => size === before[i]);
}
