import { describe, expect, it } from 'vitest';
import { setDofs } from '../../../../src/edit/commands/pose.ts';
import { HandProblem } from '../../../../src/evaluate/ik/drag/hand-problem.ts';
import { provideRetargeting } from '../../../../src/evaluate/retarget/driving.ts';
import type { Driver } from '../../../../src/model/document.ts';
import { DEFAULT_RETARGET } from '../../../../src/model/takes/retarget.ts';
import { tellFollows } from '../../../../src/ui/editors/posing/tell-follows.ts';
import { leaveRefusalsBehind } from '../../../../src/ui/shell/stale-messages.ts';
import { character, documentOf, skeleton, take, workbench } from '../../builders.ts';

provideRetargeting();

const BODY = skeleton(['root', -1], ['arm', 0], ['hand', 1], ['tail', 0]);
/** x rotation of joints; all have three DOFs. */
const [ARM, HAND, TAIL] = [6, 9, 12];

const driver: Driver = {
  sourceId: 's',
  source: {
    name: 'dancer',
    skeleton: BODY,
    take: take([0, 1]),
    pose: [],
    clampsToLimits: true,
    timeOffsetSeconds: 0,
  },
  pairs: [
    { target: 0, source: 0 },
    { target: 1, source: 1 },
  ],
  options: DEFAULT_RETARGET,
};
const puppet = () => character({ name: 'walker', skeleton: BODY, driver });

describe('posing what another take moves', () => {
  it('posing a retargeted character is reported once, and stays reported after the drag', () => {
    const { wb } = workbench(documentOf(puppet()));
    const stop = leaveRefusalsBehind(wb);
    const [own] = wb.store.document.characters;
    tellFollows(wb, own, [TAIL]);
    expect(wb.messages.passing.get()).toBeUndefined();
    const gesture = wb.store.begin('Drag');
    const args = { characterId: own.id, dofs: [{ index: ARM, value: 0.3 }], timeSeconds: 0 };
    gesture.preview(setDofs.run(gesture.base, args));
    tellFollows(wb, own, [ARM]);
    gesture.commit();
    expect(wb.messages.passing.get()).toBe('walker is retargeted from dancer. Bake it to keep your pose.');
    wb.messages.passing.set(undefined);
    tellFollows(wb, own, [ARM]);
    expect(wb.messages.passing.get()).toBeUndefined();
    stop();
  });

  it('posing a character that is not retargeted is not reported', () => {
    const own = character({ skeleton: BODY });
    const { wb } = workbench(documentOf(own));
    tellFollows(wb, own, [ARM]);
    expect(wb.messages.passing.get()).toBeUndefined();
  });

  it('bends only the dragged joint of those that the take does not drive', () => {
    const own = puppet();
    const free = (joint: number) => {
      const dragged = { joint, point: [0, 1, 0], target: [0, 0, 0] } as const;
      const { variables } = new HandProblem(own, BODY, own.pose, new Map(), dragged).problem;
      return [ARM, HAND, TAIL].map((dof) => [...variables.dof.subarray(0, variables.count)].includes(dof));
    };
    expect(free(1)).toEqual([true, false, false]);
    expect(free(2)).toEqual([true, true, false]);
    expect(free(3)).toEqual([false, false, true]);
  });
});
