/**
 * A skeleton as branches that can be cut off, hung up elsewhere and grown, and the way back to a list of joints in
 * depth-first pre-order. Branches are plain and mutable: a command makes them, changes them and lists them again.
 */
import type { Joint, Skeleton } from '../../model/skeleton.ts';

export interface Branch {
  /** Index of the joint that it was; -1 for a new one. */
  readonly origin: number;
  /** `parent` and the joints that couples name are as they were. */
  joint: Joint;
  children: Branch[];
  /** The DOFs of a joint of before that a new joint's values are taken from; absent: its own pose. */
  readonly like?: Likeness;
}

/** A new joint that does as one of before, but for signs. */
export interface Likeness {
  readonly joint: number;
  /** One for each of its DOFs: what values are multiplied by. */
  readonly signs: readonly number[];
}

export interface Listed {
  readonly joints: readonly Joint[];
  /** The branch of each joint. */
  readonly branches: readonly Branch[];
}

/** One for each joint, in their order; the first is the whole tree. */
export function branchesOf({ joints }: Skeleton): Branch[] {
  const branches = joints.map((joint, origin): Branch => ({ origin, joint, children: [] }));
  joints.forEach(({ parent }, j) => {
    if (parent >= 0) branches[parent].children.push(branches[j]);
  });
  return branches;
}

/** In pre-order, each with its parent's index; joints for which that is the same are the same objects. */
export function listJoints(root: Branch): Listed {
  const joints: Joint[] = [];
  const branches: Branch[] = [];
  // A stack of our own: trees are as deep as their files like.
  const open: { readonly branch: Branch; readonly parent: number }[] = [{ branch: root, parent: -1 }];
  for (let next = open.pop(); next; next = open.pop()) {
    const { branch, parent } = next;
    const index = joints.length;
    joints.push(branch.joint.parent === parent ? branch.joint : { ...branch.joint, parent });
    branches.push(branch);
    for (let c = branch.children.length - 1; c >= 0; c--) open.push({ branch: branch.children[c], parent: index });
  }
  return { joints, branches };
}
