/**
 * Limbs over a pose, at a time and one after another (`order.ts`), with the matrices as they then are:
 *
 *     1. IK's DOFs      in closed form (`closed.ts`), or by the solver of pins (`pinned.ts`), nearest to FK's
 *     2. blend          FK + blend · (IK − FK), blend clamped to 0 … 1
 *     3. limits         where the blend meets one, the solver of pins continues from there within them
 *     4. linked DOFs    of what follows the limb
 */
import { multiplyAffine } from '../../math/mat4.ts';
import type { Unkeyed } from '../../model/document.ts';
import { soundLimbs } from '../../model/limb-problems.ts';
import type { Limb, Limbs } from '../../model/limbs.ts';
import { perObject, perPair } from '../../model/per-object.ts';
import { couplesOf, type DofCouple } from '../../model/skeleton/couples.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { goalChannel, spacesOf } from '../../model/takes/goals.ts';
import type { GoalProblem } from '../../model/takes/layer-code.ts';
import { GOAL_CHANNELS, type Goal, type Goals } from '../../model/takes/take.ts';
import { type CompiledTake, compileChannels } from '../compiled-take.ts';
import { evaluateTake } from '../curves.ts';
import { type CompiledSkeleton, compileSkeleton, writeLocal } from '../kinematics.ts';
import { type Chain, closedChain } from './bend.ts';
import { solveClosed } from './closed.ts';
import { type GoalOfLimb, orderedGoals } from './order.ts';
import { type PinnedLimb, pinnedLimb, solvePinned } from './pinned.ts';
import { BEND, newTarget, writeTarget, writeTip } from './target.ts';

/** Farther beyond a limit than this is no rounding; radians and lengths. */
const AT_LIMIT = 1e-9;

/** A limb with its goal, ready for evaluation. */
export interface CompiledLimb {
  readonly limb: Limb;
  readonly goal: Goal;
  /** Undefined of limbs that the solver of pins moves. */
  readonly chain: Chain | undefined;
  /** Where its channels begin among the values of all. */
  readonly at: number;
  readonly hasPole: boolean;
  /** NaN if the goal has a channel for it. */
  readonly sign: number;
  /** Seconds from which each space applies, ascending, and its joint; -1 for the character's own. */
  readonly spaceTimes: Float64Array;
  readonly spaces: Int32Array;
  /** Joints whose matrices have to be computed before this limb is solved: since the last limb, they may have moved. */
  readonly stale: Int32Array;
  /** All DOFs of its joints. */
  readonly dofs: Int32Array;
  readonly couples: readonly DofCouple[];
}

/** All limbs with goals of a take over poses of a skeleton. */
export class TakeLimbs {
  /** In the order in which they are solved. */
  readonly limbs: readonly CompiledLimb[];
  readonly compiled: CompiledSkeleton;
  /** The matrices of joints that limbs need, during `solve`; scratch besides. */
  readonly world: Float64Array;
  /** All channels of all goals, at the time of the last `evaluate` or `solve`. */
  readonly values: Float64Array;
  private readonly curves: CompiledTake;
  /** Where the channels of all goals, in the order of the take, are among `values`; -1 for goals that are not reached. */
  private readonly places: Int32Array;
  private readonly target = newTarget();
  /** A limb's DOFs: FK's, IK's, and those before and after they were clamped. */
  private readonly fk: Float64Array;
  private readonly ik: Float64Array;
  private readonly beyond: Float64Array;
  private readonly held: Float64Array;
  /** IK problems of limbs, with and without limits; made when they are first needed. */
  private readonly problems = new Map<CompiledLimb, [PinnedLimb?, PinnedLimb?]>();

  constructor(
    goals: Goals,
    limbs: Limbs,
    private readonly skeleton: Skeleton,
  ) {
    this.compiled = compileSkeleton(skeleton);
    const { ordered } = orderedGoals(goals, soundLimbs(limbs, skeleton).list, skeleton);
    this.limbs = compiledLimbs(ordered, skeleton, this.compiled);
    this.curves = compileChannels(ordered.flatMap(({ goal }) => GOAL_CHANNELS.map((name) => goalChannel(goal, name))));
    this.values = new Float64Array(this.curves.channelCount);
    this.places = new Int32Array(GOAL_CHANNELS.length * goals.list.length).fill(-1);
    ordered.forEach(({ index }, i) => {
      const { length } = GOAL_CHANNELS;
      for (let k = 0; k < length; k++) this.places[length * index + k] = length * i + k;
    });
    this.world = new Float64Array(16 * this.compiled.jointCount);
    const most = Math.max(0, ...this.limbs.map(({ dofs }) => dofs.length));
    const scratch = () => new Float64Array(most);
    [this.fk, this.ik, this.beyond, this.held] = [scratch(), scratch(), scratch(), scratch()];
  }

