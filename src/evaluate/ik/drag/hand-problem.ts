/**
 * The IK problem of one drag: owns the solver's problem, the current pose, the strength of the hand's pull, and the
 * iterations left; not when and how often it is solved (`Lead`). Budgets are iterations, independent of the clock, so
 * that the same drag gives the same pose everywhere.
 *
 * If the point can't reach the hand, its pull decreases with distance, f² · gap = const. Pins weigh ten times as much
 * (a hundred times when squared), which would not be enough against a hand three metres away: feet would be pulled off
 * the ground. So the pins hold, and the point still comes as near as they allow.
 */
import type { Vec3 } from '../../../math/vec3.ts';
import type { Character } from '../../../model/document.ts';
import type { IkSetup } from '../../../model/ik.ts';
import { lockedDofs } from '../../../model/sets.ts';
import type { Skeleton } from '../../../model/skeleton/skeleton.ts';
import { compileSkeleton } from '../../kinematics.ts';
import { movedDofs } from '../../retarget/moved-dofs.ts';
import { evaluatePose } from '../forward.ts';
import { type Bending, bendsWith } from '../limb.ts';
import { turnedAbout } from '../orientation.ts';
import type { Turn } from '../pins.ts';
import { ikProblem, movePin, turnPin } from '../problem.ts';
import { type DragTarget, draggedIndex, ikOf, ikPinsOf, type PinTarget, stiffnessOf } from '../set-up.ts';
import { type IkMode, solve } from '../solve.ts';
import type { IkProblem } from '../state.ts';
import { inertia } from './inertia.ts';

/** Fractions of the reach. Closer than this counts as reached; it is invisible on screen. */
export const IS_THERE = 2e-4;
/** Gap beyond which a point pulls with less than its weight. */
const FULL_PULL = 0.01;
/** Weight of the dragged point while the pins are restored. */
const BARELY = 1e-3;
/** A pin that pulls less than this fraction of the strongest holds nothing back. */
const HOLDS_BACK = 0.25;
/** A point that no DOF moves further than this, per radian or reach, can't move. */
const DOES_NOT_MOVE = 1e-6;
/** A radian that the hand turns is as far as this fraction of the reach. */
export const TURN_WAY = 0.3;
/** Weight of the turn while the hand turns a pin: its place gives way last. */
const TURN_GIVES = 0.1;
/** Maximum number of solves per hand position until weaker pulls have settled. */
const MAX_ROUNDS = 5;

/** The IK problem of one drag: a character's pins with the dragged point among them, and its current pose. */
export class HandProblem {
  readonly problem: IkProblem;
  /** The character's DOFs at this point of the drag. */
  readonly dofs: Float64Array;
  readonly reach: number;
  /** Index of the dragged point among the pins. */
  readonly index: number;
  /** Whether there are other pins. */
  readonly holds: boolean;
  /** Position of the hand. */
  readonly hand = new Float64Array(3);
  /** What a hand that turns turns about, in the space of the world matrices. */
  turnAxis: Vec3 | undefined;
  /** How far it has turned, in radians. */
  turned = 0;
  /** Iterations left; negative if the last solve exceeded the budget. */
  left = Infinity;
  private readonly ownWeight: number;
  private readonly ownTurnWeight: number;

  /** As for `Pull`. */
  constructor(
    readonly character: Character,
    readonly skeleton: Skeleton,
    start: ArrayLike<number>,
    readonly targets: ReadonlyMap<number, PinTarget>,
    readonly dragged: DragTarget,
    private readonly bending: Bending = 'body',
  ) {
    const setup = ikOf(character);
    this.dofs = Float64Array.from(start);
    const joint = 'pin' in dragged ? jointOfPin(setup, dragged.pin) : dragged.joint;
    this.problem = ikProblem(skeleton, ikPinsOf(setup, targets, dragged), this.dofs, {
      clamps: character.clampsToLimits,
      stiffness: handStiffness(character, skeleton, joint, bending),
    });
    const { pins, reach } = this.problem;
    this.reach = reach;
    this.index = draggedIndex(setup, dragged);
    this.ownWeight = pins.weights[this.index];
    this.ownTurnWeight = pins.turnWeights[this.index];
    this.holds = pins.count > 1;
    for (let k = 0; k < 3; k++) this.hand[k] = pins.targets[3 * this.index + k];
    // Initialises the result for the pose before anything moves.
    this.run('drag', 1);
  }

  /** A problem of this drag from another pose. @param character with other settings */
  from(start: ArrayLike<number>, character = this.character): HandProblem {
    const { skeleton, targets, dragged, bending } = this;
    return new HandProblem(character, skeleton, start, targets, dragged, bending);
  }

  /** Moves the hand without solving. */
  moveHand(x: number, y: number, z: number): void {
    this.hand[0] = x;
    this.hand[1] = y;
    this.hand[2] = z;
    movePin(this.problem, this.index, x, y, z);
  }

  /** Turns the hand about its axis from how the dragged pin was held at the start, without solving. */
  turnHand(angle: number): void {
    const { problem, index, turnAxis } = this;
    this.turned = angle;
    const turn = turnAxis && this.orientationOfHand;
    if (turn) turnPin(problem, index, turn);
  }

  /** How the dragged pin is to be turned now; undefined if it holds no orientation. */
  get orientationOfHand(): Turn | undefined {
    const { targets, dragged, turnAxis, turned } = this;
    const start = 'pin' in dragged ? targets.get(dragged.pin)?.orientation : undefined;
    return start && turnAxis ? turnedAbout(turnAxis, turned, start) : start;
  }

  /**
   * Solves from the current pose, in place. The dragged point pulls less the farther the hand is away, if there are
   * other pins.
   */
  solve(mode: IkMode): void {
    const gap = this.missing / this.reach;
    this.run(mode, this.holds && gap > FULL_PULL ? Math.sqrt(FULL_PULL / gap) : 1);
  }

