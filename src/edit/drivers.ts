/**
 * Live retargeting: what is stored of the source, and keeping it up to date.
 *
 * A driver contains what it needs of its source, so that a pose depends on one character only. When a step changes the
 * source, its drivers are updated in the same step, so that undo reverts both. A source that is removed, or shows no
 * take any more, leaves them unchanged.
 */
import { type Character, type Document, type DriverSource, findCharacter, shownTake } from '../model/document.ts';

/** As the take of a `TakeRef`: the take of another character, which is retargeted to this one live. */
export const RETARGETED = -2;

/** The data that retargeting needs of a character; undefined if it has no skeleton or shows no take. */
export function driverSource(character: Character): DriverSource | undefined {
  const { name, skeleton, pose, clampsToLimits, timeOffsetSeconds, space, limbs } = character;
  const take = shownTake(character);
  if (!skeleton || !take) return undefined;
  return {
    name,
    skeleton,
    take,
    pose,
    clampsToLimits,
    timeOffsetSeconds,
    ...(space && { space }),
    ...(limbs && { limbs }),
  };
}

/** Whether a character's take can be retargeted to another one. */
export function isPossibleSource(character: Character): boolean {
  return !character.driver && character.skeleton !== undefined && shownTake(character) !== undefined;
}

/** Characters whose take can be retargeted to another one. */
export function possibleSources(document: Document, target: Character): readonly Character[] {
  return document.characters.filter((c) => c.id !== target.id && isPossibleSource(c));
}

/** The document with drivers updated to their sources; the same object if none changed. */
export function followSources(before: Document, after: Document): Document {
  if (before === after || !after.characters.some((c) => c.driver)) return after;
  let changed = false;
  const characters = after.characters.map((c) => {
    if (!c.driver) return c;
    const now = findCharacter(after, c.driver.sourceId);
    // Only what this step has changed, since an undone document contains copies.
    if (!now || sameSource(now, findCharacter(before, c.driver.sourceId))) return c;
    const source = driverSource(now);
    if (!source) return c;
    changed = true;
    return { ...c, driver: { ...c.driver, source } };
  });
  return changed ? { ...after, characters } : after;
}

/** The fields of a source that are those of its character. */
const OF_CHARACTER = ['name', 'skeleton', 'pose', 'clampsToLimits', 'timeOffsetSeconds', 'space', 'limbs'] as const;

function sameSource(a: Character, b: Character | undefined): boolean {
  return (
    a === b || (b !== undefined && shownTake(a) === shownTake(b) && OF_CHARACTER.every((key) => a[key] === b[key]))
  );
}

/** The character without retargeting; the same object if it has none. */
export function withoutDriver(character: Character): Character {
  if (!character.driver) return character;
  const { driver: _gone, ...rest } = character;
  return rest;
}
