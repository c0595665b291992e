/**
 * The pose, among all that satisfy the pins and the hand, nearest to the pose at the start of the drag. Without it,
 * redundant joints would keep whatever the solver's steps gave them.
 *
 * Each step moves the pose towards its start as far as the pins allow (`evaluate/ik/homing.ts`) and restores the pins;
 * a step that brings it no nearer, or loses a pin, is undone.
 */
import { stepHome, writeWayHome } from '../homing.ts';
import { type HandProblem, IS_THERE } from './hand-problem.ts';

/** The maximum size of a step: radians, factors, fractions of the reach. */
const LONGEST_STEP = 0.12;
/** Below this distance the pose counts as home. */
const IS_HOME = 1e-3;
/** The fraction of a step that must remain after the pins are restored; else it counts as none. */
const MIN_FRACTION = 0.1;
/** A step is halved if it was too large; below this fraction the pose is as near as it can come. */
const MIN_BOLDNESS = 1 / 64;
/** Iterations charged for a step, besides those that restore the pins. */
const COST = 1;

/** Moves the pose of one drag as near to its start as its pins allow. */
export class Homing {
  private readonly home: Float64Array;
  private readonly tried: Float64Array;

  /** Home is the current pose. */
  constructor(private readonly of: HandProblem) {
    this.home = of.dofs.slice();
    this.tried = of.dofs.slice();
  }

  /**
   * Moves the pose towards its start, as far as the pins allow.
   * @param iterations the most it may spend
   */
  come(iterations: number): void {
    const { of, home, tried } = this;
    let boldness = 1;
    of.left = iterations;
    while (of.left > 0 && boldness >= MIN_BOLDNESS) {
      const way = writeWayHome(of.problem, of.dofs, home);
      of.left -= COST;
      const part = boldness * Math.min(1, LONGEST_STEP / way);
      if (way < IS_HOME || part * way < IS_HOME) return;
      const missed = of.worstPin;
      const missing = of.missing;
      const far = this.distance();
      tried.set(of.dofs);
      stepHome(of.problem, of.dofs, part);
      of.solve('drag');
      const isWorse = of.worstPin > Math.max(missed, IS_THERE * of.reach) + 1e-12;
      const hasLost = of.missing > Math.max(missing * (1 + 1e-3), IS_THERE * of.reach);
      // Stops steps that restoring the pins undoes; they would repeat without progress.
      const isNowhere = of.furthest(tried) < MIN_FRACTION * part * way || this.distance() > far * (1 - 1e-6);
      if (isWorse || hasLost || isNowhere) {
        of.dofs.set(tried);
        of.solve('drag');
        boldness *= 0.5;
      } else boldness = Math.min(1, 1.5 * boldness);
    }
  }

  /** Squared distance of the pose from home, in solver variables. */
  private distance(): number {
    const { count, dof, scale } = this.of.problem.variables;
    let sum = 0;
    for (let v = 0; v < count; v++) sum += ((this.of.dofs[dof[v]] - this.home[dof[v]]) / scale[v]) ** 2;
    return sum;
  }
}
