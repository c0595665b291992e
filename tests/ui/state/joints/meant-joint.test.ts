import { expect, it } from 'vitest';
import { meantJoint } from '../../../../src/ui/state/joints/meant-joint.ts';
import { skeleton } from '../../builders.ts';

it('a click means the part that was hit of what is lit up, and what is lit up where something else was hit', () => {
  const leg = skeleton(['hips', -1], ['shin', 0], ['foot', 1], ['toe', 2], ['tail', 0]);
  const [HIPS, SHIN, FOOT, TOE, TAIL] = leg.joints.keys();
  expect(meantJoint(leg, FOOT, TOE)).toBe(TOE);
  expect(meantJoint(leg, FOOT, FOOT)).toBe(FOOT);
  for (const hit of [HIPS, SHIN, TAIL]) expect(meantJoint(leg, FOOT, hit)).toBe(FOOT);
});
