/**
 * One drag by inverse kinematics: one problem for all of it, made where it begins, and a pose that goes on from frame to
 * frame. What is dragged follows the hand; the pins hold.
 *
 * The hand's way is followed in short steps, however far it went between two frames: a pose that is led there does not
 * flip over on the way, and what comes of a drag does not depend on how fast the machine is.
 *
 * A point that can't come where the hand is pulls the less the further away the hand is, f² · gap = const. Pins that hold
 * weigh ten times as much (a hundred times in squares), which is not enough beside a hand three metres off: feet would
 * be drawn out of their places. So they stay, and the point still comes as near as they let it.
 */
import { ikProblem, movePin } from '../../../evaluate/ik/problem.ts';
import {
  type Dragged,
  draggedIndex,
  ikOf,
  ikPinsOf,
  type PinTarget,
  stiffnessOf,
} from '../../../evaluate/ik/set-up.ts';
import { type IkMode, solve } from '../../../evaluate/ik/solve.ts';
import type { IkProblem } from '../../../evaluate/ik/state.ts';
import type { Vec3 } from '../../../math/vec3.ts';
import type { Character } from '../../../model/document.ts';
import type { Skeleton } from '../../../model/skeleton.ts';
import { inertia } from './inertia.ts';

/** Parts of the reach. */
const LONGEST_STEP = 0.15;
/** Nearer than that it is there; no screen shows it. */
const IS_THERE = 2e-4;
/** A gap from which a point pulls with less than its weight. */
const FULL_PULL = 0.01;
/** A gap that is worth a try to bend what is straight. */
const STUCK = 0.004;
/** A pose moves at most so far in a frame, and so much further for each reach that the hand moves: radians, reaches. */
const CALM = 0.08;
const FOLLOWS = 5;
/** The weight of what is dragged while the pins are put in order. */
const BARELY = 1e-3;
/** How far everything is bent for it: radians, parts of the reach. */
const SHAKE = 0.02;
/** What is left of the gap where it has helped. */
const HELPS = 0.8;
/** Steps of one move: past these it is a jump, and what leads there is coarser. */
const MOST_STEPS = 8;
/** Solutions after the last step, until what pulls less has come to rest. */
const MOST_ROUNDS = 5;
/** A settled pose that is nearer than that to the one that was dragged is taken: radians, factors, parts of the reach. */
const NO_JUMP = 0.01;

/** A pin, or what was dragged, that is not where it should be. */
export interface Gap {
  /** Into the setup's pins; as many as they are for a point that was no pin. */
  readonly index: number;
  readonly joint: number;
  /** In the space of the world matrices. */
  readonly from: Vec3;
  readonly to: Vec3;
}

export class Pull {
  /** The character's DOFs as the drag has them now. */
  readonly dofs: Float64Array;
  readonly reach: number;
  private readonly problem: IkProblem;
  private readonly index: number;
  private readonly ownWeight: number;
  private readonly ownTurnWeight: number;
  private readonly holds: boolean;
  /** Where the hand is. */
  private readonly hand = new Float64Array(3);
  /** Where it was when the pose was last shaken, and poses on the way. */
  private readonly shakenAt = new Float64Array(3).fill(Infinity);
  private readonly before: Float64Array;
  private onItsWay = false;
  private readonly stuck: Float64Array;
  private readonly helped: Float64Array;

  /**
   * @param start the character's DOFs as they are shown; copied
   * @param targets where its pins hold, by id
   * @param dragged where the point is now, which is where its drag begins
   */
  constructor(
    character: Character,
    skeleton: Skeleton,
    start: ArrayLike<number>,
    targets: ReadonlyMap<number, PinTarget>,
    dragged: Dragged,
  ) {
    const setup = ikOf(character);
    this.dofs = Float64Array.from(start);
    this.before = new Float64Array(this.dofs.length);
    this.stuck = new Float64Array(this.dofs.length);
    this.helped = new Float64Array(this.dofs.length);
    const moves = inertia(skeleton);
    this.problem = ikProblem(skeleton, ikPinsOf(setup, targets, dragged), this.dofs, {
      clamps: character.clampsToLimits,
      stiffness: stiffnessOf(skeleton, setup).map((factor, dof) => factor * (moves[dof] ?? 1)),
    });
    const { pins, reach } = this.problem;
    this.reach = reach;
    this.index = draggedIndex(setup, dragged);
    this.ownWeight = pins.weights[this.index];
    this.ownTurnWeight = pins.turnWeights[this.index];
    this.holds = pins.count > 1;
    for (let k = 0; k < 3; k++) this.hand[k] = pins.targets[3 * this.index + k];
    // What is known of the pose where nothing has moved yet.
    solve(this.problem, this.dofs, 'drag');
  }

  /** Whether any DOF is free to follow. */
  get canMove(): boolean {
    return this.problem.variables.count > 0;
  }

  /** The hand has gone there; `dofs` follow. What is not finite is nowhere. */
  to(x: number, y: number, z: number): void {
    if (!Number.isFinite(x + y + z)) return;
    const { hand, problem, index, reach, before } = this;
    before.set(this.dofs);
    const fromX = hand[0];
    const fromY = hand[1];
    const fromZ = hand[2];
    const way = Math.hypot(x - fromX, y - fromY, z - fromZ);
    const steps = Math.min(MOST_STEPS, Math.max(1, Math.ceil(way / (LONGEST_STEP * reach))));
    for (let s = 1; s <= steps; s++) {
      const part = s / steps;
      hand[0] = s === steps ? x : fromX + part * (x - fromX);
      hand[1] = s === steps ? y : fromY + part * (y - fromY);
      hand[2] = s === steps ? z : fromZ + part * (z - fromZ);
      movePin(problem, index, hand[0], hand[1], hand[2]);
      this.solve('drag');
    }
    if (!this.holds) return;
    this.comeToRest();
    if (this.missing > STUCK * reach) this.shake();
    this.calm(CALM + FOLLOWS * (way / reach));
  }

