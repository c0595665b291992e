/**
 * DOFs that follow others, as pairs of indices into a character's DOFs (`dofs.ts`): what joints say by names, worked
 * out, and put in an order in which each follows what is settled already.
 */
import { firstDofs } from './dofs.ts';
import { dofsOf } from './joint-types.ts';
import { perObject } from './per-object.ts';
import type { Skeleton } from './skeleton.ts';

/** DOF `dof` is gain · φ + offset of DOF `follows`. */
export interface DofCouple {
  readonly dof: number;
  readonly follows: number;
  readonly gain: number;
  readonly offset: number;
}

export interface Couples {
  /** Each after the one that it follows. */
  readonly ordered: readonly DofCouple[];
  /** Those that follow themselves, directly or by way of others, or follow such: they can't be settled. */
  readonly circular: readonly DofCouple[];
}

const NONE: Couples = { ordered: [], circular: [] };

/**
 * A skeleton's couples, worked out once for each skeleton. What names a DOF that its joint has not is left out; a reader
 * lets none through.
 */
export const couplesOf = perObject(resolve);

/** What a DOF follows; none where it is its own. */
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

/** A DOF follows one other at most, so from each couple there is one way up, to one settled already or round and round. */
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
