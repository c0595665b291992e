/**
 * Computes a pose of the target from one of the source. There is no state between frames: a pose depends on its time
 * only, so that scrubbing, ghosts and baking agree.
 *
 *     1. source      its pose at that time, and the world matrices of its joints
 *     2. wanted      T = V · S · K for every paired joint (`align.ts`); limbs twisted for their hinges
 *     3. fit         from the root outwards, each joint's DOFs as close to T as possible, given its parent's result
 *     4. travel      the centre of the hip joints, in proportion
 *     5. feet        hips moved and legs bent so that the feet follow the source's, in proportion (`hips.ts`, `legs.ts`);
 *                    step 3 again for legs
 *
 * A copy of the source's skeleton takes the pose as it is, number by number.
 */
import { plantFeet } from './legs.ts';
import type { RetargetPlan } from './plan.ts';
import { solveFreely } from './solve.ts';
import { sourcePose } from './source-pose.ts';

/**
 * Writes the target's paired DOFs; the others are read, since joints below depend on them, and not changed. Allocates
 * nothing.
 * @param takeSeconds of the source's take
 */
export function retargetPose(plan: RetargetPlan, takeSeconds: number, out: Float64Array): void {
  if (plan.isCopy) {
    sourcePose(plan.played, takeSeconds, plan.dofs);
    out.set(plan.dofs);
    return;
  }
  solveFreely(plan, takeSeconds, out);
  if (plan.plantsFeet) plantFeet(plan, takeSeconds, out);
}
