/** What of characters goes by the indices of joints, beside skins: pins and stiff joints, and takes put onto others. */
import type { Character } from '../../model/document.ts';
import { defaultIk, type IkSetup } from '../../model/ik.ts';
import type { JointPair } from '../../model/retarget.ts';
import type { Skeleton } from '../../model/skeleton.ts';
import { sameValue } from '../delta.ts';
import { driverSource } from '../drivers.ts';

/** @param to of each joint before, its index after; -1 where it is gone, and what is about it goes with it */
export function remapIk({ pins, stiff, rootIsFree }: IkSetup, to: ArrayLike<number>): IkSetup {
  const moved = <T extends { readonly joint: number }>(all: readonly T[]) =>
    all.flatMap((one) => (to[one.joint] >= 0 ? [{ ...one, joint: to[one.joint] }] : []));
  return { pins: moved(pins), stiff: moved(stiff).sort((a, b) => a.joint - b.joint), rootIsFree };
}

/** The character with that setup; without one where it is what holds for its skeleton anyway. */
export function withIk(character: Character, ik: IkSetup): Character {
  const { pins, stiff, rootIsFree } = ik;
  const isDefault = pins.length + stiff.length === 0 && rootIsFree === defaultIk(character.skeleton).rootIsFree;
  if (!isDefault) return { ...character, ik };
  const { ik: _before, ...rest } = character;
  return rest;
}

/** In the order of the joints that are moved. */
export function remapPairs(
  pairs: readonly JointPair[],
  side: 'target' | 'source',
  to: ArrayLike<number>,
): readonly JointPair[] {
  const kept = pairs.flatMap((pair) => (to[pair[side]] >= 0 ? [{ ...pair, [side]: to[pair[side]] }] : []));
  return kept.sort((a, b) => a.target - b.target);
}

/**
 * Others that a character's take moves follow joints of its skeleton by index. They have its new skeleton and their new
 * pairs in one; a driver that no longer follows it (`edit/drivers.ts`) keeps both as they were.
 *
 * @param characters with the changed one among them
 * @param before its skeleton before
 */
export function withSourcePairs(
  characters: readonly Character[],
  characterId: string,
  before: Skeleton,
  to: ArrayLike<number>,
): readonly Character[] {
  // The same by value: undo rebuilds the skeleton of a character and that in a driver each by itself.
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
