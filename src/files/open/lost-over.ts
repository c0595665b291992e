/**
 * What a character has lost because its skeleton was loaded again (`carried-over.ts`). The page fetches this with the
 * first skeleton that is.
 */

import { sameJoints } from '../../edit/pose/same-joints.ts';
import { type Diagnostic, withoutPlace } from '../../model/diagnostic.ts';
import { type Character, type Document, findCharacter } from '../../model/document.ts';
import type { FileNaming } from '../../model/files.ts';
import { characterDofs } from '../../model/skeleton/dofs.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';

/** Reports what referred to joints or DOFs that no longer exist. @param called how messages name files */
export function lostOver(before: Document, after: Document, called: FileNaming): Diagnostic[] {
  return after.characters.flatMap((character) => {
    const { id, skeleton, parts } = character;
    const was = findCharacter(before, id);
    if (!was || !skeleton || was.skeleton === skeleton) return [];
    const { file } = parts?.skeleton ?? {};
    return lostBy(was, character, file ? called(file.source) : `${skeleton.name}.skel`);
  });
}

function lostBy(before: Character, after: Character, file: string): Diagnostic[] {
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
