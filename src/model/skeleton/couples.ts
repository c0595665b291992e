/**
 * Linked DOFs as pairs of indices into a character's DOFs (`dofs.ts`), resolved from the names in joints and sorted so
 * that each comes after the DOF it follows.
 */
import { firstDofs } from './dofs.ts';
import { dofsOf } from './joint-types.ts';
import { perSkeleton } from './per-skeleton.ts';
import type { Skeleton } from './skeleton.ts';

/** DOF `dof` = gain · (DOF `follows`) + offset. */
export interface DofCouple {
  readonly dof: number;
  readonly follows: number;
  readonly gain: number;
  readonly offset: number;
}

/** The linked DOFs of a character, ready to evaluate in order. */
export interface Couples {
  /** Sorted: each after the one it follows. */
  readonly ordered: readonly DofCouple[];
  /** DOFs that follow themselves, directly or through others, or that follow such a DOF; they can't be evaluated. */
  readonly circular: readonly DofCouple[];
}

const NONE: Couples = { ordered: [], circular: [] };

/**
 * A skeleton's linked DOFs, computed once per skeleton. Links to DOFs that a joint does not have are skipped; readers
 * reject them.
 */
export const couplesOf = perSkeleton(resolve);

/** The link that drives a DOF; undefined for an independent DOF. */
export function coupleOf(skeleton: Skeleton | undefined, dof: number): DofCouple | undefined {
  return skeleton && couplesOf(skeleton).ordered.find((couple) => couple.dof === dof);
}

function resolve(skeleton: Skeleton): Couples {
  const { joints } = skeleton;
  if (!joints.some(({ couples }) => couples)) return NONE;
  const first = firstDofs(skeleton);
  const indexOf = (joint: number, name: string) => {
    const own = joints[joint] ? dofsOf(joints[joint].motion).findIndex((dof) => dof.name === name) : -1;
    return own < 0 ? -1 : first[joint] + own;
  };
  const byDof = new Map<number, DofCouple>();
  joints.forEach(({ couples = [] }, joint) => {
    for (const { dof: name, joint: other, follows: followed, gain, offset } of couples) {
      const dof = indexOf(joint, name);
      const follows = indexOf(other, followed);
      if (dof >= 0 && follows >= 0) byDof.set(dof, { dof, follows, gain, offset });
    }
  });
  return inOrder(byDof);
}

/** Each DOF follows at most one other, so every chain leads either to an ordered DOF or into a cycle. */
function inOrder(byDof: ReadonlyMap<number, DofCouple>): Couples {
  const ordered: DofCouple[] = [];
  const circular: DofCouple[] = [];
  const settled = new Map<number, boolean>();
  for (const couple of byDof.values()) {
    const way: DofCouple[] = [];
    const onWay = new Set<number>();
    let above: DofCouple | undefined = couple;
    while (above && !settled.has(above.dof) && !onWay.has(above.dof)) {
      way.push(above);
      onWay.add(above.dof);
      above = byDof.get(above.follows);
    }
    const isSound = above === undefined || settled.get(above.dof) === true;
    for (const one of way.reverse()) {
      settled.set(one.dof, isSound);
      (isSound ? ordered : circular).push(one);
    }
  }
  return { ordered, circular };
}
