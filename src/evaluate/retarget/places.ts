/** Where ankles belong so that balls of feet are where they belong (`contacts.ts`). */
import { offsetAt } from './contacts.ts';
import type { FootTrack, RetargetPlan } from './plan.ts';
import { fromScene, inProportion, toScene } from './travel.ts';

/** Scratch; never escapes. */
const point = new Float64Array(3);
const offset = new Float64Array(3);

/**
 * Writes the way from where a foot is to where it belongs, x y z in the target's own axes and unit, for the pose in the
 * plan's matrices. The foot's rotation must be final.
 * @param rise metres by which it is raised from where the source's stands too low
 */
export function wayOfFoot(plan: RetargetPlan, foot: FootTrack, seconds: number, rise: number, out: Float64Array): void {
  const { sourceWorld, targetWorld } = plan;
  for (let k = 0; k < 3; k++) point[k] = sourceWorld[16 * foot.sourceBall + 12 + k];
  toScene(plan.sourceSpace, point);
  inProportion(plan, point);
  offsetAt(foot, seconds, offset);
  for (let k = 0; k < 3; k++) point[k] += offset[k];
  point[1] += rise;
  fromScene(plan.targetSpace, point);
  for (let k = 0; k < 3; k++) out[k] = point[k] - targetWorld[16 * foot.ball + 12 + k];
}
