/**
 * A change to another pose, spread over a few frames: what is shown leads from the old one to the new one, which may
 * follow the hand meanwhile. Pins hold in each frame; the hand is left for as long.
 */
import { quaternionDofs } from '../../../model/joint-types.ts';
import { compileSkeleton } from '../../kinematics.ts';
import type { HandProblem } from './hand-problem.ts';

const FRAMES = 7;

export class Blend {
  /** What is shown while it is on. */
  readonly shown: Float64Array;
  /** From the new pose to the old one. */
  private readonly offset: Float64Array;
  private readonly followed: Float64Array;
  private left = 0;

  constructor(private readonly of: HandProblem) {
    this.shown = of.dofs.slice();
    this.offset = new Float64Array(of.dofs.length);
    this.followed = of.dofs.slice();
  }

  get isOn(): boolean {
    return this.left > 0;
  }

  /** @param before the pose shown so far, with angles within half a turn of the problem's where that is the same pose */
  begin(before: Float64Array): void {
    const { of, offset, shown } = this;
    shown.set(before);
    for (let d = 0; d < offset.length; d++) offset[d] = before[d] - of.dofs[d];
    this.takeNearerSigns(before);
    this.left = FRAMES;
  }

  /** One frame. */
  step(): void {
    const { of, offset, shown, followed } = this;
    if (this.left === 0) return;
    this.left--;
    if (this.left === 0) return;
    const x = this.left / FRAMES;
    const part = x * x * (3 - 2 * x);
    for (let d = 0; d < offset.length; d++) shown[d] = of.dofs[d] + part * offset[d];
    if (!of.holds) return;
    followed.set(of.dofs);
    of.dofs.set(shown);
    of.orderPins();
    shown.set(of.dofs);
    of.dofs.set(followed);
    of.forget();
    of.look();
  }

  stop(): void {
    this.left = 0;
  }

  /** q and −q are the same rotation, but have no rotation between them. */
  private takeNearerSigns(before: Float64Array): void {
    const { of, offset } = this;
    const { firstDof } = compileSkeleton(of.skeleton);
    of.skeleton.joints.forEach(({ motion }, j) => {
      const parts = quaternionDofs(motion).map((d) => firstDof[j] + d);
      if (parts.reduce((sum, d) => sum + before[d] * of.dofs[d], 0) >= 0) return;
      for (const d of parts) offset[d] = -before[d] - of.dofs[d];
    });
  }
}
