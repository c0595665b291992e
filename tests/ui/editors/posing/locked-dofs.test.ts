/** DOFs whose limits are the same. */
import { expect, it } from 'vitest';
import { activeDof, chooseDof, chooseNextDof } from '../../../../src/ui/editors/posing/active-dof.ts';
import { character, documentOf, skeleton, workbench } from '../../builders.ts';

const ARM = skeleton(['shoulder', -1], ['elbow', 0]);
const limits = ARM.joints[1].limits.map((limit, i) => (i === 0 ? { min: 0.1, max: 0.1 } : limit));
const LOCKED = { ...ARM, joints: ARM.joints.map((one, j) => (j === 1 ? { ...one, limits } : one)) };

const selecting = (clampsToLimits: boolean) => {
  const { wb } = workbench(documentOf({ ...character({ skeleton: LOCKED }), clampsToLimits }));
  wb.store.select({ characterId: 'c1', joint: 1 });
  return wb;
};

it('a locked DOF is never active, whichever way it is chosen', () => {
  const wb = selecting(true);
  expect(activeDof(wb)).toBe(7);
  chooseDof(wb, 6);
  expect(activeDof(wb)).toBe(7);
  const next = [1, 2].map(() => {
    chooseNextDof(wb, 1);
    return activeDof(wb);
  });
  expect(next).toEqual([8, 7]);
});

it('a locked DOF is as the others while limits are not enforced', () => {
  const wb = selecting(false);
  expect(activeDof(wb)).toBe(6);
  chooseDof(wb, 7);
  chooseDof(wb, 6);
  expect(activeDof(wb)).toBe(6);
});
