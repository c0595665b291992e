/** Data that refer to joint indices, besides skins: pins and stiff joints, and retargeting. */
import type { Character } from '../../model/document.ts';
import { defaultIk, type IkSetup } from '../../model/ik.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import type { JointPair } from '../../model/takes/retarget.ts';
import { sameValue } from '../delta.ts';
import { driverSource } from '../drivers.ts';

/**
 * IK settings with the new indices of joints.
 * @param to for each old joint its new index; -1 if removed, together with what refers to it
 */
export function remapIk({ pins, stiff, rootIsFree }: IkSetup, to: ArrayLike<number>): IkSetup {
  const moved = <T extends { readonly joint: number }>(all: readonly T[]) =>
    all.flatMap((one) => (to[one.joint] >= 0 ? [{ ...one, joint: to[one.joint] }] : []));
  return { pins: moved(pins), stiff: moved(stiff).sort((a, b) => a.joint - b.joint), rootIsFree };
}

/** The character with these settings; without any if they are its skeleton's defaults. */
export function withIk(character: Character, ik: IkSetup): Character {
  const { pins, stiff, rootIsFree } = ik;
  const isDefault = pins.length + stiff.length === 0 && rootIsFree === defaultIk(character.skeleton).rootIsFree;
  if (!isDefault) return { ...character, ik };
  const { ik: _before, ...rest } = character;
  return rest;
}

/** In the order of the target's joints. */
export function remapPairs(
  pairs: readonly JointPair[],
  side: 'target' | 'source',
  to: ArrayLike<number>,
): readonly JointPair[] {
  const kept = pairs.flatMap((pair) => (to[pair[side]] >= 0 ? [{ ...pair, [side]: to[pair[side]] }] : []));
  return kept.sort((a, b) => a.target - b.target);
}

/**
 * Characters retargeted from this one refer to its joints by index. They get its new skeleton and their new pairs at
 * once; a driver that no longer follows it (`edit/drivers.ts`) keeps both.
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