  /** Restores the pins first; the dragged point stays about where it is. */
  orderPins(): void {
    this.run('drag', BARELY);
  }

  /** The next solve anticipates nothing: the pose doesn't follow from the last one. */
  forget(): void {
    const { foresight } = this.problem;
    foresight.isMet = false;
    foresight.last.fill(0);
  }

  /** Updates positions for a pose that did not come from the solver. */
  look(): void {
    evaluatePose(this.problem, this.dofs);
  }

  /**
   * Solves until the weaker pulls have settled too.
   * @param spare iterations to keep in reserve
   */
  solveToRest(spare: number): void {
    const rest = 0.1 * IS_THERE * this.reach;
    for (let round = 0; round < MAX_ROUNDS && this.left > spare; round++) {
      const before = this.missing;
      if (before <= IS_THERE * this.reach) return;
      this.solve('drag');
      if (Math.abs(before - this.missing) < rest) return;
    }
  }

  /** Distance of the dragged point from the hand. */
  get missing(): number {
    return this.missingOf(this.index);
  }

  /** Distance of pin `p` from its target, in the space of the world matrices. */
  missingOf(p: number): number {
    const { positions, targets } = this.problem.pins;
    const i = 3 * p;
    return Math.hypot(positions[i] - targets[i], positions[i + 1] - targets[i + 1], positions[i + 2] - targets[i + 2]);
  }

  /** The largest distance of a pin from its target, the dragged point excluded. */
  get worstPin(): number {
    let most = 0;
    for (let p = 0; p < this.problem.pins.count; p++) if (p !== this.index) most = Math.max(most, this.missingOf(p));
    return most;
  }

  /** Whether every pin and the dragged point are at their targets. */
  get isThere(): boolean {
    for (let p = 0; p < this.problem.pins.count; p++) if (this.missingOf(p) > IS_THERE * this.reach) return false;
    return true;
  }

  /**
   * The pins that keep the dragged point from the hand, the strongest first. At rest each pin pulls with its squared
   * weight times its error, so the pins that resist the hand are those that have an error.
   */
  holders(): number[] {
    const { pins } = this.problem;
    const pulls = Array.from({ length: pins.count }, (_, p) =>
      p === this.index ? 0 : pins.weights[p] ** 2 * this.missingOf(p),
    );
    const hand = pins.weights[this.index] ** 2 * this.missing;
    const most = Math.max(...pulls);
    if (!(most > 0 && most >= HOLDS_BACK * hand)) return [];
    const found = [...pulls.keys()].filter((p) => pulls[p] >= HOLDS_BACK * most);
    return found.sort((a, b) => pulls[b] - pulls[a]);
  }

  /** Whether any free DOF moves the dragged point, in the pose last evaluated. */
  get canMove(): boolean {
    const { jacobian, variables, pins, reach } = this.problem;
    const first = pins.row[this.index] * variables.count;
    const least = DOES_NOT_MOVE * pins.weights[this.index] * reach;
    for (let i = first; i < first + 3 * variables.count; i++) if (Math.abs(jacobian[i]) > least) return true;
    return false;
  }

  /**
   * How far the pose has moved: the largest change of a DOF, in radians, factors or fractions of the reach.
   * @param from the first DOF to compare
   * @param end past the last
   */
  furthest(before: Float64Array, from = 0, end = Infinity): number {
    const { count, dof, scale, relative } = this.problem.variables;
    let most = 0;
    for (let v = 0; v < count; v++) {
      if (dof[v] < from || dof[v] >= end) continue;
      const change = Math.abs(this.dofs[dof[v]] - before[dof[v]]);
      most = Math.max(most, change * (relative[v] / scale[v]));
    }
    return most;
  }

  private run(mode: IkMode, pull: number): void {
    const { problem, index } = this;
    problem.pins.weights[index] = this.ownWeight * pull;
    problem.pins.turnWeights[index] = this.ownTurnWeight * pull * (this.turnAxis ? TURN_GIVES : 1);
    this.left -= solve(problem, this.dofs, mode).iterations;
  }
}

/**
 * Stiffness of each of the character's DOFs while that joint is dragged.
 * @param bending the joints that may bend; others only where their DOFs are linked to these
 */
export function handStiffness(
  character: Character,
  skeleton: Skeleton,
  joint: number,
  bending: Bending = 'body',
): Float64Array {
  const moves = inertia(skeleton);
  const stays = staysBeside(character, skeleton, joint);
  const bends = bendsWith(skeleton, bending);
  return stiffnessOf(skeleton, ikOf(character), lockedDofs(character)).map((factor, dof) =>
    stays(dof) || !bends(dof) ? Infinity : factor * (moves[dof] ?? 1),
  );
}

function jointOfPin({ pins }: IkSetup, id: number): number {
  return pins.find((pin) => pin.id === id)?.joint ?? -1;
}

/**
 * Which DOFs stay fixed because another character's take drives the others. Changes over that take are discarded with
 * time, but changes of joints that it does not drive would be permanent, a side effect of a drag meant for the others.
 * The dragged joint may move, with its ancestors up to the first joint that the take drives.
 */
function staysBeside(character: Character, skeleton: Skeleton, dragged: number): (dof: number) => boolean {
  const moved = movedDofs(character);
  if (!moved) return () => false;
  const { firstDof, parent } = compileSkeleton(skeleton);
  const free = new Set(moved);
  for (let j = dragged; j >= 0; j = parent[j]) {
    if (moved.has(firstDof[j])) break;
    for (let dof = firstDof[j]; dof < firstDof[j + 1]; dof++) free.add(dof);
  }
  return (dof) => !free.has(dof);
}
