/**
 * The variables: DOFs of the joints on the paths from the pins to the root, except locked ones. A linked DOF is not a
 * variable; its effect is added to the DOF it follows, whichever joint that belongs to.
 *
 * Variables are scaled so that equal changes cost the same: radians, fractions of the reach, factors, each divided by
 * the square root of its stiffness. Damping then restrains each in proportion.
 */
import { jointDofCount } from '../../model/skeleton/dofs.ts';
import { dofsOf } from '../../model/skeleton/joint-types.ts';
import { isUnlimited, type Skeleton } from '../../model/skeleton/skeleton.ts';
import type { CompiledSkeleton } from '../kinematics.ts';

/** The DOFs that may move, as columns of scaled variables. */
export interface IkVariables {
  readonly count: number;
  /** The character's DOF of each. */
  readonly dof: Int32Array;
  /** Change of the DOF per unit of the variable. */
  readonly scale: Float64Array;
  /** The same in radians, reaches or factors. */
  readonly relative: Float64Array;
  readonly lower: Float64Array;
  readonly upper: Float64Array;
  /** Whether any has a limit, and one that an animation could reach. */
  readonly hasLimits: boolean;
  readonly isLimited: boolean;
  /** By DOF of the character: the variable that moves it, or -1. */
  readonly ofDof: Int32Array;
  readonly followers: Followers;
}

/** Linked DOFs involved here, each after the one it follows. */
export interface Followers {
  readonly count: number;
  readonly dof: Int32Array;
  readonly follows: Int32Array;
  readonly gain: Float64Array;
  readonly offset: Float64Array;
  readonly lower: Float64Array;
  readonly upper: Float64Array;
  /** The follower that it follows in turn, or -1. */
  readonly leader: Int32Array;
  /** Change of each per unit of its variable's DOF, for the pose last settled; 0 at its own limit. */
  readonly slope: Float64Array;
  /** By DOF of the character: its index among the followers, or -1. */
  readonly ofDof: Int32Array;
}

/**
 * The DOFs that may move, as scaled variables.
 * @param onPath whether a joint is on a path from a pin to the root
 * @param stiffness by DOF of the character; Infinity for locked ones
 */
export function ikVariables(
  skeleton: Skeleton,
  compiled: CompiledSkeleton,
  onPath: readonly boolean[],
  stiffness: ArrayLike<number>,
  reach: number,
  clamps: boolean,
): IkVariables {
  const { firstDof, lower, upper } = compiled;
  const first = firstDof[0];
  const all = first + jointDofCount(skeleton);
  const below = (dof: number) => (clamps && dof >= first ? lower[dof - first] : -Infinity);
  const above = (dof: number) => (clamps && dof >= first ? upper[dof - first] : Infinity);
  const lengths = Array.from({ length: first }, () => true);
  const moves = Array.from({ length: first }, () => true);
  skeleton.joints.forEach(({ motion }, j) => {
    for (const { unit } of dofsOf(motion)) {
      lengths.push(unit === 'length');
      moves.push(onPath[j]);
    }
  });
  const followers = followersOf(compiled, moves, below, above);
  // A DOF that one on a path follows moves it too, whichever joint it belongs to.
  for (let f = followers.count - 1; f >= 0; f--) if (moves[followers.dof[f]]) moves[followers.follows[f]] = true;
  const ofDof = new Int32Array(all).fill(-1);
  const chosen: number[] = [];
  for (let dof = 0; dof < all; dof++) {
    if (!moves[dof] || followers.ofDof[dof] >= 0 || !((stiffness[dof] ?? 1) < Infinity)) continue;
    if (below(dof) >= above(dof)) continue;
    ofDof[dof] = chosen.length;
    chosen.push(dof);
  }
  const relative = Float64Array.from(chosen, (dof) => 1 / Math.sqrt(Math.max(1e-12, stiffness[dof] ?? 1)));
  for (let f = 0; f < followers.count; f++) ofDof[followers.dof[f]] = ofDof[followers.follows[f]];
  return {
    count: chosen.length,
    dof: Int32Array.from(chosen),
    scale: relative.map((part, v) => part * (lengths[chosen[v]] ? reach : 1)),
    relative,
    lower: Float64Array.from(chosen, below),
    upper: Float64Array.from(chosen, above),
    hasLimits: chosen.some((dof) => below(dof) > -Infinity || above(dof) < Infinity),
    isLimited: chosen.some((dof) => !isUnlimited({ min: below(dof), max: above(dof) })),
    ofDof,
    followers,
  };
}

function followersOf(
  { couples, firstDof, jointCount }: CompiledSkeleton,
  moves: readonly boolean[],
  below: (dof: number) => number,
  above: (dof: number) => number,
): Followers {
  const needed = new Set<number>();
  for (let i = couples.length - 1; i >= 0; i--) {
    const { dof, follows } = couples[i];
    if (moves[dof] || needed.has(dof)) needed.add(dof).add(follows);
  }
  const kept = couples.filter(({ dof }) => needed.has(dof));
  const ofDof = new Int32Array(firstDof[jointCount]).fill(-1);
  kept.forEach(({ dof }, f) => {
    ofDof[dof] = f;
  });
  return {
    count: kept.length,
    dof: Int32Array.from(kept, ({ dof }) => dof),
    follows: Int32Array.from(kept, ({ follows }) => follows),
    gain: Float64Array.from(kept, ({ gain }) => gain),
    offset: Float64Array.from(kept, ({ offset }) => offset),
    lower: Float64Array.from(kept, ({ dof }) => below(dof)),
    upper: Float64Array.from(kept, ({ dof }) => above(dof)),
    leader: Int32Array.from(kept, ({ follows }) => ofDof[follows]),
    slope: new Float64Array(kept.length),
    ofDof,
  };
}

/** Updates the linked DOFs in place and records their rates. */
export function settleFollowers(followers: Followers, dofs: Float64Array): void {
  const { count, dof, follows, gain, offset, lower, upper, leader, slope } = followers;
  for (let f = 0; f < count; f++) {
    const value = gain[f] * dofs[follows[f]] + offset[f];
    const held = value < lower[f] ? lower[f] : value > upper[f] ? upper[f] : value;
    dofs[dof[f]] = held;
    slope[f] = held === value ? gain[f] * (leader[f] < 0 ? 1 : slope[leader[f]]) : 0;
  }
}
