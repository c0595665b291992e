/**
 * DOFs of one skeleton as DOFs of the next: by joint, and within a joint by name. What carries the whole character is
 * the root translation in one and the root's own DOFs in another:
 *
 *     root translation tx ty tz   ⇄   tx ty tz of a root that moves by itself (`carriesCharacter`)
 *
 * What is called otherwise and does the same is the same too (`same-dof.ts`).
 *
 * Position channels of BVH that replace the offset say where a joint is, not how far from its offset: their values move
 * by what the offset does, or come to be counted from it.
 */
import { firstDofs, rootDofs } from '../../model/dofs.ts';
import { dofsOf, replacesOffset } from '../../model/joint-types.ts';
import { isUnlimited, type Joint, type Limit, type Skeleton, UNLIMITED } from '../../model/skeleton.ts';
import { sameDof, timesSign } from './same-dof.ts';
import type { Likeness } from './tree.ts';

export interface DofSource {
  /** Index of the DOF before, in the character's list; -1 for a new one. */
  readonly from: number;
  /** What its values are multiplied by; and then what is added to them. */
  readonly sign: 1 | -1;
  readonly plus: number;
  /** Where a new one begins. */
  readonly start: number;
  /** A DOF of before, times a sign, that a new one begins at where that stands still. */
  readonly like?: { readonly dof: number; readonly sign: number };
}

/** A value of a DOF before as one of the DOF after. */
export function valueAfter({ sign, plus }: Pick<DofSource, 'sign' | 'plus'>, value: number): number {
  return timesSign(value, sign) + plus;
}

/** Without morphs: their DOFs stay as they are, behind the others. */
export function dofSources(
  before: Skeleton,
  after: Skeleton,
  origins: Int32Array,
  likes: ReadonlyMap<number, Likeness>,
): readonly DofSource[] {
  const first = firstDofs(before);
  const root = before.joints[0];
  const nextRoot = after.joints[0];
  const isSameRoot = origins[0] === 0;
  const hadRoot = rootDofs(before).length > 0;
  const hasRoot = rootDofs(after).length > 0;
  /** Index of what moved the whole character along an axis. */
  const travel = (name: string) => (hadRoot ? 'xyz'.indexOf(name[1]) : indexOf(root, name, first[0]));
  const sources: DofSource[] = rootDofs(after).map(({ name }) => {
    return {
      from: travel(name),
      sign: 1,
      plus: hadRoot || !isSameRoot ? 0 : baseOf(root, name) - standOf(nextRoot, name),
      start: 0,
    };
  });
  after.joints.forEach((joint, j) => {
    const was = before.joints[origins[j]];
    const like = likes.get(j);
    dofsOf(joint.motion).forEach(({ name }, d) => {
      const start = joint.pose[d] ?? 0;
      if (!was) {
        const known = like && { dof: first[like.joint] + d, sign: like.signs[d] };
        sources.push({ from: -1, sign: 1, plus: 0, start, ...(known && { like: known }) });
        return;
      }
      const same = sameDof(was.motion, joint.motion, name);
      let from = same ? indexOf(was, same.name, first[origins[j]]) : -1;
      if (j === 0 && isSameRoot && hadRoot !== hasRoot && TRAVEL.includes(name)) from = hasRoot ? -1 : travel(name);
      const plus = from < 0 ? 0 : shiftOf(was, joint, name);
      sources.push({ from, sign: same?.sign ?? 1, plus, start });
    });
  });
  return sources;
}

const TRAVEL: readonly string[] = ['tx', 'ty', 'tz'];

function indexOf({ motion }: Joint, name: string, first: number): number {
  const own = dofsOf(motion).findIndex((dof) => dof.name === name);
  return own < 0 ? -1 : first + own;
}

/** Of the offset, what a DOF's values have in them. */
function offsetWithin({ motion, offset }: Joint, name: string): number {
  const axis = TRAVEL.indexOf(name);
  return axis >= 0 && replacesOffset(motion, name) ? offset[axis] : 0;
}

/** Where a joint is on the axis of a DOF while that is 0. */
function baseOf(joint: Joint, name: string): number {
  return joint.offset[TRAVEL.indexOf(name)] - offsetWithin(joint, name);
}

/** Where a new root is on an axis while the root translation is 0. */
function standOf(joint: Joint, name: string): number {
  if (!replacesOffset(joint.motion, name)) return joint.offset[TRAVEL.indexOf(name)];
  return joint.pose[dofsOf(joint.motion).findIndex((dof) => dof.name === name)] ?? 0;
}

function shiftOf(before: Joint, after: Joint, name: string): number {
  return offsetWithin(after, name) - offsetWithin(before, name);
}

/**
 * The joint with limits and a file pose for each of its DOFs: those of before where it had that DOF, else none and the
 * rest. Limits and poses that were given with the change stay. The same object where neither its motion nor what
 * its DOFs are counted from is another.
 */
export function fittedJoint(before: Joint, joint: Joint): Joint {
  const dofs = dofsOf(joint.motion);
  const names = dofsOf(before.motion).map(({ name }) => name);
  const isMoved = dofs.some(({ name }) => shiftOf(before, joint, name) !== 0);
  if (before.motion === joint.motion && !isMoved) return joint;
  const same = dofs.map(({ name }) => sameDof(before.motion, joint.motion, name));
  const at = same.map((one) => (one ? names.indexOf(one.name) : -1));
  const sign = (d: number) => same[d]?.sign ?? 1;
  const shift = (d: number) => (at[d] < 0 ? 0 : shiftOf(before, joint, dofs[d].name));
  const limits = at.map((own, d) => movedLimit(before.limits[own] ?? UNLIMITED, sign(d), shift(d)));
  const pose = at.map((own, d) => {
    if (own >= 0) return timesSign(before.pose[own] ?? dofs[d].rest, sign(d)) + shift(d);
    return dofs[d].rest + offsetWithin(joint, dofs[d].name);
  });
  return {
    ...joint,
    ...(joint.limits === before.limits && { limits }),
    ...(joint.pose === before.pose && { pose }),
  };
}

function movedLimit(limit: Limit, sign: 1 | -1, by: number): Limit {
  const { min, max } = sign < 0 ? { min: 0 - limit.max, max: 0 - limit.min } : limit;
  if (isUnlimited(limit) || (by === 0 && sign > 0)) return limit;
  return { min: min + by, max: max + by };
}
