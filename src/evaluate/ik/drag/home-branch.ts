/**
 * What homing can't undo: an arm that was pulled straight may have bent to the other side since, and no path from there
 * leads home while the hand stays where it is.
 *
 * So when the hand is still, it is also led to its place from the start of the drag, along a straight line. If that
 * gives a pose nearer to home, the drag continues there. Thus the pose depends on where the hand is rather than on how it
 * got there.
 */
import { type HandProblem, IS_THERE } from './hand-problem.ts';
import type { Homing } from './homing.ts';

/** The largest difference from home that is not worth a look: radians, factors, fractions of the reach. */
const NEAR_HOME = 0.1;
/** The other pose is taken if its squared distance from home is less than this fraction. */
const NEARER = 0.7;
/** Length of a step along the line: fraction of the reach. */
const STEP = 0.1;
const MAX_STEPS = 24;
/** Solves at the end of the line. */
const MAX_TRIES = 3;

export class HomeBranch {
  private readonly start: Float64Array;
  private readonly from: Float64Array;
  /** The hand's position that was looked at last, and whether that is finished. */
  private readonly at = new Float64Array(3).fill(Number.NaN);
  private isDone = false;
  /** The pose on its way along the line, and how many steps it has gone. */
  private readonly led: Float64Array;
  private step = 0;
  private readonly own: Float64Array;

  /** The drag starts at the current pose. */
  constructor(
    private readonly of: HandProblem,
    private readonly homing: Homing,
  ) {
    this.start = of.dofs.slice();
    this.from = of.hand.slice();
    this.led = of.dofs.slice();
    this.own = of.dofs.slice();
  }

  /** Whether there may be a nearer pose for the hand's position. */
  get isDue(): boolean {
    const { of } = this;
    if (this.isDone && this.isSamePlace) return false;
    return of.isThere && this.homing.furthest > NEAR_HOME;
  }

  /**
   * Within the budget of a frame; call it again while it is due.
   * @returns whether the problem's pose is now another one; `before` is then what it was
   */
  look(): boolean {
    const { of, at, led, own } = this;
    if (!this.isSamePlace) {
      at.set(of.hand);
      led.set(this.start);
      this.step = 0;
      this.isDone = false;
    }
    own.set(of.dofs);
    const distance = this.homing.distance();
    of.dofs.set(led);
    of.forget();
    this.lead();
    led.set(of.dofs);
    of.moveHand(at[0], at[1], at[2]);
    if (this.isDone && of.isThere && this.homing.distance() < NEARER * distance) return true;
    of.dofs.set(own);
    of.forget();
    of.look();
    return false;
  }

  /** The pose before `look` has found another one. */
  get before(): Float64Array {
    return this.own;
  }

  private get isSamePlace(): boolean {
    const { hand } = this.of;
    return this.at.every((v, k) => v === hand[k]);
  }

  private lead(): void {
    const { of, from, at } = this;
    const way = Math.hypot(at[0] - from[0], at[1] - from[1], at[2] - from[2]);
    const steps = Math.min(MAX_STEPS, Math.max(1, Math.ceil(way / (STEP * of.reach))));
    while (this.step < steps && of.left > 0) {
      const part = ++this.step / steps;
      of.moveHand(
        from[0] + part * (at[0] - from[0]),
        from[1] + part * (at[1] - from[1]),
        from[2] + part * (at[2] - from[2]),
      );
      of.solve('drag');
    }
    this.isDone = this.step === steps;
    for (let tries = 1; this.isDone && tries < MAX_TRIES && of.missing > 0.1 * IS_THERE * of.reach; tries++)
      of.solve('drag');
  }
}
