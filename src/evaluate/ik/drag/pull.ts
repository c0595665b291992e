/**
 * The policy of one drag: takes positions of the hand and returns poses. Owns the hand's position in the world and the
 * pose at its start; not the pointer, the document and its undo step (`ui/editors/ik/hand-pull.ts`), the pose for a
 * position (`Lead`), what is shown of it (`Blend`), nor the solver (`HandProblem`). Independent of the page.
 */
import { determinant3, invertAffine, setIdentity } from '../../../math/mat4.ts';
import { subtract, transformVector, unit, type Vec3 } from '../../../math/vec3.ts';
import type { Character } from '../../../model/document.ts';
import type { Pin } from '../../../model/ik.ts';
import type { DofValue } from '../../../model/skeleton/dofs.ts';
import type { Skeleton } from '../../../model/skeleton/skeleton.ts';
import { compileSkeleton } from '../../kinematics.ts';
import { type DragTarget, ikOf, type PinTarget, pinTargets, pointAt } from '../set-up.ts';
import { Blend } from './blend.ts';
import { changedValues } from './changed-values.ts';
import { type DragReach, holding, WHOLE } from './drag-reach.ts';
import { HandProblem, IS_THERE, TURN_WAY } from './hand-problem.ts';
import { gapCause, type Hindrance } from './hindrance.ts';
import { Lead } from './lead.ts';
import { LockTrial } from './lock-trial.ts';

/** The most the shown pose moves in a frame, plus this much per reach that the hand moves: radians, reaches. */
const CALM = 0.1;
const FOLLOWS = 5;
/** A visible gap: fraction of the reach. */
const SEEN_GAP = 0.01;

/** A pin or dragged point that is not at its target. */
export interface Gap {
  /** Index into the setup's pins, then of those for this drag alone; their number for a point that is no pin. */
  readonly index: number;
  readonly joint: number;
  /** In the space of the world matrices. */
  readonly from: Vec3;
  readonly to: Vec3;
}

const OWN_SPACE = new Float64Array(16);
setIdentity(OWN_SPACE);

/** The point that is dragged. */
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

/** One IK drag from press to release: positions of the hand in, poses out. */
export class Pull {
  /** Feet that hold by themselves while the drag lasts. */
  readonly standing: readonly Pin[];
  private place: Vec3;
  private readonly of: HandProblem;
  private readonly lead: Lead;
  private readonly blend: Blend;
  private readonly locks: LockTrial;
  private readonly start: Float64Array;
  private readonly toOwn = new Float64Array(16);
  private readonly rootStays: boolean;

  /**
   * @param shown the pose at the start of the drag; copied
   * @param held targets of the pins, by id, in the character's space
   * @param placement from the character's space to the world's, not singular; copied
   * @param reach what moves
   */
  constructor(
    character: Character,
    skeleton: Skeleton,
    { dofs, world }: ShownPose,
    held: ReadonlyMap<number, PinTarget>,
    { joint, point, pin }: Grip,
    placement: Float64Array = OWN_SPACE,
    { bending, standing }: DragReach = WHOLE,
  ) {
    const ik = ikOf(character);
    this.standing = standing;
    const couldTravel = bending === 'body' && compileSkeleton(skeleton).travel.some((dof) => dof >= 0);
    this.rootStays = !ik.rootIsFree && couldTravel;
    this.start = dofs.slice();
    invertAffine(placement, 0, this.toOwn, 0);
    const own = pointAt(world, joint, point);
    this.place = pointAt(placement, 0, own);
    const targets = new Map([...held, ...pinTargets({ pins: standing }, world)]);
    // At its position, not at the target of an earlier drag, since that is where it was grabbed.
    const before = pin === undefined ? undefined : held.get(pin);
    if (before && pin !== undefined) targets.set(pin, { ...before, position: own });
    const dragged: DragTarget = pin === undefined ? { joint, point, target: own } : { pin };
    this.of = new HandProblem(holding(character, standing), skeleton, dofs, targets, dragged, bending);
    this.lead = new Lead(this.of);
    this.blend = new Blend(this.of);
    this.locks = new LockTrial(this.of);
  }

  /** The character's DOFs at this point of the drag. */
  get dofs(): Float64Array {
    return this.blend.shown;
  }

  /** The longest path along the bones from the root to a joint or a pin, in lengths; the scale of all tolerances. */
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

  /** The hand's position in the world, initially that of the point. The pose may still be approaching it. */
  get hand(): Vec3 {
    return this.place;
  }

  /** The settable DOFs that the drag has changed. */
  get changes(): DofValue[] {
    return changedValues(this.of.skeleton, this.start, this.dofs);
  }

  /** Moves the hand, in the world; `dofs` follow. Ignores positions that are not finite. */
  to(hand: Vec3): void {
    this.aim(hand, this.of.turned);
  }

  /**
   * Turns a pin that holds its orientation, from how it was at the start of the drag; `dofs` follow.
   * @param axis of unit length, in the world; the same in all calls
   * @param angle radians
   */
  turn(axis: Vec3, angle: number): void {
    const { of, toOwn } = this;
    of.turnAxis ??= unit(transformVector(toOwn, axis));
    if (Number.isFinite(angle)) this.aim(this.place, determinant3(toOwn) < 0 ? -angle : angle);
  }

  private aim(hand: Vec3, angle: number): void {
    const { of } = this;
    const [x, y, z] = pointAt(this.toOwn, 0, hand);
    if (!Number.isFinite(x + y + z)) return;
    this.place = hand;
    const moved = Math.hypot(x - of.hand[0], y - of.hand[1], z - of.hand[2]);
    const way = moved + TURN_WAY * of.reach * Math.abs(angle - of.turned);
    if (way === 0) {
      this.goOn();
      return;
    }
    this.lead.to(x, y, z, angle);
    this.blend.follow(CALM + FOLLOWS * (way / of.reach));
  }

  /** Another frame of a hand that is still. */
  goOn(): void {
    this.blend.finish();
  }

  /** Whether the shown pose still moves without the hand: for up to two frames of `goOn`. */
  get isOnItsWay(): boolean {
    return this.blend.isOn;
  }

  /** The release: what is shown stays. */
  settle(): void {
    this.blend.stop();
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
    const orientation = this.of.orientationOfHand;
    return new Map(targets).set(dragged.pin, { position: at(hand, 0), ...(orientation && { orientation }) });
  }

  /** A distance in the world, in the character's own unit. */
  inOwnUnit(from: Vec3, to: Vec3): number {
    const { toOwn } = this;
    return Math.hypot(...subtract(pointAt(toOwn, 0, to), pointAt(toOwn, 0, from)));
  }
}

function at(list: Float64Array, p: number): Vec3 {
  return [list[3 * p], list[3 * p + 1], list[3 * p + 2]];
}
