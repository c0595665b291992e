import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import { PinNudge } from '../../../../src/ui/editors/ik/pin-nudge.ts';
import { apart, HAND_L, HAND_R, ikPage } from './ik-page.ts';

/** Of a body that is 6 wide. */
const THERE = 2e-3;

let page: ReturnType<typeof ikPage>;
let nudge: PinNudge;
beforeEach(() => {
  page = ikPage();
  nudge = new PinNudge(page.wb);
  page.wb.posing.ik.selected.set({ characterId: 'c1', pin: 1 });
});
afterEach(() => {
  nudge.finish();
  page.stop();
});

/** Whether the key was used for the pin. */
function press(key: string, held: { altKey?: boolean; shiftKey?: boolean; ctrlKey?: boolean } = {}): boolean {
  let prevented = false;
  const keys = { altKey: false, shiftKey: false, ctrlKey: false, metaKey: false, ...held };
  // The part of an event that is used.
  const preventDefault = () => {
    prevented = true;
  };
  const event = { key, ...keys, preventDefault } as unknown as KeyboardEvent;
  expect(nudge.key(event)).toBe(prevented);
  return prevented;
}
const steps = () => {
  let count = 0;
  while (page.wb.store.undo()) count++;
  return count;
};

describe('arrow keys', () => {
  it.each([
    ['ArrowLeft', {}, [2.95, 0, 0]],
    ['ArrowUp', {}, [3, 0.05, 0]],
    ['ArrowLeft', { shiftKey: true }, [2.75, 0, 0]],
    ['ArrowDown', { shiftKey: true }, [3, -0.25, 0]],
    // Up is away from the viewer, who looks along −z.
    ['ArrowUp', { altKey: true }, [3, 0, -0.05]],
    ['ArrowDown', { altKey: true, shiftKey: true }, [3, 0, 0.25]],
  ] as const)('%s with %o moves the pin over the screen, or in depth', (key, held, [x, y, z]) => {
    expect(press(key, held)).toBe(true);
    nudge.finish();
    expect(apart(page.placeOf(HAND_L), [x, y, z])).toBeLessThan(THERE);
    expect(apart(page.placeOf(HAND_R), [-3, 0, 0])).toBeLessThan(THERE);
  });

  it('presses in quick succession are one undo step, later ones another', () => {
    for (let i = 0; i < 4; i++) press('ArrowLeft');
    expect(nudge.state?.grip.pin).toBe(1);
    nudge.finish();
    expect(nudge.state).toBeUndefined();
    expect(apart(page.placeOf(HAND_L), [2.8, 0, 0])).toBeLessThan(THERE);
    press('ArrowUp');
    nudge.finish();
    expect(steps()).toBe(2);
  });

  it('the same place of the pin gives the same pose at once, whichever presses led there', () => {
    const further = { shiftKey: true };
    // To where the arm is straight, beyond it, and back.
    for (let i = 0; i < 2; i++) press('ArrowRight', further);
    const { pose } = page.wb.store.document.characters[0];
    for (const key of ['ArrowRight', 'ArrowLeft']) press(key, further);
    const again = page.wb.store.document.characters[0].pose;
    expect(Math.max(...again.map((value, dof) => Math.abs(value - pose[dof])))).toBeLessThan(1e-6);
  });

  it('another pin starts another step', () => {
    press('ArrowLeft');
    page.wb.posing.ik.selected.set({ characterId: 'c1', pin: 2 });
    press('ArrowUp');
    nudge.finish();
    expect(apart(page.placeOf(HAND_L), [2.95, 0, 0])).toBeLessThan(THERE);
    expect(apart(page.placeOf(HAND_R), [-3, 0.05, 0])).toBeLessThan(THERE);
    expect(steps()).toBe(2);
  });

  it('continues in a new step if something else has ended the previous one', () => {
    press('ArrowLeft');
    page.wb.store.undo();
    expect(nudge.state).toBeUndefined();
    press('ArrowLeft');
    nudge.finish();
    expect(apart(page.placeOf(HAND_L), [2.95, 0, 0])).toBeLessThan(THERE);
  });

  it('arrow keys are not handled without a selected pin, or with Ctrl', () => {
    expect(press('ArrowLeft', { ctrlKey: true })).toBe(false);
    expect(press('a')).toBe(false);
    page.wb.posing.ik.selected.set(undefined);
    expect(press('ArrowLeft')).toBe(false);
    expect(steps()).toBe(0);
  });
});

it('Delete removes the pin, after committing its motion', () => {
  press('ArrowLeft');
  expect(press('Delete')).toBe(true);
  expect(page.wb.store.document.characters[0].ik?.pins.map(({ id }) => id)).toEqual([2]);
  expect(page.wb.posing.ik.selected.get()).toBeUndefined();
  expect(steps()).toBe(2);
});
