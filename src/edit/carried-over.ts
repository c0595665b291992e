/**
 * Parts that a character keeps when its skeleton is loaded again from a file: its pose library, IK settings, sets,
 * locks, limbs and retargeting. All of these refer to joints, which may have changed.
 */
import type { Character } from '../model/document.ts';
import { remapLimbs } from '../model/limbs.ts';
import { remapSets } from '../model/sets.ts';
import { movedPoses } from './pose/library.ts';
import { sameJoints } from './pose/same-joints.ts';
import { remapIk, remapPairs, withIk } from './rig/by-joint.ts';

/**
 * Carries pose library, IK settings, sets, locks and retargeting over to a character's new skeleton.
 * @param after the character with its new skeleton, and everything else as before
 */
export function carriedOver(before: Character, after: Character): Character {
  const { poses, ik, driver, sets, limbs } = before;
  if (!(poses ?? ik ?? driver ?? sets ?? limbs)) return after;
  const to = before.skeleton && after.skeleton ? sameJoints(before.skeleton, after.skeleton) : [];
  const next = {
    ...after,
    ...(poses && { poses: movedPoses(before, after, poses, to) }),
    ...(sets && { sets: remapSets(sets, to) }),
    ...(limbs && { limbs: remapLimbs(limbs, to) }),
    ...(driver && { driver: { ...driver, pairs: remapPairs(driver.pairs, 'target', to) } }),
  };
  return ik ? withIk(next, remapIk(ik, to)) : next;
}
