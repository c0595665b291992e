/** Which DOFs of a skeleton a take's samples drive, grouped by how they are interpolated between frames. */

import { perPair } from '../../model/per-object.ts';
import { firstDofs } from '../../model/skeleton/dofs.ts';
import { quaternionDofs } from '../../model/skeleton/joint-types.ts';
import { perSkeleton } from '../../model/skeleton/per-skeleton.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import type { CompiledTake } from '../compiled-take.ts';
import { appliedDofs, renamedAxes, turnedDofs, turningDofs } from '../rotations/euler-dofs.ts';

/** DOFs in the character's order, and beside each list the columns that drive them. */
export interface SampledJoints {
  /** Lengths, weights and others that are interpolated linearly. */
  readonly plainDofs: Int32Array;
  readonly plainColumns: Int32Array;
  /** Independent angles. */
  readonly angleDofs: Int32Array;
  readonly angleColumns: Int32Array;
  /** One per rotation by three Euler angles: its joint. */
  readonly eulerJoints: Int32Array;
  /** Three per rotation, in order of application. */
  readonly eulerDofs: Int32Array;
  readonly eulerColumns: Int32Array;
  /**
   * One per rotation: the sign that turns its angles into α β γ of Rz(γ)·Ry(β)·Rx(α) with renamed axes. Slerp and the
   * conversion back to angles are the same in any axes, so nothing else is renamed.
   */
  readonly eulerSigns: Float64Array;
  /** Three per rotation: which of x, y, z (0, 1, 2) α, β and γ turn about. */
  readonly eulerAxes: Int32Array;
  /** Three per rotation: factors from the numbers in the columns to half of α, β or γ. */
  readonly eulerHalves: Float64Array;
  /** Four per rotation: x y z w. */
  readonly quaternionDofs: Int32Array;
  readonly quaternionColumns: Int32Array;
}

/** The input that the joints of a take depend on, and the result. */
interface Sorted {
  readonly columns: Int32Array;
  readonly scales: Float64Array | undefined;
  readonly joints: SampledJoints;
}

/** The latest one of each skeleton: takes of one session have the same columns, and share it. */
const latest = perSkeleton((): { sorted?: Sorted } => ({}));

/** Cached per take and skeleton. */
export const sampledJoints = perPair((take: CompiledTake, skeleton: Skeleton): SampledJoints => {
  const { columns, samples } = take;
  const kept = latest(skeleton);
  const { sorted } = kept;
  if (sorted && isSame(sorted.columns, columns) && isSame(sorted.scales, samples?.scales)) return sorted.joints;
  const joints = sort(take, skeleton);
  kept.sorted = { columns, scales: samples?.scales, joints };
  return joints;
});

function isSame(a: ArrayLike<number> | undefined, b: ArrayLike<number> | undefined): boolean {
  if (a === b) return true;
  if (a?.length !== b?.length || !a || !b) return false;
  for (let i = 0; i < a.length; i++) if (a[i] !== b[i]) return false;
  return true;
}

/** If only some of a joint's angles are sampled, they are not a rotation: each is interpolated alone. */
function sort({ columns, samples }: CompiledTake, skeleton: Skeleton): SampledJoints {
  const first = firstDofs(skeleton);
  const eulers: number[] = [];
  const joints: number[] = [];
  const signs: number[] = [];
  const axes: number[] = [];
  const quaternions: number[] = [];
  const angles: number[] = [];
  const done = new Set<number>();
  const take = (dofs: readonly number[], list: number[]) => {
    // Past the channels this is undefined, which fails the comparison.
    if (dofs.length === 0 || !dofs.every((dof) => columns[dof] >= 0)) return false;
    list.push(...dofs);
    for (const dof of dofs) done.add(dof);
    return true;
  };
  skeleton.joints.forEach(({ motion }, j) => {
    const euler = turnedDofs(motion);
    if (euler) {
      const applied = appliedDofs(euler).map((dof) => first[j] + dof);
      const renamed = renamedAxes(euler.order);
      if (take(applied, eulers)) {
        joints.push(j);
        signs.push(renamed.sign);
        axes.push(...renamed.axes);
      }
    }
    take(
      quaternionDofs(motion).map((d) => first[j] + d),
      quaternions,
    );
    turningDofs(motion).forEach((turns, i) => {
      if (turns && !done.has(first[j] + i)) take([first[j] + i], angles);
    });
  });
  const plain: number[] = [];
  columns.forEach((column, dof) => {
    if (column >= 0 && !done.has(dof)) plain.push(dof);
  });
  const columnsOf = (dofs: readonly number[]) => Int32Array.from(dofs, (dof) => columns[dof]);
  return {
    plainDofs: Int32Array.from(plain),
    plainColumns: columnsOf(plain),
    angleDofs: Int32Array.from(angles),
    angleColumns: columnsOf(angles),
    eulerJoints: Int32Array.from(joints),
    eulerDofs: Int32Array.from(eulers),
    eulerColumns: columnsOf(eulers),
    eulerSigns: Float64Array.from(signs),
    eulerAxes: Int32Array.from(axes),
    eulerHalves: Float64Array.from(
      eulers,
      (dof, i) => (signs[Math.floor(i / 3)] * (samples?.scales[columns[dof]] ?? 0)) / 2,
    ),
    quaternionDofs: Int32Array.from(quaternions),
    quaternionColumns: columnsOf(quaternions),
  };
}
