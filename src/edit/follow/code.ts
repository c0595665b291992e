/**
 * Characters that contain something of others: retargeted ones (`sources.ts`), and those that follow a joint
 * (`leaders.ts`). Few documents have any, so the code that keeps them up to date comes with what makes the first one,
 * and is passed on before.
 */
import type { Character, Document } from '../../model/document.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';

interface FollowCode {
  /** Both return the document with characters as the changed ones have them; the same object if none contains one. */
  sources(before: Document, after: Document): Document;
  leaders(before: Document, after: Document): Document;
  /** As `withSourcePairs`. */
  sourcePairs: typeof withSourcePairs;
}

let provided: Partial<FollowCode> = {};

/** Passes on some of the functions. */
export function provideFollow(code: Partial<FollowCode>): void {
  provided = { ...provided, ...code };
}

/** A changed document in which all that contain something of others are up to date. */
export function followed(before: Document, after: Document): Document {
  const { sources, leaders } = provided;
  let next = after;
  // What leads may be retargeted, from one that follows another: as often as it takes.
  for (let left = after.characters.length; left > 0; left--) {
    const now = next;
    next = sources?.(before, next) ?? next;
    next = leaders?.(before, next) ?? next;
    if (next === now || !sources || !leaders) break;
  }
  return next;
}

/**
 * The characters with pairs of retargeting as the joints of their source now are.
 * @param characters including the changed one
 * @param before its previous skeleton
 * @param to for each old joint its new index; -1 if removed
 */
export function withSourcePairs(
  characters: readonly Character[],
  characterId: string,
  before: Skeleton,
  to: ArrayLike<number>,
): readonly Character[] {
  return provided.sourcePairs?.(characters, characterId, before, to) ?? characters;
}
