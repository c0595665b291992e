import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import { setDofs } from '../../../../src/edit/commands/pose.ts';
import { besidePins } from '../../../../src/ui/editors/ik/pins-beside.ts';
import { documentOf } from '../../builders.ts';
import { apart, body, FORE_L, HAND_L, HAND_R, ikPage } from './ik-page.ts';

/** Of a body that is 6 wide. */
const THERE = 2e-3;
const [TX, TY, ROOT_RZ] = [0, 1, 5];

let page: ReturnType<typeof ikPage>;
beforeEach(() => {
  page = ikPage();
});
afterEach(() => page.stop());

/** Like the slider of a DOF: successive values in one gesture. */
function slide(dof: number, values: readonly number[]): void {
  const { wb } = page;
  const beside = besidePins(wb, 'c1', [dof]);
  const gesture = wb.store.begin('Slide');
  for (const value of values) {
    const dofs = beside?.at([{ index: dof, value }]) ?? [{ index: dof, value }];
    gesture.preview(setDofs.run(gesture.base, { characterId: 'c1', dofs, timeSeconds: 0 }));
    beside?.shown();
  }
  gesture.commit();
}

const steps = (to: number, count = 20) => Array.from({ length: count }, (_, i) => (to * (i + 1)) / count);
const hands = () => [HAND_L, HAND_R].map((hand) => page.placeOf(hand));

describe('a DOF set while pins hold', () => {
  it('a DOF takes its value, and the pinned points stay', () => {
    for (const [dof, to] of [
      [TX, 0.2],
      [TY, -0.25],
      [ROOT_RZ, 0.2],
    ]) {
      const before = hands();
      slide(dof, steps(to));
      expect(page.pose()[dof]).toBe(to);
      hands().forEach((hand, i) => {
        expect(apart(hand, before[i])).toBeLessThan(THERE);
      });
      page.wb.store.undo();
    }
  });

  it('moving a slider back restores the pose, even from where the pins could not hold', () => {
    const before = page.pose();
    const far = steps(5, 40);
    slide(TY, far);
    expect(apart(page.placeOf(HAND_L), [3, 0, 0])).toBeGreaterThan(0.5);
    page.wb.store.undo();
    expect(page.pose()).toEqual(before);
    slide(TY, [...far, ...far.toReversed(), 0]);
    page.pose().forEach((value, dof) => {
      expect(Math.abs(value - (before[dof] ?? Number.NaN)), `DOF ${dof}`).toBeLessThan(0.02);
    });
    expect(apart(page.placeOf(HAND_L), [3, 0, 0])).toBeLessThan(THERE);
  });

  it('a DOF set while pins hold still shows the gap of a pin that could not hold', () => {
    slide(TY, steps(5));
    const left = page.wb.posing.ik.targets.leftOf('c1', Float64Array.from(page.pose()));
    expect(left?.targets.get(1)?.target.position).toEqual([3, 0, 0]);
  });

  it('pins affect no DOF if there are none, or if it belongs to no joint', () => {
    const count = page.pose().length;
    expect(besidePins(page.wb, 'c1', [count])).toBeUndefined();
    expect(besidePins(page.wb, 'nobody', [0])).toBeUndefined();
    page.stop();
    page = ikPage(documentOf(body({ ik: { pins: [], stiff: [{ joint: FORE_L }], rootIsFree: true } })));
    expect(besidePins(page.wb, 'c1', [0])).toBeUndefined();
  });
});
