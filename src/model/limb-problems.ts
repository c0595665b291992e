/** Which joints can be a limb, and what is wrong with those that can't. */
import type { Limb, LimbByName, Limbs } from './limbs.ts';
import { couplesOf } from './skeleton/couples.ts';
import { firstDofs } from './skeleton/dofs.ts';
import { jointReferred } from './skeleton/joint-reference.ts';
import { dofsOf } from './skeleton/joint-types.ts';
import type { Joint, Skeleton } from './skeleton/skeleton.ts';

/** Something that is wrong with a limb of a file, which is then left out. */
export interface LimbProblem {
  readonly code: 'limb-joint-unknown' | 'limb-not-a-chain' | 'limb-bend' | 'limb-shared';
  readonly message: string;
}

/** Limbs of a file for a skeleton, and what is wrong with those that are left out. */
export function limbsOfJoints(
  byName: readonly LimbByName[],
  skeleton: Skeleton,
): { readonly limbs: readonly Limb[]; readonly problems: readonly LimbProblem[] } {
  const indexOf = jointReferred(skeleton.joints);
  const limbs: Limb[] = [];
  const problems: LimbProblem[] = [];
  byName.forEach((row, i) => {
    const path = `limbs[${i}]`;
    const found = row.joints.map(indexOf);
    const missing = found.indexOf(undefined);
    if (missing >= 0) {
      const message = `${path}.joints[${missing}]: ${skeleton.name || 'the skeleton'} has no joint "${row.joints[missing]}".`;
      problems.push({ code: 'limb-joint-unknown', message });
      return;
    }
    const limb = { ...row, joints: found.flatMap((joint) => joint ?? []) };
    const problem = limbProblem(limb, skeleton, limbs);
    if (problem) problems.push({ ...problem, message: `${path}: ${problem.message}` });
    else limbs.push(limb);
  });
  return { limbs, problems };
}

/**
 * Why joints can't be a limb; a sentence.
 * @param others the limbs that there are already
 */
export function limbProblem(limb: Limb, skeleton: Skeleton, others: readonly Limb[]): LimbProblem | undefined {
  const { name, joints, bend } = limb;
  const all = skeleton.joints;
  const called = (joint: number) => all[joint]?.name || `#${joint}`;
  const broken = joints.findIndex((joint, k) => k > 0 && all[joint].parent !== joints[k - 1]);
  if (joints.length < 2) return { code: 'limb-not-a-chain', message: `${name} has fewer than two joints.` };
  if (broken > 0) {
    const message = `${called(joints[broken])} of ${name} should be attached to ${called(joints[broken - 1])}.`;
    return { code: 'limb-not-a-chain', message };
  }
  const shared = joints.find((joint) => others.some((other) => other.joints.includes(joint)));
  if (shared !== undefined) {
    const owner = others.find((other) => other.joints.includes(shared));
    return { code: 'limb-shared', message: `${called(shared)} of ${name} already belongs to ${owner?.name}.` };
  }
  const middle: Joint | undefined = joints.length === 3 ? all[joints[1]] : undefined;
  if (middle) {
    const turns = dofsOf(middle.motion).filter(({ unit }) => unit === 'angle');
    if (!turns.some((dof) => dof.name === bend?.dof)) {
      const has = turns.length > 0 ? `it has ${turns.map((dof) => dof.name).join(', ')}` : 'it has none';
      const message = `${name} bends by a rotation DOF of ${called(joints[1])}: ${has}, not ${bend?.dof ?? 'one'}.`;
      return { code: 'limb-bend', message };
    }
  }
  const linked = joints.find((joint) => isLinked(joint, skeleton));
  if (linked === undefined) return undefined;
  return { code: 'limb-bend', message: `${called(linked)} of ${name} has a linked DOF, which no goal can move.` };
}

function isLinked(joint: number, skeleton: Skeleton): boolean {
  const first = firstDofs(skeleton);
  const count = dofsOf(skeleton.joints[joint].motion).length;
  return couplesOf(skeleton).ordered.some(({ dof }) => dof >= first[joint] && dof < first[joint] + count);
}

/** The limbs that are still chains of the skeleton; the same object if all are. */
export function soundLimbs(limbs: Limbs, skeleton: Skeleton): Limbs {
  const sound: Limb[] = [];
  for (const limb of limbs.list) if (!limbProblem(limb, skeleton, sound)) sound.push(limb);
  return sound.length === limbs.list.length ? limbs : { ...limbs, list: sound };
}