  /**
   * Moves the limbs of a pose to their goals, in place. Allocates nothing, but when a limb first needs the solver of
   * pins.
   * @param dofs the character's, within its limits
   * @param count their number; `dofs` may be longer
   * @param unkeyed as for `evaluate`
   * @param before called before each limb is solved, with the joint of its goal's space
   */
  solve(
    timeSeconds: number,
    dofs: Float64Array,
    clamps: boolean,
    count = dofs.length,
    unkeyed?: Unkeyed,
    before?: (limb: CompiledLimb, space: number) => void,
  ): void {
    this.evaluate(timeSeconds, count, unkeyed);
    for (const limb of this.limbs) {
      for (let i = 0; i < limb.stale.length; i++) this.writeWorld(limb.stale[i], dofs);
      const blend = this.values[limb.at];
      if (!(blend > 0) && !before) continue;
      const space = spaceJointAt(limb, timeSeconds);
      before?.(limb, space);
      if (!(blend > 0)) continue;
      writeTarget(this.values, limb.at, this.world, space, this.target);
      this.target.hasPole = limb.hasPole;
      const bend = Number.isNaN(limb.sign) ? this.values[limb.at + BEND] : limb.sign;
      this.target.bend = bend >= 0 ? 1 : -1;
      this.move(limb, Math.min(1, blend), dofs, clamps);
    }
  }

  /**
   * Writes the channels of all goals at a time to `values`.
   * @param count number of the character's DOFs
   * @param unkeyed values of goals set by hand at that time, among others, by the indices of `withGoalChannels`
   */
  evaluate(timeSeconds: number, count: number, unkeyed: Unkeyed | undefined): void {
    evaluateTake(this.curves, timeSeconds, this.values);
    for (let i = 0; unkeyed && i < unkeyed.dofs.length; i++) {
      const at = this.places[unkeyed.dofs[i] - count];
      if (at >= 0) this.values[at] = unkeyed.values[i];
    }
  }

  private move(limb: CompiledLimb, blend: number, dofs: Float64Array, clamps: boolean): void {
    const { target, fk, ik, world } = this;
    const { chain, couples } = limb;
    const count = limb.dofs.length;
    for (let i = 0; i < count; i++) fk[i] = dofs[limb.dofs[i]];
    if (chain) solveClosed(chain, target, dofs, world);
    else solvePinned(this.problemOf(limb, clamps), target.point, target.turn, dofs, true);
    for (let i = 0; i < count; i++) {
      ik[i] = dofs[limb.dofs[i]];
      // Not even rounding where it is all IK.
      if (blend < 1) dofs[limb.dofs[i]] = fk[i] + blend * (ik[i] - fk[i]);
    }
    if (clamps && chain && this.exceedsLimits(limb, dofs)) this.continueWithin(limb, blend, dofs);
    const { lower, upper, firstDof } = this.compiled;
    for (let i = 0; i < couples.length; i++) {
      const { dof, follows, gain, offset } = couples[i];
      const value = gain * dofs[follows] + offset;
      const d = dof - firstDof[0];
      dofs[dof] = clamps ? Math.min(upper[d], Math.max(lower[d], value)) : value;
    }
  }

  /** Clamps the limb to its limits; returns whether one was met. */
  private exceedsLimits({ dofs: own }: CompiledLimb, dofs: Float64Array): boolean {
    const { lower, upper, firstDof } = this.compiled;
    let isMet = false;
    for (let i = 0; i < own.length; i++) {
      const [dof, d] = [own[i], own[i] - firstDof[0]];
      const value = dofs[dof];
      const held = value < lower[d] ? lower[d] : value > upper[d] ? upper[d] : value;
      isMet ||= Math.abs(held - value) > AT_LIMIT;
      this.beyond[i] = value;
      dofs[dof] = held;
    }
    return isMet;
  }

  /**
   * Continues from a pose that was clamped: to the goal, or, if the limb is only partly IK's, to where it was before it
   * was clamped, and so much farther.
   */
  private continueWithin(limb: CompiledLimb, blend: number, dofs: Float64Array): void {
    const { target, ik, beyond, held } = this;
    const { tip } = limb.limb;
    const count = limb.dofs.length;
    if (blend === 1) {
      solvePinned(this.problemOf(limb, true), target.point, target.turn, dofs, false);
      return;
    }
    for (let i = 0; i < count; i++) {
      held[i] = dofs[limb.dofs[i]];
      dofs[limb.dofs[i]] = ik[i];
    }
    this.writeLast(limb, dofs, last);
    writeTip(tip, last, 0, tipOfIk);
    for (let i = 0; i < count; i++) dofs[limb.dofs[i]] = beyond[i];
    this.writeLast(limb, dofs, last);
    writeTip(tip, last, 0, aim);
    for (let k = 0; k < 3; k++) {
      aim[k] += blend * (target.point[k] - tipOfIk[k]);
      for (let r = 0; r < 3; r++) aimTurn[3 * k + r] = last[4 * k + r];
    }
    for (let i = 0; i < count; i++) dofs[limb.dofs[i]] = held[i];
    solvePinned(this.problemOf(limb, true), aim, aimTurn, dofs, false);
  }

