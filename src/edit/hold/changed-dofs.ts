/** Which DOFs a hold has changed; only these are keyed. */
import { type CompiledSkeleton, compileSkeleton } from '../../evaluate/kinematics.ts';
import { characterDofs } from '../../model/skeleton/dofs.ts';
import { quaternionDofs } from '../../model/skeleton/joint-types.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import type { HeldFrames } from './frames.ts';

/** Radians, factors and fractions of the reach: smaller changes are invisible and not worth keys. */
const NOTHING = 1e-7;

/**
 * Ascending. Linked DOFs are excluded, since their own values are ignored; the four components of a quaternion are
 * changed together or not at all.
 * @param reach of the character, in its lengths
 */
export function changedDofs(skeleton: Skeleton, frames: HeldFrames, reach: number): number[] {
  const compiled = compileSkeleton(skeleton);
  const dofs = characterDofs(skeleton, []);
  const follows = new Set(compiled.couples.map(({ dof }) => dof));
  const isChanged = dofs.map(({ unit }, dof) => {
    return !follows.has(dof) && largestChange(frames, dof) > NOTHING * (unit === 'length' ? reach : 1);
  });
  keepQuaternionsWhole(skeleton, compiled, isChanged);
  return dofs.flatMap((_, dof) => (isChanged[dof] ? [dof] : []));
}

function largestChange({ own, held, width }: HeldFrames, dof: number): number {
  let largest = 0;
  for (let o = dof; o < own.length; o += width) largest = Math.max(largest, Math.abs(held[o] - own[o]));
  return largest;
}

function keepQuaternionsWhole({ joints }: Skeleton, { firstDof }: CompiledSkeleton, isChanged: boolean[]): void {
  joints.forEach(({ motion }, j) => {
    const parts = quaternionDofs(motion).map((d) => firstDof[j] + d);
    if (parts.some((dof) => isChanged[dof])) for (const dof of parts) isChanged[dof] = true;
  });
}
