import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import { setDofs } from '../../../../src/edit/commands/pose.ts';
import { compileSkeleton } from '../../../../src/evaluate/kinematics.ts';
import type { Vec3 } from '../../../../src/math/vec3.ts';
import type { Joint, Skeleton } from '../../../../src/model/skeleton/skeleton.ts';
import { besidePins, type Standing } from '../../../../src/ui/editors/ik/pins-beside.ts';
import { character, documentOf, joint } from '../../builders.ts';
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

describe('feet that stand', () => {
  const bone = (name: string, parent: number, offset: Vec3): Joint => ({ ...joint(name, parent), offset });
  /** A root with hips on bent legs, and a trunk. */
  const WALKER: Skeleton = {
    name: 'walker',
    joints: [
      bone('root', -1, [0, 0, 0]),
      bone('hips', 0, [0, 1.8, 0]),
      bone('chest', 1, [0, 0.5, 0]),
      bone('head', 2, [0, 0.5, 0]),
      bone('thigh_l', 1, [0.2, 0, 0]),
      bone('shin_l', 4, [0, -0.9, 0.2]),
      bone('foot_l', 5, [0, -0.9, -0.2]),
      bone('thigh_r', 1, [-0.2, 0, 0]),
      bone('shin_r', 7, [0, -0.9, 0.2]),
      bone('foot_r', 8, [0, -0.9, -0.2]),
    ],
  };
  const [ROOT, HIPS, CHEST, , , , FOOT_L, , , FOOT_R] = WALKER.joints.keys();
  let told: (Standing | undefined)[];
  beforeEach(() => {
    told = [];
    page.stop();
    page = ikPage(documentOf(character({ skeleton: WALKER })));
  });
  const beside = (dofs: readonly number[], by?: number) =>
    besidePins(page.wb, 'c1', dofs, by, (standing) => void told.push(standing));

  it('hold while a handle moves the body: their legs bend, and nothing else', () => {
    const held = beside([TY], ROOT);
    const changed = held?.at([{ index: TY, value: -0.2 }]) ?? [];
    const { firstDof } = compileSkeleton(WALKER);
    const bent = WALKER.joints.flatMap((_, j) =>
      changed.some(({ index, value }) => index >= firstDof[j] && index < firstDof[j + 1] && value !== 0) ? [j] : [],
    );
    expect(bent).toEqual([4, 5, 6, 7, 8, 9]);
    const gesture = page.wb.store.begin('Move');
    const before = [FOOT_L, FOOT_R].map((foot) => page.placeOf(foot));
    gesture.preview(setDofs.run(gesture.base, { characterId: 'c1', dofs: changed, timeSeconds: 0 }));
    expect(page.placeOf(HIPS)[1]).toBeCloseTo(1.6, 12);
    [FOOT_L, FOOT_R].forEach((foot, i) => {
      expect(apart(page.placeOf(foot), before[i])).toBeLessThan(1e-3);
    });
    held?.over();
    expect(told.map((standing) => standing?.feet.map((pin) => pin.joint))).toEqual([[FOOT_L, FOOT_R], undefined]);
  });

  it('don’t hold for sliders, for joints that don’t carry the body, and in the air', () => {
    expect(beside([TY])).toBeUndefined();
    expect(beside([compileSkeleton(WALKER).firstDof[CHEST]], CHEST)).toBeUndefined();
    page.wb.store.apply(setDofs, { characterId: 'c1', dofs: [{ index: TY, value: 0.5 }], timeSeconds: 0 });
    expect(beside([TY], ROOT)).toBeUndefined();
    expect(told).toEqual([]);
  });
});
