/** Sources of retargeting (`../drivers.ts`): what drivers contain of them, and keeping that up to date. */
import { type Character, type Document, type DriverSource, findCharacter, shownTake } from '../../model/document.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { sameValue } from '../delta.ts';
import { isPossibleSource } from '../drivers.ts';
import { remapPairs } from '../rig/by-joint.ts';
import { provideFollow } from './code.ts';

/** Passes this code on to what changes documents, before there is a driver. */
export function provideSources(): void {
  provideFollow({ sources: followSources, sourcePairs: withSourcePairs });
}

/** The data that retargeting needs of a character; undefined if it has no skeleton or shows no take. */
export function driverSource(character: Character): DriverSource | undefined {
  const { name, skeleton, pose, clampsToLimits, timeOffsetSeconds, space, limbs, placements, leaders } = character;
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
    ...(take.attached && leaders && { placements, leaders }),
  };
}

/** Characters whose take can be retargeted to another one. */
export function possibleSources(document: Document, target: Character): readonly Character[] {
  return document.characters.filter((c) => c.id !== target.id && isPossibleSource(c));
}

/** The document with drivers updated to their sources; the same object if none changed. */
function followSources(before: Document, after: Document): Document {
  if (before === after || !after.characters.some((c) => c.driver)) return after;
  let changed = false;
  const characters = after.characters.map((c) => {
    if (!c.driver) return c;
    const now = findCharacter(after, c.driver.sourceId);
    // Only what this step has changed, since an undone document contains copies.
    if (!now || sameSource(now, findCharacter(before, c.driver.sourceId))) return c;
    const source = driverSource(now);
    if (!source || isSame(source, c.driver.source)) return c;
    changed = true;
    return { ...c, driver: { ...c.driver, source } };
  });
  return changed ? { ...after, characters } : after;
}

function sameSource(a: Character, b: Character | undefined): boolean {
  if (a === b) return true;
  const [one, other] = [driverSource(a), b && driverSource(b)];
  return one === undefined ? other === undefined : other !== undefined && isSame(one, other);
}

const FIELDS = [
  ...(['name', 'skeleton', 'take', 'pose', 'clampsToLimits', 'timeOffsetSeconds'] as const),
  ...(['space', 'limbs', 'placements', 'leaders'] as const),
];

function isSame(a: DriverSource, b: DriverSource): boolean {
  return FIELDS.every((key) => a[key] === b[key]);
}

/**
 * Characters retargeted from this one refer to its joints by index. They get its new skeleton and their new pairs at
 * once; a driver that no longer follows it keeps both.
 *
 * @param characters including the changed one
 * @param before its previous skeleton
 */
export function withSourcePairs(
  characters: readonly Character[],
  characterId: string,
  before: Skeleton,
  to: ArrayLike<number>,
): readonly Character[] {
  // Compared by value: undo rebuilds a character's skeleton and the copy in a driver separately.
  const isMoved = ({ driver }: Character) =>
    driver?.sourceId === characterId && sameValue(driver.source.skeleton, before);
  if (!characters.some(isMoved)) return characters;
  const changed = characters.find((c) => c.id === characterId);
  const source = changed && driverSource(changed);
  if (!source) return characters;
  return characters.map((c) =>
    c.driver && isMoved(c)
      ? { ...c, driver: { ...c.driver, source, pairs: remapPairs(c.driver.pairs, 'source', to) } }
      : c,
  );
}
