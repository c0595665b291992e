import type { DrivenPose } from '../driven-pose.ts';
import { retargetPlan } from './make-plan.ts';
import { retargetPose } from './retarget-pose.ts';

/** Retargeting, for `driven-pose.ts`: code that adds a driver to a document passes it on. */
export const retargetedPose: DrivenPose = (character, driver, skeleton, timeSeconds, out) => {
  const plan = retargetPlan(driver, character, skeleton);
  for (let d = 0; d < plan.restDofs.length; d++) out[d] = character.pose[d] ?? 0;
  retargetPose(plan, timeSeconds + character.timeOffsetSeconds + driver.source.timeOffsetSeconds, out);
};
