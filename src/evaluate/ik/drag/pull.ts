/**
 * The policy of one drag: takes positions of the hand and returns poses. Owns the hand's position in the world, the
 * pose at its start, and how a frame's iterations are spent; not the pointer, the document and its undo step
 * (`ui/editors/ik/hand-pull.ts`), nor the solver (`HandProblem`). Independent of the page.
 *
 * The hand's path is followed in short steps, however far it moved between two frames, so that the pose does not flip.
 * Each frame has a budget of solver iterations; what is left continues in the next frame (`isOnItsWay`).
 */
import { invertAffine, setIdentity } from '../../../math/mat4.ts';
import { subtract, type Vec3 } from '../../../math/vec3.ts';
import type { Character } from '../../../model/document.ts';
import type { DofValue } from '../../../model/dofs.ts';
import type { Skeleton } from '../../../model/skeleton.ts';
import { compileSkeleton } from '../../kinematics.ts';
import { type DragTarget, ikOf, type PinTarget, pointAt } from '../set-up.ts';
import { Blend } from './blend.ts';
import { changedValues } from './changed-values.ts';
import { HandProblem, IS_THERE } from './hand-problem.ts';
import { gapCause, type Hindrance } from './hindrance.ts';
import { HomeBranch } from './home-branch.ts';
import { Homing } from './homing.ts';
import { LockTrial } from './lock-trial.ts';
import { Shaking } from './shaking.ts';

/** Fraction of the reach. */
const LONGEST_STEP = 0.15;
/** Steps of one movement; a longer one is a jump and is followed in coarser steps. */
const MAX_STEPS = 8;
/** Iterations per frame. One takes about 20 µs for a wasp on six feet. */
const MAX_ITERATIONS = 96;
/** Maximum iterations per solve; see `solve`. */
const ONE_SOLUTION = 24;
/** Minimum iterations for shaking a pose. */
const TO_SHAKE = 2 * ONE_SOLUTION;
/** The most a pose moves in a frame, plus this much per reach that the hand moves: radians, reaches. */
const CALM = 0.08;
const FOLLOWS = 5;
/** Multiplies that limit if restoring the pins needs it. */
const MORE_FOR_PINS = 2;
/** A settled pose is used if it differs from the dragged one by less: radians, factors, fractions of the reach. */
const NO_JUMP = 0.01;
/** A visible gap: fraction of the reach. */
const SEEN_GAP = 0.01;
/** Extra frames that the release may use if the hand was too fast. */
const CATCH_UP = 8;

/** A pin or dragged point that is not at its target. */
export interface Gap {
  /** Index into the setup's pins; their number for a point that is no pin. */
  readonly index: number;
  readonly joint: number;
  /** In the space of the world matrices. */
  readonly from: Vec3;
  readonly to: Vec3;
}

const OWN_SPACE = new Float64Array(16);
setIdentity(OWN_SPACE);

/** What is dragged. */
export interface Grip {
  readonly joint: number;
  /** In the joint's space. */
  readonly point: Vec3;
  /** Id of the pin, if the point is pinned. */
  readonly pin?: number;
}

/** A pose as displayed. */
interface ShownPose {
  /** The character's DOFs. */
  readonly dofs: Float64Array;
  /** From `worldMatrices`. */
  readonly world: Float64Array;
}

export class Pull {
  private place: Vec3;
  private readonly of: HandProblem;
  private readonly shaking: Shaking;
  private readonly homing: Homing;
  private readonly branch: HomeBranch;
  private readonly blend: Blend;
  private readonly locks: LockTrial;
  private readonly start: Float64Array;
  private readonly toOwn = new Float64Array(16);
  /** Position of the hand in the character's space, and the pose at the start of a frame. */
  private readonly goal: Float64Array;
  private readonly before: Float64Array;
  private isCalmed = false;
  private shakingWaits = false;
  private readonly rootStays: boolean;

