/**
 * Measures foot sliding: while the source's foot is in contact, how far the target's ball moves over the ground from
 * where the contact began; and the same for the source, at the target's size.
 */
import type { RetargetPlan } from './plan.ts';
import { retargetPose } from './retarget-pose.ts';
import { toScene } from './travel.ts';

export interface Sliding {
  /** Metres: the maximum over all contacts. */
  readonly worst: number;
  /** Metres: the maximum per contact, averaged. */
  readonly mean: number;
  /** The same for the source, times the scale. */
  readonly sourceWorst: number;
  readonly sourceMean: number;
  readonly contacts: number;
  /** Height of the joint relative to standing, during contacts: minimum and maximum. Metres. */
  readonly lowest: number;
  readonly highest: number;
}

/** Samples per second. */
const RATE = 60;

/** @param mostContacts limit per foot, from the start: long takes have thousands */
export function measureSliding(plan: RetargetPlan, mostContacts = Infinity): Sliding {
  const out = Float64Array.from(plan.restDofs);
  const own = new Float64Array(3);
  const other = new Float64Array(3);
  const slides: number[] = [];
  const sourceSlides: number[] = [];
  let lowest = 0;
  let highest = 0;
  for (const foot of plan.feet) {
    for (let c = 0; c < Math.min(foot.contacts.length, 2 * mostContacts); c += 2) {
      const [from, to] = [foot.contacts[c], foot.contacts[c + 1]];
      const count = Math.max(2, Math.round((to - from) * RATE) + 1);
      let [ownX, ownZ, otherX, otherZ] = [0, 0, 0, 0];
      let slid = 0;
      let sourceSlid = 0;
      for (let i = 0; i < count; i++) {
        retargetPose(plan, from + ((to - from) * i) / (count - 1), out);
        for (let k = 0; k < 3; k++) {
          own[k] = plan.targetWorld[16 * foot.ball + 12 + k];
          other[k] = plan.sourceWorld[16 * foot.sourceBall + 12 + k];
        }
        toScene(plan.targetSpace, own);
        toScene(plan.sourceSpace, other);
        if (i === 0) [ownX, ownZ, otherX, otherZ] = [own[0], own[2], other[0], other[2]];
        slid = Math.max(slid, Math.hypot(own[0] - ownX, own[2] - ownZ));
        sourceSlid = Math.max(sourceSlid, plan.scale * Math.hypot(other[0] - otherX, other[2] - otherZ));
        lowest = Math.min(lowest, own[1] - foot.ownHeight);
        highest = Math.max(highest, own[1] - foot.ownHeight);
      }
      slides.push(slid);
      sourceSlides.push(sourceSlid);
    }
  }
  const mean = (values: readonly number[]) => values.reduce((a, b) => a + b, 0) / Math.max(1, values.length);
  return {
    worst: Math.max(0, ...slides),
    mean: mean(slides),
    sourceWorst: Math.max(0, ...sourceSlides),
    sourceMean: mean(sourceSlides),
    contacts: slides.length,
    lowest,
    highest,
  };
}
