/**
 * Legs that are straight don't bend when a hip is pushed down on feet that hold: at first it changes their length by
 * nothing. So all is bent a little, one way and the other, and what comes of it is kept where it helps. The solver does
 * as much for one chain; here what is dragged could move, were it not for the pins. Asked again only after the hand has
 * gone on, and soon enough that little has been missed by then.
 */
import type { HandProblem } from './hand-problem.ts';

/** A gap that is worth a try, and how far the hand goes between two: parts of the reach. */
const STUCK = 0.004;
/** How far everything is bent for it: radians, parts of the reach. */
const SHAKE = 0.02;
/** What is left of the gap where it has helped. */
const HELPS = 0.8;

export class Shaking {
  /** Where the hand was when the pose was last shaken. */
  private readonly shakenAt = new Float64Array(3).fill(Infinity);
  private readonly stuck: Float64Array;
  private readonly helped: Float64Array;

  constructor(private readonly of: HandProblem) {
    this.stuck = new Float64Array(of.dofs.length);
    this.helped = new Float64Array(of.dofs.length);
  }

  /** Whether the pose is stuck, and has not been shaken about here. */
  get isDue(): boolean {
    const { of, shakenAt } = this;
    const { hand, reach } = of;
    if (of.missing <= STUCK * reach) return false;
    const since = Math.hypot(hand[0] - shakenAt[0], hand[1] - shakenAt[1], hand[2] - shakenAt[2]);
    return !(since < STUCK * reach);
  }

  shake(): void {
    const { of, shakenAt, stuck, helped } = this;
    const { dofs } = of;
    const { count, dof, scale, lower, upper } = of.problem.variables;
    shakenAt.set(of.hand);
    stuck.set(dofs);
    let least = HELPS * of.missing;
    let helps = false;
    // Neither way is to have more of what is left than the other.
    const half = of.left / 2;
    for (const way of [1, -1]) {
      dofs.set(stuck);
      for (let v = 0; v < count; v++) {
        const bent = dofs[dof[v]] + way * SHAKE * scale[v];
        dofs[dof[v]] = Math.min(upper[v], Math.max(lower[v], bent));
      }
      of.solve('drag');
      of.comeToRest(way === 1 ? half : 0);
      if (of.missing >= least) continue;
      least = of.missing;
      helped.set(dofs);
      helps = true;
    }
    dofs.set(helps ? helped : stuck);
    of.solve('drag');
  }
}
