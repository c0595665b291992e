import { expect, it } from 'vitest';
import { areShown, stepsDone as done, stepTexts } from '../../../../src/ui/shell/help/first-steps.ts';
import { character, documentOf, skeleton, take, workbench } from '../../builders.ts';

const stepsDone = (...[before, now, was]: [number, Parameters<typeof done>[1], Parameters<typeof done>[2]]) =>
  done(before, now, was, 'fk');
const start = character();
const posed = { ...start };
const keyed = { ...posed, takes: [...posed.takes, take([0, 1])] };
const at = (of: typeof start, joint?: number) => ({
  document: documentOf(of),
  selection: { characterId: of.id, ...(joint !== undefined && { joint }) },
});

it('first steps are done one after the other: a joint selected, posed, keyed', () => {
  expect(stepsDone(0, at(start), at(start))).toBe(0);
  expect(stepsDone(0, at(start, 2), at(start))).toBe(1);
  expect(stepsDone(1, at(posed, 2), at(start, 2))).toBe(2);
  expect(stepsDone(2, at(keyed, 2), at(posed, 2))).toBe(3);
});

it('first steps ask for a joint again once it is deselected, unless it was posed', () => {
  expect(stepsDone(1, at(start), at(start, 2))).toBe(0);
  expect(stepsDone(2, at(posed), at(posed, 2))).toBe(2);
});

it('first steps are not done by what changes nothing', () => {
  expect(stepsDone(1, at(start, 3), at(start, 2))).toBe(1);
  expect(stepsDone(2, at(posed, 2), at(posed, 2))).toBe(2);
});

it('first steps of Pose mode are a limb dragged, a ring turned, and a key, whatever is selected', () => {
  const turned = { ...posed };
  expect(done(0, at(start, 2), at(start), 'pose')).toBe(0);
  expect(done(0, at(posed, 2), at(start), 'pose')).toBe(1);
  expect(done(1, at(turned, 2), at(posed, 2), 'pose')).toBe(2);
  expect(done(1, at(keyed, 2), at(posed, 2), 'pose')).toBe(3);
});

it('first steps are not done by opening another character', () => {
  const both = { ...at(start, 2), document: documentOf(start, { ...keyed, id: 'c2' }) };
  expect(stepsDone(1, both, at(start, 2))).toBe(1);
});

it('first steps are shown only where a click selects a joint and a drag turns its ring', () => {
  const { wb } = workbench(documentOf(start));
  wb.settings.update((s) => ({ ...s, firstSteps: true }));
  for (const [mode, isShown] of [
    ['pose', true],
    ['fk', true],
    ['ik', false],
    ['rig', false],
  ] as const) {
    wb.posing.mode.set(mode);
    expect(areShown(wb)).toBe(isShown);
  }
});

it('first steps name hands and feet only where something has limbs', () => {
  const first = (...joints: [string, number][]) =>
    stepTexts(workbench(documentOf({ ...start, skeleton: skeleton(...joints) })).wb)?.[0];
  expect(first(['hilt', -1], ['blade', 0])).toBe('Drag a joint');
  expect(first(['arm', -1], ['elbow', 0], ['hand', 1])).toBe('Drag a hand, a foot or the head');
});

it('first steps are of no use to points', () => {
  const points = skeleton(['LASI', -1], ['RASI', -1]);
  const joints = points.joints.map((joint) => ({ ...joint, motion: { kind: 'point' as const } }));
  const { wb } = workbench(documentOf({ ...start, skeleton: { ...points, joints } }));
  wb.settings.update((s) => ({ ...s, firstSteps: true }));
  expect(areShown(wb)).toBe(false);
});
