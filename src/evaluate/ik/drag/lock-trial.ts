/**
 * Which locks keep the dragged point from the hand. A lock leaves no trace in the solution, for what is locked is no
 * unknown of it; so the pose is tried from where it is without any lock, and the locks that are in the way are those of
 * the joints that bend then, if the point comes nearer by that.
 */
import type { Character } from '../../../model/document.ts';
import type { Skeleton } from '../../../model/skeleton.ts';
import { compileSkeleton } from '../../kinematics.ts';
import { type Dragged, ikOf, type PinTarget } from '../set-up.ts';
import { HandProblem } from './hand-problem.ts';

/** How much nearer the point has to come: part of the reach. */
const NEARER = 0.01;
/** A joint that bends by less than that part of the one that bends most is not in the way. */
const BENDS = 0.25;
/** Iterations of one try. */
const ENOUGH = 48;

export class LockTrial {
  private readonly locked: readonly number[];
  private free: HandProblem | undefined;
  /** What the last answer was about. */
  private readonly pose: Float64Array;
  private readonly hand = new Float64Array(3).fill(Number.NaN);
  private found: readonly number[] = [];

  /** As of `HandProblem`, whose problem with the locks is `of`. */
  constructor(
    private readonly of: HandProblem,
    private readonly character: Character,
    private readonly skeleton: Skeleton,
    private readonly targets: ReadonlyMap<number, PinTarget>,
    private readonly dragged: Dragged,
  ) {
    const { stiff } = ikOf(character);
    this.locked = stiff.flatMap(({ joint, stiffness }) => (stiffness === undefined ? [joint] : []));
    this.pose = new Float64Array(of.dofs.length);
  }

  /** The joints, the one that would bend most first. Asked for before every picture: worked out where the drag has gone on. */
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
    const { of, skeleton, locked, pose, hand } = this;
    this.free ??= this.withoutLocks();
    const { free } = this;
    free.dofs.set(pose);
    free.moveHand(hand[0], hand[1], hand[2]);
    free.left = ENOUGH;
    free.solve('drag');
    free.comeToRest(0);
    if (of.missing - free.missing < NEARER * of.reach) return [];
    const { firstDof } = compileSkeleton(skeleton);
    const bent = new Map(locked.map((j) => [j, free.furthest(pose, firstDof[j], firstDof[j + 1])] as const));
    const bends = (joint: number) => bent.get(joint) ?? 0;
    const most = Math.max(...bent.values());
    return locked.filter((j) => bends(j) > 0 && bends(j) >= BENDS * most).sort((a, b) => bends(b) - bends(a));
  }

  private withoutLocks(): HandProblem {
    const { character, skeleton, targets, dragged, pose } = this;
    const setup = ikOf(character);
    const ik = { ...setup, stiff: setup.stiff.filter(({ stiffness }) => stiffness !== undefined) };
    return new HandProblem({ ...character, ik }, skeleton, pose, targets, dragged);
  }
}
