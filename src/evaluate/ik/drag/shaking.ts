/**
 * Straight legs don't bend when a hip is pushed down on pinned feet: to first order their length does not change. So
 * the whole pose is bent a little in either direction, and the result is kept if it helps. The solver does this for a
 * single chain; here the dragged point could move if it weren't for the pins.
 */
import type { HandProblem } from './hand-problem.ts';

/** The gap that triggers an attempt: fraction of the reach. */
const STUCK = 0.004;
/** How far everything is bent: radians, fractions of the reach. */
const SHAKE = 0.02;
/** The attempt helped if the gap shrinks to this fraction. */
const HELPS = 0.8;

/** Bends a straight pose to either side if that lets the dragged point come nearer. */
export class Shaking {
  private readonly stuck: Float64Array;
  private readonly helped: Float64Array;

  constructor(private readonly of: HandProblem) {
    this.stuck = new Float64Array(of.dofs.length);
    this.helped = new Float64Array(of.dofs.length);
  }

  /** Whether the pose is stuck, and pins may be the cause. */
  get isDue(): boolean {
    const { of } = this;
    return of.holds && of.missing > STUCK * of.reach;
  }

  /** Within the problem's iterations. */
  shake(): void {
    const { of, stuck, helped } = this;
    const { dofs } = of;
    const { count, dof, scale, lower, upper } = of.problem.variables;
    stuck.set(dofs);
    let least = HELPS * of.missing;
    let helps = false;
    // Both directions get the same share of the budget.
    const half = of.left / 2;
    for (const way of [1, -1]) {
      dofs.set(stuck);
      for (let v = 0; v < count; v++) {
        const bent = dofs[dof[v]] + way * SHAKE * scale[v];
        dofs[dof[v]] = Math.min(upper[v], Math.max(lower[v], bent));
      }
      of.solve('drag');
      of.solveToRest(way === 1 ? half : 0);
      if (of.missing >= least) continue;
      least = of.missing;
      helped.set(dofs);
      helps = true;
    }
    dofs.set(helps ? helped : stuck);
    of.solve('drag');
  }
}
