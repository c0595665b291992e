/**
 * Maps one skeleton to the next: joints, DOFs, and the adjusted joints themselves. All rigging changes are computed
 * here; skins, takes, poses and everything else indexed by joints or DOFs follow (`remap.ts`).
 *
 *     joints before   0 1 2 3 4          to   0 1 -1 2 3         heirs   0 1 1 2 3
 *     joints after    0 1   2 3   4      origins   0 1 3 4 -1
 */
import { axisAngleObstacle, inHierarchyForm } from '../../model/skeleton/axis-angle.ts';
import { jointDofCount, rootDofCount } from '../../model/skeleton/dofs.ts';
import { dofsOf } from '../../model/skeleton/joint-types.ts';
import type { Couple, Joint, Skeleton } from '../../model/skeleton/skeleton.ts';
import { type DofSource, dofSources, fittedJoint } from './dof-sources.ts';
import { type SameDof, sameDof, timesSign } from './same-dof.ts';
import { type Branch, type Likeness, listJoints } from './tree.ts';

/** How the joints and DOFs of a skeleton become those of the next. */
export interface JointMap {
  readonly before: Skeleton;
  readonly after: Skeleton;
  /** For each new joint its old index; -1 if it was added. */
  readonly origins: Int32Array;
  /** For each old joint its new index; -1 if it was removed. */
  readonly to: Int32Array;
  /** The same, but for a removed joint its nearest remaining ancestor, or else the root. */
  readonly heirs: Int32Array;
  /** Whether all joints keep their indices. */
  readonly keepsJoints: boolean;
  /** For each new DOF (`model/dofs.ts`, without morphs), the source of its values. */
  readonly dofs: readonly DofSource[];
  /** Number of old DOFs, without morphs. */
  readonly dofsBefore: number;
  /** Whether all DOFs are unchanged. */
  readonly keepsDofs: boolean;
  /** For added joints, the joints that they imitate. */
  readonly likes: ReadonlyMap<number, Likeness>;
}

/** The map to joints that have changed, one for each old one. */
export function changedJoints(before: Skeleton, joints: readonly Joint[]): JointMap {
  const branches = joints.map((joint, origin): Branch => ({ origin, joint, children: [] }));
  return mapOf(before, joints, branches);
}

/** The joints of a tree whose branches came from `before`. */
export function changedTree(before: Skeleton, root: Branch): JointMap {
  const { joints, branches } = listJoints(root);
  return mapOf(before, joints, branches);
}

function mapOf(before: Skeleton, joints: readonly Joint[], branches: readonly Branch[]): JointMap {
  const origins = Int32Array.from(branches, ({ origin }) => origin);
  const to = new Int32Array(before.joints.length).fill(-1);
  origins.forEach((origin, j) => {
    if (origin >= 0) to[origin] = j;
  });
  const heirs = to.slice();
  before.joints.forEach(({ parent }, j) => {
    if (heirs[j] < 0) heirs[j] = parent < 0 ? 0 : heirs[parent];
  });
  const fitted = joints.map((joint, j) => (origins[j] < 0 ? joint : fittedJoint(before.joints[origins[j]], joint)));
  const after = inForm({ ...before, joints: withCouples(before, fitted, origins, to) });
  const likes = new Map(branches.flatMap(({ like }, j) => (like ? [[j, like] as const] : [])));
  const dofs = dofSources(before, after, origins, likes);
  const dofsBefore = rootDofCount(before) + jointDofCount(before);
  return {
    before,
    after,
    origins,
    to,
    heirs,
    keepsJoints: origins.length === to.length && origins.every((origin, j) => origin === j),
    dofs,
    dofsBefore,
    keepsDofs:
      dofs.length === dofsBefore && dofs.every(({ from, sign, plus }, d) => from === d && sign > 0 && plus === 0),
    likes,
  };
}

/** Leaves the axis-angle form if the skeleton no longer fits it. */
function inForm(skeleton: Skeleton): Skeleton {
  return skeleton.form && axisAngleObstacle(skeleton) ? inHierarchyForm(skeleton) : skeleton;
}

/** Links with the joints' new indices. Links from or to a removed DOF are dropped. */
function withCouples(
  before: Skeleton,
  joints: readonly Joint[],
  origins: Int32Array,
  to: Int32Array,
): readonly Joint[] {
  return joints.map((joint, j) => {
    const { couples } = joint;
    if (!couples) return joint;
    const { motion } = before.joints[origins[j]] ?? joint;
    const kept = couples.flatMap((couple): Couple[] => {
      const target = to[couple.joint];
      if (target < 0) return [];
      const own = sameDof(joint.motion, motion, couple.dof);
      const followed = sameDof(joints[target].motion, before.joints[couple.joint].motion, couple.follows);
      return own && followed ? [movedCouple(couple, own, target, followed)] : [];
    });
    if (kept.length === couples.length && kept.every((couple, i) => couple === couples[i])) {
      if (origins[j] >= 0 && motion === joint.motion) return joint;
    }
    const { couples: _before, ...rest } = joint;
    const inOrder = dofsOf(joint.motion).flatMap(({ name }) => kept.find(({ dof }) => dof === name) ?? []);
    return inOrder.length ? { ...rest, couples: inOrder } : rest;
  });
}

/** φ = g·ψ + o, with φ = s·φ′ and ψ = t·ψ′: φ′ = (s·t·g)·ψ′ + s·o. The same object if nothing changes. */
function movedCouple(couple: Couple, own: SameDof, joint: number, followed: SameDof): Couple {
  const isSame = own.name === couple.dof && followed.name === couple.follows;
  if (isSame) return joint === couple.joint ? couple : { ...couple, joint };
  const gain = timesSign(timesSign(couple.gain, own.sign), followed.sign);
  return { dof: own.name, joint, follows: followed.name, gain, offset: timesSign(couple.offset, own.sign) };
}
