/**
 * Maps DOFs of one skeleton to those of the next: by joint, and within a joint by name. What moves the whole character
 * is root translation in one and the root's own DOFs in another:
 *
 *     root translation tx ty tz   ⇄   tx ty tz of a root that moves by itself (`carriesCharacter`)
 *
 * DOFs with other names but the same effect are matched too (`same-dof.ts`).
 *
 * BVH position channels that replace the offset are positions, not distances from it: their values move with the
 * offset, or are converted.
 */
import { firstDofs, rootDofs } from '../../model/skeleton/dofs.ts';
import { dofsOf, replacesOffset } from '../../model/skeleton/joint-types.ts';
import { isUnlimited, type Joint, type Limit, type Skeleton, UNLIMITED } from '../../model/skeleton/skeleton.ts';
import { sameDof, timesSign } from './same-dof.ts';
import type { Likeness } from './tree.ts';

/** Where a new DOF's values come from. */
export interface DofSource {
  /** Index of the old DOF in the character's list; -1 for a new one. */
  readonly from: number;
  /** Its values are multiplied by `sign`, then `plus` is added. */
  readonly sign: 1 | -1;
  readonly plus: number;
  /** Initial value of a new one. */
  readonly start: number;
  /** An old DOF, with a sign, whose resting value initialises a new one. */
  readonly like?: { readonly dof: number; readonly sign: number };
}

/** A value of an old DOF converted to the new one. */
export function valueAfter({ sign, plus }: Pick<DofSource, 'sign' | 'plus'>, value: number): number {
  return timesSign(value, sign) + plus;
}

/** Without morphs, whose DOFs are kept after the others. */
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
  /** Index of the DOF that moved the whole character along an axis. */
  const travel = (name: string) => (hadRoot ? 'xyz'.indexOf(name[1]) : indexOf(root, name, first[0]));
  const sources: DofSource[] = rootDofs(after).map(({ name }) => {
    return {
      from: travel(name),
      sign: 1,
      plus: hadRoot || !isSameRoot ? 0 : baseOf(root, name) - rootStart(nextRoot, name),
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

/** The part of the offset contained in a DOF's values. */
function offsetWithin({ motion, offset }: Joint, name: string): number {
  const axis = TRAVEL.indexOf(name);
  return axis >= 0 && replacesOffset(motion, name) ? offset[axis] : 0;
}

/** Position of a joint along a DOF's axis when the DOF is 0. */
function baseOf(joint: Joint, name: string): number {
  return joint.offset[TRAVEL.indexOf(name)] - offsetWithin(joint, name);
}

/** Position of a new root along an axis when root translation is 0. */
function rootStart(joint: Joint, name: string): number {
  if (!replacesOffset(joint.motion, name)) return joint.offset[TRAVEL.indexOf(name)];
  return joint.pose[dofsOf(joint.motion).findIndex((dof) => dof.name === name)] ?? 0;
}

function shiftOf(before: Joint, after: Joint, name: string): number {
  return offsetWithin(after, name) - offsetWithin(before, name);
}

/**
 * The joint with limits and a file pose for each of its DOFs: previous ones for DOFs that it had, else none and the
 * rest value. Limits and poses given with the change are kept. The same object if neither its motion nor the reference
 * of its DOFs changed.
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
