/**
 * The hand's position determines the pose: of all poses that satisfy the pins and the hand, the one nearest to the pose
 * at the start of the drag. So moving the hand away and back restores the pose, whatever flipped on the way; without
 * this each frame would start from the last, and a twist from a far pull would remain.
 *
 * Each frame moves the pose towards its start as far as the pins allow (`evaluate/ik/homing.ts`) and restores the pins;
 * a step that brings it no nearer, or loses a pin, is undone.
 */
import { characterDofs } from '../../../model/dofs.ts';
import { pitchOf } from '../../../model/joint-types.ts';
import { isUnlimited } from '../../../model/skeleton.ts';
import { stepHome, writeWayHome } from '../homing.ts';
import { type HandProblem, IS_THERE } from './hand-problem.ts';

/** Steps per frame, and the maximum size of each: radians, factors, fractions of the reach. */
const MAX_STEPS = 4;
const LONGEST_STEP = 0.12;
/** Below this distance the pose counts as home. */
const IS_HOME = 1e-3;
/** The fraction of a step that must remain after the pins are restored; else it counts as none. */
const MIN_FRACTION = 0.1;
/**
 * A hand out of reach pulls the pose back by as much as each step gains, forever. After this many frames that gain less
 * than this fraction of the distance, the pose is as near as it can come.
 */
const MAX_FUTILE_STEPS = 3;
const MIN_GAIN = 1e-3;
/** Iterations charged for a step, besides those that restore the pins. */
const COST = 1;

/** Radians short of a whole turn from which an angle is taken on to it rather than back. */
const NEARLY_ROUND = 1;
const TURN = 2 * Math.PI;

export class Homing {
  private readonly start: Float64Array;
  /** `start`, with whole turns added to angles that have gone round: the same pose. */
  private readonly home: Float64Array;
  private readonly turning: readonly number[];
  private readonly tried: Float64Array;
  /** Whether the frame's budget ended before the pose was home. */
  isOnItsWay = false;
  /**
   * The last hand position, the pose's smallest distance from home since, and the number of frames without progress.
   */
  private readonly hand = new Float64Array(3).fill(Number.NaN);
  private nearest = Infinity;
  private inVain = 0;
  /** Factor of the step size, halved after a step that was too large. */
  private boldness = 1;

  /** Home is the current pose. */
  constructor(private readonly of: HandProblem) {
    this.start = of.dofs.slice();
    this.home = this.start.slice();
    this.turning = turningDofs(of);
    this.tried = of.dofs.slice();
  }

  /**
   * @param spare iterations to keep in reserve
   * @param isHere whether the pose has reached the hand; until then it may move away from home
   */
  come(spare: number, isHere: boolean): void {
    this.isOnItsWay = false;
    this.lookAtHand();
    this.countTurns();
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
    // Targets out of reach take many iterations each: one step per frame.
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
      stepHome(of.problem, of.dofs, part);
      of.solve('drag');
      const isWorse = of.worstPin > Math.max(missed, IS_THERE * of.reach) + 1e-12;
      const hasLost = of.missing > Math.max(missing * (1 + 1e-3), IS_THERE * of.reach);
      // Stops steps that restoring the pins undoes; they would repeat forever without progress.
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

  /** An angle that has all but gone round is taken on to the whole turn: going back would take it all the way round again. */
  private countTurns(): void {
    const { start, home, turning } = this;
    for (const dof of turning) {
      const turned = this.of.dofs[dof] - start[dof];
      home[dof] = start[dof] + TURN * Math.trunc((turned + Math.sign(turned) * NEARLY_ROUND) / TURN);
    }
  }

  /** Starts over if the hand has moved. */
  private lookAtHand(): void {
    const { hand } = this.of;
    if (hand.every((v, k) => v === this.hand[k])) return;
    this.hand.set(hand);
    this.nearest = Infinity;
    this.inVain = 0;
  }

  /** How far the pose is from home: radians, factors, fractions of the reach. */
  get furthest(): number {
    return this.of.furthest(this.home);
  }

  /** Removes from a pose the whole turns by which it differs from the current one. */
  unwind(pose: Float64Array): void {
    for (const dof of this.turning) pose[dof] -= TURN * Math.round((pose[dof] - this.of.dofs[dof]) / TURN);
  }

  /** Squared distance of the pose from home, in solver variables. */
  distance(): number {
    const { count, dof, scale } = this.of.problem.variables;
    let sum = 0;
    for (let v = 0; v < count; v++) sum += ((this.of.dofs[dof[v]] - this.home[dof[v]]) / scale[v]) ** 2;
    return sum;
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
