/**
 * Where the hand is says where the pose is: of all poses that have the pins and the hand where they are, the one nearest
 * to that in which the drag began. So a hand that goes out and comes back finds the pose as it was, whatever has turned
 * over on the way; without it each frame starts from the last one, and what a far pull has twisted stays so.
 *
 * In each frame the pose goes a part of the way that the pins leave free (`evaluate/ik/homing.ts`), they are put right,
 * and what is no nearer then, or has lost a pin, is undone.
 */
import { goHome, writeWayHome } from '../homing.ts';
import { type HandProblem, IS_THERE } from './hand-problem.ts';

/** Steps of a frame, each of so much at most: radians, factors, parts of the reach. */
const MAX_STEPS = 4;
const LONGEST_STEP = 0.12;
/** A way that is shorter than that is no way. */
const IS_HOME = 1e-3;
/** What of a step is left at least, once the pins are put right; less is none. */
const MIN_FRACTION = 0.1;
/**
 * A hand out of reach draws the pose back by as much as it has gone, for ever: after so many frames that gained less than
 * so much of the distance it has come as near as it can.
 */
const MAX_FUTILE_STEPS = 3;
const MIN_GAIN = 1e-3;
/** What of the iterations of a frame a step is counted as, beside those that put the pins right. */
const COST = 1;

export class Homing {
  private readonly home: Float64Array;
  private readonly tried: Float64Array;
  /** Whether there is more of the way than a frame has had room for. */
  isOnItsWay = false;
  /** Where the hand was, how near the pose has come to home since it is there, and frames that brought it no nearer. */
  private readonly hand = new Float64Array(3).fill(Number.NaN);
  private nearest = Infinity;
  private inVain = 0;
  /** What a step may be: halved where it was too bold. */
  private boldness = 1;

  /** Home is the pose as it is now. */
  constructor(private readonly of: HandProblem) {
    this.home = of.dofs.slice();
    this.tried = of.dofs.slice();
  }

  /**
   * @param spare iterations that are left alone
   * @param isHere whether the pose has come to where the hand is: until then it may well go further from home
   */
  come(spare: number, isHere: boolean): void {
    this.isOnItsWay = false;
    this.lookAtHand();
    if (this.inVain >= MAX_FUTILE_STEPS) return;
    this.goOn(spare);
    if (!this.isOnItsWay) return;
    const now = this.distance();
    this.inVain = isHere && now > this.nearest * (1 - MIN_GAIN) ? this.inVain + 1 : 0;
    this.nearest = isHere ? Math.min(now, this.nearest) : Infinity;
    if (this.inVain >= MAX_FUTILE_STEPS) this.isOnItsWay = false;
  }

  private goOn(spare: number): void {
    const { of, home, tried } = this;
    // What is out of reach takes many iterations each time: one step in a frame.
    const most = of.missing > IS_THERE * of.reach ? 1 : MAX_STEPS;
    for (let s = 0; s < most && of.left > spare; s++) {
      const way = writeWayHome(of.problem, of.dofs, home);
      of.left -= COST;
      if (way < IS_HOME) return;
      const part = this.boldness * Math.min(1, LONGEST_STEP / way);
      if (part * way < IS_HOME) return;
      const missed = of.worstPin;
      const missing = of.missing;
      const far = this.distance();
      tried.set(of.dofs);
      goHome(of.problem, of.dofs, part);
      of.solve('drag');
      const isWorse = of.worstPin > Math.max(missed, IS_THERE * of.reach) + 1e-12;
      const hasLost = of.missing > Math.max(missing * (1 + 1e-3), IS_THERE * of.reach);
      // What is put right by going back again would go on for ever, and nowhere.
      const isNowhere = of.furthest(tried) < MIN_FRACTION * part * way || this.distance() > far * (1 - 1e-6);
      if (isWorse || hasLost || isNowhere) {
        of.dofs.set(tried);
        of.solve('drag');
        this.boldness *= 0.5;
        if (this.boldness < 1 / 64) {
          this.boldness = 1 / 8;
          return;
        }
      } else this.boldness = Math.min(1, 1.5 * this.boldness);
      this.isOnItsWay = true;
    }
  }

  /** Another place of the hand is another try. */
  private lookAtHand(): void {
    const { hand } = this.of;
    if (hand.every((v, k) => v === this.hand[k])) return;
    this.hand.set(hand);
    this.nearest = Infinity;
    this.inVain = 0;
  }

  /** Of the pose from home, squared, in unknowns. */
  private distance(): number {
    const { count, dof, scale } = this.of.problem.variables;
    let sum = 0;
    for (let v = 0; v < count; v++) sum += ((this.of.dofs[dof[v]] - this.home[dof[v]]) / scale[v]) ** 2;
    return sum;
  }
}
