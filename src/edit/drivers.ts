/**
 * Live retargeting: what is stored of the source, and keeping it up to date.
 *
 * A driver contains what it needs of its source, so that a pose depends on one character only. When a step changes the
 * source, its drivers are updated in the same step (`follow/sources.ts`), so that undo reverts both. A source that is
 * removed, or shows no take any more, leaves them unchanged.
 */
import { type Character, shownTake } from '../model/document.ts';

/** As the take of a `TakeRef`: the take of another character, which is retargeted to this one live. */
export const RETARGETED = -2;

/** Whether a character's take can be retargeted to another one. */
export function isPossibleSource(character: Character): boolean {
  return !character.driver && character.skeleton !== undefined && shownTake(character) !== undefined;
}

/** The character without retargeting; the same object if it has none. */
export function withoutDriver(character: Character): Character {
  if (!character.driver) return character;
  const { driver: _gone, ...rest } = character;
  return rest;
}
