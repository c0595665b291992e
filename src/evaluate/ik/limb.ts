/**
 * The reach of IK: which joints bend when a joint is dragged. Found from the bones alone, so that it holds for insects,
 * robots and captures, whatever their joints are called.
 *
 *     hand → forearm, upper arm, clavicle     finger → finger     foot → shin, thigh     hips → the whole body
 */
import { tipOf } from '../../model/skeleton/bone-ends.ts';
import { dofsOf, turnsJoint } from '../../model/skeleton/joint-types.ts';
import { perSkeleton } from '../../model/skeleton/per-skeleton.ts';
import type { Joint, Skeleton } from '../../model/skeleton/skeleton.ts';
import { compileSkeleton } from '../kinematics.ts';

/** Indices of the joints that bend, ascending; or all of them, with root translation. */
export type Bending = readonly number[] | 'body';

/** Joints that bend with a dragged one: its limb, all, or those between it and a chosen joint. */
export type IkReach = 'limb' | 'body' | { readonly top: number };

/** Of a limb's length: a forearm with its hand is longer than the upper arm, and its elbow can be moved all the same. */
const MUCH_LONGER = 2;

/** A chain that doesn't pass its top is the limb. */
export function bendingOf(skeleton: Skeleton, joint: number, reach: IkReach): Bending {
  if (reach === 'body') return 'body';
  if (reach === 'limb') return limbOf(skeleton, joint);
  const way = wayUp(skeleton, joint);
  const end = way.indexOf(reach.top);
  return end < 0 ? limbOf(skeleton, joint) : way.slice(0, end + 1).reverse();
}

/**
 * The limb that a joint ends: from it upwards to where the body branches. A joint that carries limbs, as hips do under
 * a root, is the body.
 */
export function limbOf(skeleton: Skeleton, joint: number): Bending {
  if (joint <= 0) return 'body';
  const { joints } = skeleton;
  const { children, size, far } = branchesOf(skeleton);
  let way = ownLength(joints[joint]);
  let turns = canTurn(joints[joint]);
  const limb = [joint];
  for (let below = joint, above = joints[joint].parent; above >= 0; below = above, above = joints[above].parent) {
    way += boneTo(joints[below]);
    const branches = children[above].some((child) => {
      if (child === below) return false;
      return size[child] >= 2 || (way > 0 && boneTo(joints[child]) + far[child] >= way / 2);
    });
    if (branches && turns) return limb;
    turns ||= canTurn(joints[above]);
    limb.unshift(above);
  }
  return carriesLimbs(skeleton, joint) ? 'body' : limb;
}

/**
 * Whether a joint with all on it is much longer than the limb that moves its pivot, as a head is than its neck. Then
 * the pivot can hardly be moved, and the joint turns wildly when one tries. Not for joints that bend alone.
 */
export function isLongerThanLimb(skeleton: Skeleton, joint: number): boolean {
  const limb = limbOf(skeleton, joint);
  if (limb === 'body' || limb.length < 2) return false;
  const way = limb.slice(1).reduce((sum, j) => sum + boneTo(skeleton.joints[j]), 0);
  return branchesOf(skeleton).far[joint] >= MUCH_LONGER * way;
}

/** All that bends for several joints. */
export function union(of: readonly Bending[]): Bending {
  const joints = new Set<number>();
  for (const one of of) {
    if (one === 'body') return 'body';
    for (const joint of one) joints.add(joint);
  }
  return [...joints].sort((a, b) => a - b);
}

/** Whether a DOF is in reach. The root translates only with the whole body. */
export function bendsWith(skeleton: Skeleton, bending: Bending): (dof: number) => boolean {
  if (bending === 'body') return () => true;
  const { firstDof, travel } = compileSkeleton(skeleton);
  const free = new Set<number>();
  for (const joint of bending) for (let dof = firstDof[joint]; dof < firstDof[joint + 1]; dof++) free.add(dof);
  for (const dof of travel) free.delete(dof);
  return (dof) => free.has(dof);
}

/** Whether two or more branches of two joints or more begin below a joint where others do. */
function carriesLimbs(skeleton: Skeleton, joint: number): boolean {
  const { children, size } = branchesOf(skeleton);
  let count = 0;
  for (let j = joint; j < joint + size[joint]; j++) {
    if (children[j].length > 1) count += children[j].filter((child) => size[child] >= 2).length;
  }
  return count >= 2;
}

/** The joint, its parent, and so on to the root. */
function wayUp({ joints }: Skeleton, joint: number): number[] {
  const way: number[] = [];
  for (let j = joint; j >= 0; j = joints[j].parent) way.push(j);
  return way;
}

interface Branches {
  readonly children: readonly (readonly number[])[];
  /** How many joints a joint and all below it are. */
  readonly size: Int32Array;
  /** Along the bones from a joint's pivot to the farthest tip. */
  readonly far: Float64Array;
}

const branchesOf = perSkeleton(({ joints }): Branches => {
  const children: number[][] = joints.map(() => []);
  const size = new Int32Array(joints.length).fill(1);
  const far = Float64Array.from(joints, ownLength);
  for (let j = joints.length - 1; j >= 0; j--) {
    const { parent } = joints[j];
    if (parent < 0) continue;
    children[parent].unshift(j);
    size[parent] += size[j];
    far[parent] = Math.max(far[parent], boneTo(joints[j]) + far[j]);
  }
  return { children, size, far };
});

function boneTo({ offset }: Joint): number {
  return Math.hypot(...offset);
}

/** From the pivot to the joint's own tip; 0 without one. */
function ownLength(joint: Joint): number {
  const tip = tipOf(joint);
  return Math.max(0, ...[...(joint.endSites ?? []), ...(tip ? [tip] : [])].map((end) => Math.hypot(...end)));
}

function canTurn({ motion }: Joint): boolean {
  return dofsOf(motion).some(turnsJoint);
}
