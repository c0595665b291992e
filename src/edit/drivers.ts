/**
 * Takes that are put onto other characters: what is held of the one that moves, and keeping it in step.
 *
 * A driver holds what it needs of its source, so that a pose stays a matter of one character. Whenever a step changes
 * the source, its drivers follow in the very same step: undo takes both back. A source that goes, or shows no take any
 * more, leaves them as they are.
 */
import { type Character, type Document, type DriverSource, findCharacter, shownClip } from '../model/document.ts';

/** What of a character moves another; undefined where it has no skeleton, or shows no take. */
export function driverSource(character: Character): DriverSource | undefined {
  const { name, skeleton, pose, clampsToLimits, timeOffsetSeconds, space } = character;
  const clip = shownClip(character);
  if (!skeleton || !clip) return undefined;
  return { name, skeleton, clip, pose, clampsToLimits, timeOffsetSeconds, ...(space && { space }) };
}

/** Characters whose take can be put onto another one. */
export function possibleSources(document: Document, target: Character): readonly Character[] {
  return document.characters.filter((c) => c.id !== target.id && !c.driver && driverSource(c) !== undefined);
}

/** The document with drivers that have what their sources have become; the same object where none has changed. */
export function followSources(before: Document, after: Document): Document {
  if (before === after || !after.characters.some((c) => c.driver)) return after;
  let changed = false;
  const characters = after.characters.map((c) => {
    if (!c.driver) return c;
    const now = findCharacter(after, c.driver.sourceId);
    // Only what this step has changed: an undone document holds copies of what was changed in it.
    if (!now || sameSource(now, findCharacter(before, c.driver.sourceId))) return c;
    const source = driverSource(now);
    if (!source) return c;
    changed = true;
    return { ...c, driver: { ...c.driver, source } };
  });
  return changed ? { ...after, characters } : after;
}

function sameSource(a: Character, b: Character | undefined): boolean {
  return (
    a === b ||
    (b !== undefined &&
      a.name === b.name &&
      a.skeleton === b.skeleton &&
      shownClip(a) === shownClip(b) &&
      a.pose === b.pose &&
      a.clampsToLimits === b.clampsToLimits &&
      a.timeOffsetSeconds === b.timeOffsetSeconds &&
      a.space === b.space)
  );
}

/** The character with its own take and pose again; the same object where nothing else moves it. */
export function withoutDriver(character: Character): Character {
  if (!character.driver) return character;
  const { driver: _gone, ...rest } = character;
  return rest;
}
