/**
 * Parts that a character keeps when its skeleton is loaded again from a file: its pose library, IK settings, sets, locks,
 * limbs and retargeting. All of these refer to joints, which may have changed.
 */
import { type Diagnostic, withoutPlace } from '../model/diagnostic.ts';
import type { Character } from '../model/document.ts';
import { remapLimbs } from '../model/limbs.ts';
import { remapSets } from '../model/sets.ts';
import { characterDofs } from '../model/skeleton/dofs.ts';
import type { Skeleton } from '../model/skeleton/skeleton.ts';
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

/** Reports what referred to joints or DOFs that no longer exist. */
export function lostOver(before: Character, after: Character, file: string): Diagnostic[] {
  const { skeleton, ik, sets, limbs } = before;
  if (!skeleton || !after.skeleton) return [];
  const { joints } = skeleton;
  const to = sameJoints(skeleton, after.skeleton);
  const problems: Diagnostic[] = [];
  const say = (code: string, message: string) => problems.push(withoutPlace('info', code, message, file));
  const called = (list: readonly number[]) => {
    const names = [...new Set(list)].map((joint) =>
      joints[joint].name ? `"${joints[joint].name}"` : `joint ${joint}`,
    );
    return names.length > 1 ? `${names[0]} and ${names.length - 1} more` : names[0];
  };
  const unposed = unmatchedPosedJoints(before, after.skeleton, to);
  if (unposed.length)
    say('kept-pose-lost', `${called(unposed)} no longer exists and was removed from the pose library.`);
  const gone = ({ joint }: { readonly joint: number }) => to[joint] < 0;
  const held = [...(ik?.pins ?? []), ...(ik?.stiff ?? [])].filter(gone).map(({ joint }) => joint);
  if (held.length) say('ik-lost', `Pins, locks and stiffness of ${called(held)} were removed with the joint.`);
  const inSets = [
    ...(sets?.sets.flatMap((set) => set.joints) ?? []),
    ...(sets?.locked.map(({ joint }) => joint) ?? []),
    ...(limbs?.list.flatMap((limb) => limb.joints) ?? []),
  ];
  const lost = inSets.filter((joint) => to[joint] < 0);
  if (lost.length) say('sets-lost', `${called(lost)} no longer exists and was removed from sets, locks and limbs.`);
  return problems;
}

/** Joints in the pose library that have lost their place. */
function unmatchedPosedJoints(
  { skeleton, morphs, poses = [] }: Character,
  after: Skeleton,
  to: Int32Array,
): readonly number[] {
  if (poses.length === 0) return [];
  const key = (joint: number, name: string) => `${joint} ${name}`;
  const there = new Set(characterDofs(after, []).map(({ joint, name }) => key(joint, name)));
  const lost = new Set<number>();
  characterDofs(skeleton, morphs).forEach(({ joint, name, rest }, dof) => {
    if (joint < 0 || there.has(key(to[joint], name))) return;
    if (poses.some(({ values }) => (values[dof] ?? rest) !== rest)) lost.add(joint);
  });
  return [...lost].sort((a, b) => a - b);
}