  /**
   * @param shown the pose at the start of the drag; copied
   * @param held targets of the pins, by id, in the character's space
   * @param placement from the character's space to the world's, not singular; copied
   */
  constructor(
    character: Character,
    skeleton: Skeleton,
    { dofs, world }: ShownPose,
    held: ReadonlyMap<number, PinTarget>,
    { joint, point, pin }: Grip,
    placement: Float64Array = OWN_SPACE,
  ) {
    this.rootStays = !ikOf(character).rootIsFree && compileSkeleton(skeleton).travel.some((dof) => dof >= 0);
    this.start = dofs.slice();
    invertAffine(placement, 0, this.toOwn, 0);
    const own = pointAt(world, joint, point);
    this.place = pointAt(placement, 0, own);
    const targets = new Map(held);
    // At its position, not at the target of an earlier drag, since that is where it was grabbed.
    const before = pin === undefined ? undefined : held.get(pin);
    if (before && pin !== undefined) targets.set(pin, { ...before, position: own });
    const dragged: DragTarget = pin === undefined ? { joint, point, target: own } : { pin };
    this.of = new HandProblem(character, skeleton, dofs, targets, dragged);
    this.shaking = new Shaking(this.of);
    this.homing = new Homing(this.of);
    this.branch = new HomeBranch(this.of, this.homing);
    this.blend = new Blend(this.of);
    this.locks = new LockTrial(this.of);
    this.goal = this.of.hand.slice();
    this.before = this.of.dofs.slice();
  }

  /** The character's DOFs at this point of the drag. */
  get dofs(): Float64Array {
    return this.blend.isOn ? this.blend.shown : this.of.dofs;
  }

  get reach(): number {
    return this.of.reach;
  }

  /** Why points can't reach their targets. */
  get hindrance(): Hindrance {
    const { of, rootStays } = this;
    const { slots, pins } = of.problem;
    const holders = of.holders().map((p) => slots.joint[pins.slot[p]]);
    return { binding: this.binding(), holders, locks: this.locks.inTheWay(), canMove: of.canMove, rootStays };
  }

  /** The hand's position in the world, initially that of the point. The pose may still be moving towards it. */
  get hand(): Vec3 {
    return this.place;
  }

  /** The settable DOFs that the drag has changed. */
  get changes(): DofValue[] {
    return changedValues(this.of.skeleton, this.start, this.dofs);
  }

  /** Moves the hand, in the world; `dofs` follow. Ignores positions that are not finite. */
  to(hand: Vec3): void {
    const own = pointAt(this.toOwn, 0, hand);
    if (!own.every(Number.isFinite)) return;
    this.place = hand;
    this.goal.set(own);
    this.frame();
  }

  /** Another frame of a pose that is still moving towards the hand. */
  goOn(): void {
    this.frame();
  }

  private frame(): void {
    const { of, before, shaking } = this;
    before.set(of.dofs);
    of.left = MAX_ITERATIONS;
    // What did not fit into the previous frame is done in this one.
    const spare = this.shakingWaits ? TO_SHAKE : 0;
    const way = this.follow(spare);
    this.shakingWaits = false;
    if (of.holds) {
      of.solveToRest(spare);
      if (shaking.isDue) {
        if (of.left >= ONE_SOLUTION) shaking.shake();
        else this.shakingWaits = true;
      }
    }
    this.homing.come(0, !this.isCalmed && !this.isBehind);
    this.calm(CALM + FOLLOWS * (way / of.reach));
    this.blend.step();
    if (way === 0) this.lookForHome();
  }

  /** The hand is still: continues on the branch nearest to home. */
  private lookForHome(): void {
    const { homing, branch, blend } = this;
    if (this.isBehind || this.shakingWaits || blend.isOn || !branch.isDue || !branch.look()) return;
    homing.unwind(branch.before);
    blend.begin(branch.before);
    this.isCalmed = false;
  }

  /** Whether the pose is still moving towards the hand; if so, call `to` again in the next frame. */
  get isOnItsWay(): boolean {
    const { homing, branch, blend } = this;
    const isAway = this.isCalmed || this.shakingWaits || this.isBehind;
    return isAway || homing.isOnItsWay || blend.isOn || branch.isDue;
  }

