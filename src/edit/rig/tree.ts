/**
 * A skeleton as branches that can be moved, removed and added, and its conversion back to a list of joints in
 * depth-first pre-order. Branches are plain and mutable: a command makes them, changes them and lists them again.
 */
import type { Joint, Skeleton } from '../../model/skeleton/skeleton.ts';

/** A joint with its descendants, while a skeleton is being changed. */
export interface Branch {
  /** Index of the old joint; -1 for a new one. */
  readonly origin: number;
  /** `parent` and links still have the old indices. */
  joint: Joint;
  children: Branch[];
  /** The old joint from which a new joint's values are taken; absent: its own pose. */
  readonly like?: Likeness;
}

/** A new joint that imitates an old one, up to signs. */
export interface Likeness {
  readonly joint: number;
  /** One per DOF: factors of the values. */
  readonly signs: readonly number[];
}

/** A tree as a list of joints in depth-first pre-order. */
export interface Listed {
  readonly joints: readonly Joint[];
  /** The branch of each joint. */
  readonly branches: readonly Branch[];
}

/** One per joint, in order; the first is the whole tree. */
export function branchesOf({ joints }: Skeleton): Branch[] {
  const branches = joints.map((joint, origin): Branch => ({ origin, joint, children: [] }));
  joints.forEach(({ parent }, j) => {
    if (parent >= 0) branches[parent].children.push(branches[j]);
  });
  return branches;
}

/** In pre-order, with updated parent indices; unchanged joints keep their identity. */
export function listJoints(root: Branch): Listed {
  const joints: Joint[] = [];
  const branches: Branch[] = [];
  // An explicit stack, since trees may be very deep.
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