  /** Writes the matrix of the limb's last joint, while those that the limb needs are of the pose. */
  writeLast({ limb: { joints } }: CompiledLimb, dofs: Float64Array, out: Float64Array): void {
    const above = this.compiled.parent[joints[0]];
    for (let k = 0; k < 16; k++) out[k] = above < 0 ? (k % 5 === 0 ? 1 : 0) : this.world[16 * above + k];
    for (const joint of joints) {
      writeLocal(this.compiled, joint, dofs, local, 0);
      multiplyAffine(out, 0, local, 0, product, 0);
      out.set(product);
    }
  }

  private writeWorld(j: number, dofs: Float64Array): void {
    const { compiled, world } = this;
    const above = compiled.parent[j];
    if (above < 0) writeLocal(compiled, j, dofs, world, 16 * j);
    else {
      writeLocal(compiled, j, dofs, local, 0);
      multiplyAffine(world, 16 * above, local, 0, world, 16 * j);
    }
  }

  private problemOf(limb: CompiledLimb, clamps: boolean): PinnedLimb {
    const known = this.problems.get(limb) ?? [];
    const which = clamps ? 0 : 1;
    const problem = known[which] ?? pinnedLimb(limb.limb, this.skeleton, clamps);
    known[which] = problem;
    this.problems.set(limb, known);
    return problem;
  }
}

/** Scratch; never escapes. */
const local = new Float64Array(16);
const product = new Float64Array(16);
const last = new Float64Array(16);
const aim = new Float64Array(3);
const aimTurn = new Float64Array(9);
const tipOfIk = new Float64Array(3);

const byLimbs = perObject((goals: Goals) =>
  perPair((limbs: Limbs, skeleton: Skeleton) => new TakeLimbs(goals, limbs, skeleton)),
);

/** The problems of goals, which are then not reached. */
export function goalProblems(goals: Goals, limbs: Limbs, skeleton: Skeleton): readonly GoalProblem[] {
  return orderedGoals(goals, limbs.list, skeleton).problems;
}

/** The limbs that goals move, compiled; cached. */
export function takeLimbs(goals: Goals, limbs: Limbs, skeleton: Skeleton): TakeLimbs {
  return byLimbs(goals)(limbs, skeleton);
}

/** The joint of the space that applies at a time; -1 for the character's own. */
export function spaceJointAt({ spaceTimes, spaces }: CompiledLimb, timeSeconds: number): number {
  let k = spaces.length - 1;
  while (k > 0 && spaceTimes[k] > timeSeconds) k--;
  return spaces[k];
}

function compiledLimbs(
  ordered: readonly GoalOfLimb[],
  skeleton: Skeleton,
  compiled: CompiledSkeleton,
): readonly CompiledLimb[] {
  const { parent, subtreeEnd, firstDof, jointCount } = compiled;
  const isFresh = new Uint8Array(jointCount);
  const { ordered: couples } = couplesOf(skeleton);
  const jointOf = (dof: number) => firstDof.findLastIndex((first, j) => j < jointCount && first <= dof);
  return ordered.map(({ goal, limb, spaces, followers }, i): CompiledLimb => {
    const { joints, bend } = limb;
    const stale = new Set<number>();
    for (const joint of [parent[joints[0]], ...spaces]) {
      for (let j = joint; j >= 0 && !isFresh[j]; j = parent[j]) stale.add(j);
    }
    for (const j of stale) isFresh[j] = 1;
    for (const j of [joints[0], ...followers.map(jointOf)]) isFresh.fill(0, j, subtreeEnd[j]);
    const { channels } = goal;
    return {
      ...{ limb, goal, chain: closedChain(limb, skeleton, compiled), at: GOAL_CHANNELS.length * i },
      hasPole: (channels.px ?? channels.py ?? channels.pz) !== undefined,
      sign: channels.bend ? Number.NaN : (bend?.sign ?? 1),
      spaceTimes: Float64Array.from(spacesOf(goal), ([time]) => time),
      spaces: Int32Array.from(spaces),
      stale: Int32Array.from(stale).sort(),
      dofs: Int32Array.from(
        joints.flatMap((j) => Array.from({ length: firstDof[j + 1] - firstDof[j] }, (_, k) => firstDof[j] + k)),
      ),
      couples: couples.filter(({ dof }) => followers.includes(dof)),
    };
  });
}
