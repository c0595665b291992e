/**
 * The policy of one drag: places of the hand in, a pose out. Owns where the hand is, in the world, the pose that it was
 * taken hold of in, and in what order a frame's iterations are spent; not the pointer, the document and its undo step
 * (`ui/editors/ik/hand-pull.ts`), nor what a solution is (`HandProblem`). Needs no page.
 *
 * The hand's way is followed in short steps, however far it went between two frames: a pose that is led there does not
 * flip over on the way. A frame has room for so many iterations of the solver; what does not get there goes on with the
 * next one (`isOnItsWay`).
 */
import { invertAffine, setIdentity } from '../../../math/mat4.ts';
import { subtract, type Vec3 } from '../../../math/vec3.ts';
import type { Character } from '../../../model/document.ts';
import type { DofValue } from '../../../model/dofs.ts';
import type { Skeleton } from '../../../model/skeleton.ts';
import { compileSkeleton } from '../../kinematics.ts';
import { type DragTarget, ikOf, type PinTarget, pointAt } from '../set-up.ts';
import { changedValues } from './changed-values.ts';
import { HandProblem, IS_THERE } from './hand-problem.ts';
import { gapCause, type Hindrance } from './hindrance.ts';
import { Homing } from './homing.ts';
import { LockTrial } from './lock-trial.ts';
import { Shaking } from './shaking.ts';

/** Part of the reach. */
const LONGEST_STEP = 0.15;
/** Steps of one move: past these it is a jump, and what leads there is coarser. */
const MAX_STEPS = 8;
/** Iterations of a frame. One takes some 20 µs for a wasp on six feet. */
const MAX_ITERATIONS = 96;
/** Of one solution, at most: see `solve`. */
const ONE_SOLUTION = 24;
/** What shaking a pose takes, at least. */
const TO_SHAKE = 2 * ONE_SOLUTION;
/** A pose moves at most so far in a frame, and so much further for each reach that the hand moves: radians, reaches. */
const CALM = 0.08;
const FOLLOWS = 5;
/** Times that, where it takes as much to put the pins in order. */
const MORE_FOR_PINS = 2;
/** A settled pose that is nearer than that to the one that was dragged is taken: radians, factors, parts of the reach. */
const NO_JUMP = 0.01;
/** A gap that one sees: part of the reach. */
const SEEN_GAP = 0.01;
/** Frames that the release makes up for, where the hand was too fast for the last ones. */
const CATCH_UP = 8;

/** A pin, or what was dragged, that is not where it should be. */
export interface Gap {
  /** Into the setup's pins; as many as they are for a point that was no pin. */
  readonly index: number;
  readonly joint: number;
  /** In the space of the world matrices. */
  readonly from: Vec3;
  readonly to: Vec3;
}

const OWN_SPACE = new Float64Array(16);
setIdentity(OWN_SPACE);

/** What is taken hold of. */
export interface Grip {
  readonly joint: number;
  /** In the joint's space. */
  readonly point: Vec3;
  /** The id of the pin that it is; absent for a point that nothing holds otherwise. */
  readonly pin?: number;
}

/** A pose as it is shown. */
interface ShownPose {
  /** The character's DOFs. */
  readonly dofs: Float64Array;
  /** As of `worldMatrices`. */
  readonly world: Float64Array;
}

export class Pull {
  private place: Vec3;
  private readonly of: HandProblem;
  private readonly shaking: Shaking;
  private readonly homing: Homing;
  private readonly locks: LockTrial;
  private readonly start: Float64Array;
  private readonly toOwn = new Float64Array(16);
  /** Where the hand is in the character's space, and the pose at the beginning of a frame. */
  private readonly goal: Float64Array;
  private readonly before: Float64Array;
  private isCalmed = false;
  private shakingWaits = false;
  private readonly rootStays: boolean;

  /**
   * @param shown where the drag begins; copied
   * @param held where the pins hold, by id, in the character's space
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
    // Where it is, not where an earlier drag wanted it: it is there that the hand has taken it.
    const before = pin === undefined ? undefined : held.get(pin);
    if (before && pin !== undefined) targets.set(pin, { ...before, position: own });
    const dragged: DragTarget = pin === undefined ? { joint, point, target: own } : { pin };
    this.of = new HandProblem(character, skeleton, dofs, targets, dragged);
    this.shaking = new Shaking(this.of);
    this.homing = new Homing(this.of);
    this.locks = new LockTrial(this.of);
    this.goal = this.of.hand.slice();
    this.before = this.of.dofs.slice();
  }

  /** The character's DOFs as the drag has them now. */
  get dofs(): Float64Array {
    return this.of.dofs;
  }

  get reach(): number {
    return this.of.reach;
  }

  /** What keeps the points from where they should be. */
  get hindrance(): Hindrance {
    const { of, rootStays } = this;
    const { slots, pins } = of.problem;
    const holders = of.holders().map((p) => slots.joint[pins.slot[p]]);
    return { binding: this.binding(), holders, locks: this.locks.inTheWay(), canMove: of.canMove, rootStays };
  }