  /**
   * The release: finishes the movement if that is only a small change. What can't be satisfied stays as the hand left
   * it: a better pose elsewhere would be an unexpected jump.
   */
  settle(): void {
    const { of, blend } = this;
    if (blend.isOn) {
      // What is seen stays, on its way or not.
      of.dofs.set(blend.shown);
      blend.stop();
      of.forget();
      of.look();
      return;
    }
    for (let frame = 0; frame < CATCH_UP && this.isBehind; frame++) this.goOn();
    if (!of.isThere || !of.problem.result.isSolved) return;
    const before = of.dofs.slice();
    of.solve('settle');
    if (of.isThere && of.furthest(before) <= NO_JUMP) return;
    of.dofs.set(before);
    of.solve('drag');
  }

  /** Whether the hand asks for more than the character can do with its root fixed. */
  get wantsRoot(): boolean {
    const { of, rootStays } = this;
    if (!rootStays || of.missing <= SEEN_GAP * of.reach) return false;
    return gapCause(this.hindrance) === 'root';
  }

  /** Every pin that is not at its target. */
  gaps(): Gap[] {
    const { problem, reach } = this.of;
    const { pins, slots } = problem;
    const found: Gap[] = [];
    for (let p = 0; p < pins.count; p++) {
      if (this.of.missingOf(p) <= 5 * IS_THERE * reach) continue;
      found.push({ index: p, joint: slots.joint[pins.slot[p]], from: at(pins.positions, p), to: at(pins.targets, p) });
    }
    return found;
  }

  /** DOFs of the character whose limits keep the pins from coming nearer. */
  binding(): readonly number[] {
    const { binding, bindingCount } = this.of.problem.result;
    return Array.from(binding.subarray(0, bindingCount));
  }

  /** Targets of the pins after the release, by id: for the dragged one the hand's position, reached or not. */
  get held(): ReadonlyMap<number, PinTarget> {
    const { targets, dragged, hand } = this.of;
    const own = 'pin' in dragged ? targets.get(dragged.pin) : undefined;
    if (!own || !('pin' in dragged)) return targets;
    return new Map(targets).set(dragged.pin, { ...own, position: at(hand, 0) });
  }

  /** A distance in the world, in the character's own unit. */
  inOwnUnit(from: Vec3, to: Vec3): number {
    const { toOwn } = this;
    return Math.hypot(...subtract(pointAt(toOwn, 0, to), pointAt(toOwn, 0, from)));
  }

  /** Whether the frame's budget ended before the hand's destination. */
  private get isBehind(): boolean {
    const { hand } = this.of;
    return this.goal.some((v, k) => v !== hand[k]);
  }

  /** In short steps, as far as the budget allows. @returns how far the hand has moved */
  private follow(spare: number): number {
    const { of, goal } = this;
    const [fromX, fromY, fromZ] = of.hand;
    const [x, y, z] = goal;
    const way = Math.hypot(x - fromX, y - fromY, z - fromZ);
    const steps = Math.min(MAX_STEPS, Math.max(1, Math.ceil(way / (LONGEST_STEP * of.reach))));
    for (let s = 1; s < steps; s++) {
      const part = s / steps;
      of.moveHand(fromX + part * (x - fromX), fromY + part * (y - fromY), fromZ + part * (z - fromZ));
      of.solve('drag');
      if (of.left < spare + ONE_SOLUTION) return part * way;
    }
    of.moveHand(x, y, z);
    of.solve('drag');
    return way;
  }

  /**
   * When a leg reaches full length, the last millimetre may need the body to lean far over. That is allowed, but spread
   * over several frames.
   */
  private calm(most: number): void {
    const { of } = this;
    const far = of.furthest(this.before);
    this.isCalmed = far > most;
    if (!this.isCalmed) return;
    this.goBack(most / far);
    // In between, the pins are slightly off: restore them first.
    of.orderPins();
    // For an almost straight chain this may move as far again; then accept pins that are off by a hair.
    const again = of.furthest(this.before);
    if (again <= MORE_FOR_PINS * most) return;
    this.goBack(most / again);
    of.look();
  }

  /** Back to the pose at the start of the frame, except for a fraction of the movement. */
  private goBack(part: number): void {
    const { before } = this;
    const { dofs } = this.of;
    for (let d = 0; d < dofs.length; d++) dofs[d] = before[d] + part * (dofs[d] - before[d]);
  }
}

function at(list: Float64Array, p: number): Vec3 {
  return [list[3 * p], list[3 * p + 1], list[3 * p + 2]];
}
