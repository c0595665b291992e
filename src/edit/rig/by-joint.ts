/** Data that refer to joint indices, besides skins: pins and stiff joints, and retargeting. */
import type { Character } from '../../model/document.ts';
import { defaultIk, type IkSetup } from '../../model/ik.ts';
import type { JointPair } from '../../model/takes/retarget.ts';

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