  /** Whether the pose is still on its way to where the hand is: ask it to go there again with the next frame. */
  get isOnItsWay(): boolean {
    return this.onItsWay;
  }

  /**
   * Where a leg comes to its full length, the last millimetre of reach may be a body that leans far over. It gets there,
   * but in more than one frame.
   */
  private calm(most: number): void {
    const { dofs, before, problem, index } = this;
    const far = this.furthest(before);
    this.onItsWay = far > most;
    if (!this.onItsWay) return;
    for (let d = 0; d < dofs.length; d++) dofs[d] = before[d] + (most / far) * (dofs[d] - before[d]);
    // In between the pins are not quite where they hold: they come first.
    problem.pins.weights[index] = this.ownWeight * BARELY;
    problem.pins.turnWeights[index] = this.ownTurnWeight * BARELY;
    solve(problem, dofs, 'drag');
  }

  private comeToRest(): void {
    const rest = 0.1 * IS_THERE * this.reach;
    for (let round = 0; round < MOST_ROUNDS && this.missing > IS_THERE * this.reach; round++) {
      const before = this.missing;
      this.solve('drag');
      if (Math.abs(before - this.missing) < rest) return;
    }
  }

  /**
   * Legs that are straight don't bend when a hip is pushed down on feet that hold: at first it changes their length by
   * nothing. So all is bent a little, one way and the other, and what comes of it is kept where it helps. The solver does
   * as much for one chain; here what is dragged could move, were it not for the pins. Asked again only after the hand has
   * gone on, and soon enough that little has been missed by then.
   */
  private shake(): void {
    const { hand, problem, dofs, reach, shakenAt, stuck, helped } = this;
    const { count, dof, scale, lower, upper } = problem.variables;
    const since = Math.hypot(hand[0] - shakenAt[0], hand[1] - shakenAt[1], hand[2] - shakenAt[2]);
    if (since < STUCK * reach) return;
    shakenAt.set(hand);
    stuck.set(dofs);
    let least = HELPS * this.missing;
    let helps = false;
    for (const way of [1, -1]) {
      dofs.set(stuck);
      for (let v = 0; v < count; v++) {
        const bent = dofs[dof[v]] + way * SHAKE * scale[v];
        dofs[dof[v]] = Math.min(upper[v], Math.max(lower[v], bent));
      }
      this.solve('drag');
      this.comeToRest();
      if (this.missing >= least) continue;
      least = this.missing;
      helped.set(dofs);
      helps = true;
    }
    dofs.set(helps ? helped : stuck);
    this.solve('drag');
  }

  /**
   * The release: the last part of the way, where everything is nearly there and nothing jumps by it. What can't be had
   * stays as the hand has left it: a better pose elsewhere would be a jump that nobody asked for.
   */
  settle(): void {
    const { result } = this.problem;
    if (!this.isThere || !result.isSolved) return;
    const before = this.dofs.slice();
    this.solve('settle');
    if (!this.isThere || this.furthest(before) > NO_JUMP) {
      this.dofs.set(before);
      this.solve('drag');
    }
  }

  /** How far the dragged point is from the hand. */
  get missing(): number {
    return this.missingOf(this.index);
  }

  /** Every pin that is not where it should be. */
  gaps(): Gap[] {
    const { pins, slots } = this.problem;
    const found: Gap[] = [];
    for (let p = 0; p < pins.count; p++) {
      if (this.missingOf(p) <= 5 * IS_THERE * this.reach) continue;
      found.push({ index: p, joint: slots.joint[pins.slot[p]], from: at(pins.positions, p), to: at(pins.targets, p) });
    }
    return found;
  }

  /** DOFs of the character that a limit keeps from bringing the pins nearer. */
  binding(): readonly number[] {
    const { binding, bindingCount } = this.problem.result;
    return Array.from(binding.subarray(0, bindingCount));
  }

  /** Where a pin is to be, with what it has for an orientation. */
  target(index: number): Vec3 {
    return at(this.problem.pins.targets, index);
  }

  private get isThere(): boolean {
    for (let p = 0; p < this.problem.pins.count; p++) if (this.missingOf(p) > IS_THERE * this.reach) return false;
    return true;
  }

  private solve(mode: IkMode): void {
    const { problem, index } = this;
    if (this.holds) {
      const gap = this.missing / this.reach;
      const pull = gap > FULL_PULL ? Math.sqrt(FULL_PULL / gap) : 1;
      problem.pins.weights[index] = this.ownWeight * pull;
      problem.pins.turnWeights[index] = this.ownTurnWeight * pull;
    }
    solve(problem, this.dofs, mode);
  }

  private missingOf(p: number): number {
    const { positions, targets } = this.problem.pins;
    const i = 3 * p;
    return Math.hypot(positions[i] - targets[i], positions[i + 1] - targets[i + 1], positions[i + 2] - targets[i + 2]);
  }

  /** How far the pose has moved: the largest of its changes. */
  private furthest(before: Float64Array): number {
    const { count, dof, scale, relative } = this.problem.variables;
    let most = 0;
    for (let v = 0; v < count; v++) {
      const change = Math.abs(this.dofs[dof[v]] - before[dof[v]]);
      most = Math.max(most, change * (relative[v] / scale[v]));
    }
    return most;
  }
}

function at(list: Float64Array, p: number): Vec3 {
  return [list[3 * p], list[3 * p + 1], list[3 * p + 2]];
}
