import { afterEach, beforeEach, expect, it } from 'vitest';
import { removeCharacter } from '../../../../src/edit/commands/characters.ts';
import { type HandDragEvents, handDrag } from '../../../../src/ui/editors/fk/hand-drag.ts';
import { besidePins } from '../../../../src/ui/editors/ik/pins-beside.ts';
import type { CanvasPointer } from '../../../../src/ui/editors/viewport/canvas-tools.ts';
import { apart, BODY_JOINT, HAND_L, HAND_R, ikPage } from '../ik/ik-page.ts';

/** Of a body that is 6 wide. */
const THERE = 2e-3;
const ROOT_RZ = 5;
const RADIANS_PER_PIXEL = 0.01;

let page: ReturnType<typeof ikPage>;
beforeEach(() => {
  page = ikPage();
});
afterEach(() => page.stop());

const at = (clientX: number): CanvasPointer => ({
  clientX,
  clientY: 0,
  button: 0,
  altKey: false,
  shiftKey: false,
  ctrlKey: false,
  metaKey: false,
  pointerType: 'mouse',
});

/** A ring of the body about z. */
function turning() {
  const { wb } = page;
  const events: HandDragEvents = {
    begin:
      () =>
      ({ clientX }) => ({
        verb: 'Rotate',
        dofs: [{ index: ROOT_RZ, value: RADIANS_PER_PIXEL * clientX }],
        others: [],
        handle: { id: { kind: 'dof', dof: ROOT_RZ }, from: 0, stop: undefined },
        stops: [],
      }),
    moved: () => {},
    ended: () => {},
  };
  return handDrag(wb, { characterId: 'c1', joint: BODY_JOINT }, at(0), 2, events);
}

const hands = () => [HAND_L, HAND_R].map((hand) => page.placeOf(hand));
const holdPins = () => {
  page.wb.posing.beside = (id, dofs) => besidePins(page.wb, id, dofs);
};

it('a turned body leaves its pinned hands where they are, in one undo step', () => {
  holdPins();
  const before = hands();
  const drag = turning();
  for (let x = 1; x <= 30; x++) drag.move(at(x));
  drag.end(at(30));
  expect(page.pose()[ROOT_RZ]).toBeCloseTo(0.3, 12);
  // Nor does it tilt about its other axes.
  expect(
    page
      .pose()
      .slice(3, 5)
      .every((angle) => angle === 0),
  ).toBe(true);
  hands().forEach((hand, i) => {
    expect(apart(hand, before[i])).toBeLessThan(THERE);
  });
  expect(page.wb.store.undoLabel).toBe('Rotate body');
  page.wb.store.undo();
  expect(page.pose()[ROOT_RZ] ?? 0).toBe(0);
});

it('a body that is turned and back is as it was, and at Escape at once', () => {
  holdPins();
  const before = page.pose();
  const drag = turning();
  for (let x = 1; x <= 60; x++) drag.move(at(x));
  for (let x = 60; x >= 0; x--) drag.move(at(x));
  page.pose().forEach((value, dof) => {
    expect(Math.abs(value - (before[dof] ?? 0)), `DOF ${dof}`).toBeLessThan(1e-6);
  });
  for (let x = 0; x <= 60; x++) drag.move(at(x));
  drag.cancel();
  expect(page.pose()).toEqual(before);
  expect(page.wb.store.undoLabel).toBeUndefined();
});

it.each([
  ['undone', () => void page.wb.store.undo()],
  ['removed', () => page.wb.store.apply(removeCharacter, { characterId: 'c1' })],
])('a drag of a character that is %s meanwhile ends there, and nothing else changes', (_, act) => {
  const drag = turning();
  for (let x = 1; x <= 10; x++) drag.move(at(x));
  act();
  const { document } = page.wb.store;
  for (let x = 11; x <= 30; x++) drag.move(at(x));
  drag.end(at(30));
  expect(page.wb.store.document).toBe(document);
});

it('without pins that hold only the dragged DOF changes', () => {
  const [before] = hands();
  const drag = turning();
  drag.move(at(30));
  drag.end(at(30));
  expect(apart(page.placeOf(HAND_L), before)).toBeGreaterThan(0.5);
});
