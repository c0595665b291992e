import { type DrivenPose, provideDrivenPose } from '../driven-pose.ts';
import { retargetPlan } from './make-plan.ts';
import { retargetPose } from './retarget-pose.ts';

const retargetedPose: DrivenPose = (character, driver, skeleton, timeSeconds, out) => {
  const plan = retargetPlan(driver, character, skeleton);
  for (let d = 0; d < plan.restDofs.length; d++) out[d] = character.pose[d] ?? 0;
  retargetPose(plan, timeSeconds + character.timeOffsetSeconds + driver.source.timeOffsetSeconds, out);
};

/**
 * Passes retargeting on (`../driven-pose.ts`): for code that makes drivers, or that is given characters which may have
 * some.
 */
export function provideRetargeting(): void {
  provideDrivenPose(retargetedPose);
}
