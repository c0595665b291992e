/**
 * The shown pose of a drag: the one for the hand, unless that is far from the last one. An arm that bends to its other
 * side, or a leg whose last millimetre needs the body to lean over, would jump; while the hand moves, the shown pose
 * then follows in bounded steps, with the pins held and the hand left for as long. Nothing may move under a hand that
 * is still, so that the rest takes two frames.
 */
import { characterDofs } from '../../../model/skeleton/dofs.ts';
import { pitchOf, quaternionDofs } from '../../../model/skeleton/joint-types.ts';
import { isUnlimited } from '../../../model/skeleton/skeleton.ts';
import { compileSkeleton } from '../../kinematics.ts';
import type { HandProblem } from './hand-problem.ts';

/** Multiplies the limit of a step if restoring the pins needs it. */
const MORE_FOR_PINS = 2;
const TURN = 2 * Math.PI;

/** The shown pose of one drag, which follows the solved one in bounded steps. */
export class Blend {
  /** The character's DOFs as shown. */
  readonly shown: Float64Array;
  /** Whether the shown pose has not reached the one for the hand. */
  isOn = false;
  private readonly before: Float64Array;
  private readonly turning: readonly number[];
  private readonly quaternions: readonly (readonly number[])[];
  private between: HandProblem | undefined;
  private stillFrames = 0;

  constructor(private readonly of: HandProblem) {
    const { skeleton } = of;
    const { firstDof } = compileSkeleton(skeleton);
    this.shown = of.dofs.slice();
    this.before = of.dofs.slice();
    this.turning = turningDofs(of);
    this.quaternions = skeleton.joints.flatMap(({ motion }, j) => {
      const dofs = quaternionDofs(motion).map((d) => firstDof[j] + d);
      return dofs.length ? [dofs] : [];
    });
  }

  /** A frame of a hand that has moved. @param most how far the shown pose may move: radians, factors, reaches */
  follow(most: number): void {
    this.stillFrames = 0;
    this.unwind();
    const far = this.of.furthest(this.shown);
    this.isOn = far > most;
    if (this.isOn) this.approach(most / far, most);
    else this.shown.set(this.of.dofs);
  }

  /** A frame of a hand that is still. */
  finish(): void {
    this.stillFrames++;
    this.isOn = this.isOn && this.stillFrames === 1;
    if (this.isOn) this.approach(0.5, Infinity);
    else this.shown.set(this.of.dofs);
  }

  /** The shown pose is the one for the hand from now on. */
  stop(): void {
    const { of, shown } = this;
    if (!this.isOn) return;
    this.isOn = false;
    of.dofs.set(shown);
    of.forget();
    of.look();
  }

  private approach(part: number, most: number): void {
    const { of, shown, before } = this;
    before.set(shown);
    this.goOn(part);
    if (!of.holds) return;
    this.between ??= of.from(shown);
    const { between } = this;
    between.dofs.set(shown);
    between.moveHand(of.hand[0], of.hand[1], of.hand[2]);
    between.turnAxis = of.turnAxis;
    between.turnHand(of.turned);
    between.forget();
    between.look();
    // In between, the pins are slightly off.
    between.orderPins();
    // For an almost straight chain this may move as far again; then pins that are off by a hair are accepted.
    if (between.furthest(before) <= MORE_FOR_PINS * most) shown.set(between.dofs);
  }

  private goOn(part: number): void {
    const { of, shown } = this;
    for (let d = 0; d < shown.length; d++) shown[d] += part * (of.dofs[d] - shown[d]);
  }

  /** Whole turns, and the two signs of a quaternion, are the same pose: there is nothing to blend between them. */
  private unwind(): void {
    const { of, shown } = this;
    for (const dof of this.turning) shown[dof] -= TURN * Math.round((shown[dof] - of.dofs[dof]) / TURN);
    for (const dofs of this.quaternions) {
      let along = 0;
      for (const d of dofs) along += shown[d] * of.dofs[d];
      if (along < 0) for (const d of dofs) shown[d] = -shown[d];
    }
  }
}

/** The unknowns that give the same pose after a whole turn: unlimited angles that nothing follows. */
function turningDofs({ skeleton, problem }: HandProblem): number[] {
  const { count, dof, lower, upper, followers } = problem.variables;
  const all = characterDofs(skeleton, []);
  const followed = new Set(followers.follows);
  return Array.from(dof.subarray(0, count)).filter((d, v) => {
    const { unit, joint } = all[d];
    const isFree = isUnlimited({ min: lower[v], max: upper[v] }) && !followed.has(d);
    return unit === 'angle' && isFree && pitchOf(skeleton.joints[joint].motion) === 0;
  });
}
