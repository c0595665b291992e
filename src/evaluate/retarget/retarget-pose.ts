/**
 * One pose of the target from one of the source. Nothing is remembered from frame to frame: a pose is a matter of its
 * time alone, so scrubbing, ghosts and baking all see the same.
 *
 *     1. source      its pose at that time, and the world matrices of its joints
 *     2. wanted      T = V · S · K of every joint that follows one (`align.ts`); limbs rolled for their hinges
 *     3. fit         from the root out, each joint's DOFs as near to T as it can turn, given where its parent came to be
 *     4. travel      the middle of the hip joints, in proportion
 *     5. feet        legs bent so that the feet are where the source's are, in proportion (`legs.ts`); 3. again for legs
 */
import { plantFeet } from './legs.ts';
import type { RetargetPlan } from './plan.ts';
import { solveFreely } from './solve.ts';

/**
 * Writes those of the target's DOFs that follow something; the others are read, for what hangs on their joints, and stay
 * as they are. Allocates nothing.
 * @param clipSeconds of the source's clip
 */
export function retargetPose(plan: RetargetPlan, clipSeconds: number, out: Float64Array): void {
  solveFreely(plan, clipSeconds, out);
  if (plan.plantsFeet) plantFeet(plan, clipSeconds, out);
}
