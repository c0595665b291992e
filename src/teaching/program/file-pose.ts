/** The pose that the skeleton file gives, as dumps without a time have it. */
import type { Character } from '../../model/document.ts';

/** The character without what moves it: a take, retargeting, unkeyed changes. */
export function inFilePose(character: Character): Character {
  const { driver: _driver, unkeyed: _unkeyed, ...still } = character;
  return { ...still, shownTake: -1 };
}
