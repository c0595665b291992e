/**
 * Finds the locks that keep the dragged point from the hand. Locks leave no trace in the solution, since locked DOFs
 * are not variables; so the problem is solved from the current pose without locks, and if the point comes nearer, the
 * joints that then bend are the cause.
 */
import { compileSkeleton } from '../../kinematics.ts';
import { ikOf } from '../set-up.ts';
import type { HandProblem } from './hand-problem.ts';

/** Fraction of the reach that the point must come nearer. */
const NEARER = 0.01;
/** A joint that bends less than this fraction of the one that bends most is not a cause. */
const BENDS = 0.25;
/** Iterations of one attempt. */
const ENOUGH = 48;

/** Finds which locked joints keep the dragged point of one drag from the hand; the last answer is cached. */
export class LockTrial {
  private readonly locked: readonly number[];
  private free: HandProblem | undefined;
  /** The input of the cached answer. */
  private readonly pose: Float64Array;
  private readonly hand = new Float64Array(3).fill(Number.NaN);
  private found: readonly number[] = [];

  /** @param of the problem with the locks */
  constructor(private readonly of: HandProblem) {
    const { stiff } = ikOf(of.character);
    this.locked = stiff.flatMap(({ joint, stiffness }) => (stiffness === undefined ? [joint] : []));
    this.pose = new Float64Array(of.dofs.length);
  }

  /**
   * The joints that block, the one that would bend most first. Called every frame; recomputed only when the drag has
   * moved on.
   */
  inTheWay(): readonly number[] {
    const { of, locked, pose, hand } = this;
    if (locked.length === 0 || of.missing <= NEARER * of.reach) return [];
    const isKnown = hand.every((v, k) => v === of.hand[k]) && pose.every((v, d) => v === of.dofs[d]);
    if (isKnown) return this.found;
    pose.set(of.dofs);
    hand.set(of.hand);
    this.found = this.tryWithout();
    return this.found;
  }

  private tryWithout(): readonly number[] {
    const { of, locked, pose, hand } = this;
    this.free ??= this.withoutLocks();
    const { free } = this;
    free.dofs.set(pose);
    free.moveHand(hand[0], hand[1], hand[2]);
    free.left = ENOUGH;
    free.solve('drag');
    free.solveToRest(0);
    if (of.missing - free.missing < NEARER * of.reach) return [];
    const { firstDof } = compileSkeleton(of.skeleton);
    const bent = new Map(locked.map((j) => [j, free.furthest(pose, firstDof[j], firstDof[j + 1])] as const));
    const bends = (joint: number) => bent.get(joint) ?? 0;
    const most = Math.max(...bent.values());
    return locked.filter((j) => bends(j) > 0 && bends(j) >= BENDS * most).sort((a, b) => bends(b) - bends(a));
  }

  private withoutLocks(): HandProblem {
    const { character } = this.of;
    const setup = ikOf(character);
    const ik = { ...setup, stiff: setup.stiff.filter(({ stiffness }) => stiffness !== undefined) };
    return this.of.from(this.pose, { ...character, ik });
  }
}