  /** Where the hand is, in the world: at first where the point was. Perhaps the pose is still on its way there. */
  get hand(): Vec3 {
    return this.place;
  }

  /** What the drag has changed since it began, of what can be set. */
  get changes(): DofValue[] {
    return changedValues(this.of.skeleton, this.start, this.dofs);
  }

  /** The hand has gone there, in the world; `dofs` follow. What is not finite is nowhere. */
  to(hand: Vec3): void {
    const own = pointAt(this.toOwn, 0, hand);
    if (!own.every(Number.isFinite)) return;
    this.place = hand;
    this.goal.set(own);
    this.frame();
  }

  /** One more frame of a pose that is on its way to where the hand is. */
  goOn(): void {
    this.frame();
  }

  private frame(): void {
    const { of, before, shaking } = this;
    before.set(of.dofs);
    of.left = MAX_ITERATIONS;
    // What had no room in the frame before has it in this one.
    const spare = this.shakingWaits ? TO_SHAKE : 0;
    const way = this.follow(spare);
    this.shakingWaits = false;
    if (of.holds) {
      of.comeToRest(spare);
      if (shaking.isDue) {
        if (of.left >= ONE_SOLUTION) shaking.shake();
        else this.shakingWaits = true;
      }
    }
    this.homing.come(0, !this.isCalmed && !this.isBehind);
    this.calm(CALM + FOLLOWS * (way / of.reach));
  }

  /** Whether the pose is still on its way to where the hand is: ask it to go there again with the next frame. */
  get isOnItsWay(): boolean {
    return this.isCalmed || this.shakingWaits || this.isBehind || this.homing.isOnItsWay;
  }

  /**
   * The release: the last part of the way, where everything is nearly there and nothing jumps by it. What can't be had
   * stays as the hand has left it: a better pose elsewhere would be a jump that nobody asked for.
   */
  settle(): void {
    const { of } = this;
    for (let frame = 0; frame < CATCH_UP && this.isBehind; frame++) this.goOn();
    if (!of.isThere || !of.problem.result.isSolved) return;
    const before = of.dofs.slice();
    of.solve('settle');
    if (of.isThere && of.furthest(before) <= NO_JUMP) return;
    of.dofs.set(before);
    of.solve('drag');
  }

  /** Whether the hand asks for more than a character can give whose root stays. */
  get wantsRoot(): boolean {
    const { of, rootStays } = this;
    if (!rootStays || of.missing <= SEEN_GAP * of.reach) return false;
    return gapCause(this.hindrance) === 'root';
  }

  /** Every pin that is not where it should be. */
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

  /** DOFs of the character that a limit keeps from bringing the pins nearer. */
  binding(): readonly number[] {
    const { binding, bindingCount } = this.of.problem.result;
    return Array.from(binding.subarray(0, bindingCount));
  }

  /** Where the pins hold once the hand lets go, by id: the dragged one where the hand is, reached or not. */
  get held(): ReadonlyMap<number, PinTarget> {
    const { targets, dragged, hand } = this.of;
    const own = 'pin' in dragged ? targets.get(dragged.pin) : undefined;
    if (!own || !('pin' in dragged)) return targets;
    return new Map(targets).set(dragged.pin, { ...own, position: at(hand, 0) });
  }

  /** So far as a way in the world is in the unit of the character itself. */
  inOwnUnit(from: Vec3, to: Vec3): number {
    const { toOwn } = this;
    return Math.hypot(...subtract(pointAt(toOwn, 0, to), pointAt(toOwn, 0, from)));
  }

  /** Whether a frame had no room for all of the hand's way. */
  private get isBehind(): boolean {
    const { hand } = this.of;
    return this.goal.some((v, k) => v !== hand[k]);
  }

  /** In short steps, as far as there is room for them. @returns how far the hand has come */
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
   * Where a leg comes to its full length, the last millimetre of reach may be a body that leans far over. It gets there,
   * but in more than one frame.
   */
  private calm(most: number): void {
    const { of } = this;
    const far = of.furthest(this.before);
    this.isCalmed = far > most;
    if (!this.isCalmed) return;
    this.goBack(most / far);
    // In between the pins are not quite where they hold: they come first.
    of.orderPins();
    // Where a chain is all but straight, that may be as far again; by a hair the pins are not where they hold then.
    const again = of.furthest(this.before);
    if (again <= MORE_FOR_PINS * most) return;
    this.goBack(most / again);
    of.look();
  }

  /** To the pose at the beginning of the frame, but for a part of the way. */
  private goBack(part: number): void {
    const { before } = this;
    const { dofs } = this.of;
    for (let d = 0; d < dofs.length; d++) dofs[d] = before[d] + part * (dofs[d] - before[d]);
  }
}

function at(list: Float64Array, p: number): Vec3 {
  return [list[3 * p], list[3 * p + 1], list[3 * p + 2]];
}
