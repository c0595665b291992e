/** Characters as their takes have them. */
import type { Character } from '../model/document.ts';

/** A character, and those it follows, without unkeyed changes: what files and exports hold. */
export function inTakes(character: Character): Character {
  const { unkeyed: _byHand, leaders, ...rest } = character;
  return leaders ? { ...rest, leaders: leaders.map(inTakes) } : rest;
}
