/**
 * Posing several joints at once: a change of one joint's DOF is made to the same DOF of the others, by the same amount,
 * about each joint's own axis.
 */
import { coupleOf } from '../../model/skeleton/couples.ts';
import { characterDofs, type DofValue, firstDofs } from '../../model/skeleton/dofs.ts';
import { quaternionDofs } from '../../model/skeleton/joint-types.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';

/**
 * The DOFs of these joints with the name and unit of `dof`, without `dof` itself. Linked DOFs have no value of their
 * own, and quaternion components no meaning on their own: these match none.
 *
 * @param dof index into the character's
 * @returns such indices, in the order of the joints, at most one of each
 */
export function matchingDofs(skeleton: Skeleton, joints: readonly number[], dof: number): readonly number[] {
  const all = characterDofs(skeleton, []);
  const firsts = firstDofs(skeleton);
  const isFree = (index: number) => {
    const { joint } = all[index];
    const own = index - firsts[joint];
    return !coupleOf(skeleton, index) && !quaternionDofs(skeleton.joints[joint].motion).includes(own);
  };
  const like = all[dof];
  if (!like || !isFree(dof)) return [];
  return joints.flatMap((joint) => {
    const index = all.findIndex((d) => d.joint === joint && d.name === like.name && d.unit === like.unit);
    return index < 0 || index === dof || !isFree(index) ? [] : index;
  });
}

/**
 * Values of those DOFs after the change that takes `own` from its value in `from`.
 *
 * @param from the character's DOFs before the change
 */
export function sameChange(from: ArrayLike<number>, own: DofValue, matching: readonly number[]): DofValue[] {
  const by = own.value - from[own.index];
  return matching.map((index) => ({ index, value: from[index] + by }));
}
