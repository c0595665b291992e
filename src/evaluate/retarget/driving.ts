/** Provides the code for `driven-pose.ts`; imported for its side effect by code that adds a driver to a document. */
import { provideDrivenPose } from '../driven-pose.ts';
import { retargetPlan } from './make-plan.ts';
import { retargetPose } from './retarget-pose.ts';

provideDrivenPose((character, driver, skeleton, timeSeconds, out) => {
  const plan = retargetPlan(driver, character, skeleton);
  for (let d = 0; d < plan.restDofs.length; d++) out[d] = character.pose[d] ?? 0;
  retargetPose(plan, timeSeconds + character.timeOffsetSeconds + driver.source.timeOffsetSeconds, out);
});
