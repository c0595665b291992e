import { afterEach, beforeEach, expect, it } from 'vitest';
import { selectPin } from '../../../../src/ui/editors/ik/pin-edits.ts';
import { HAND_L, ikPage } from './ik-page.ts';

let page: ReturnType<typeof ikPage>;
beforeEach(() => {
  page = ikPage();
});
afterEach(() => page.stop());

it('selects a pin and its joint, in the picked instance', () => {
  const { wb } = page;
  const ref = { characterId: 'c1', pin: 1 };
  selectPin(wb, ref, HAND_L, 2);
  expect(wb.store.selection).toEqual({ characterId: 'c1', placement: 2, joint: HAND_L });
  expect(wb.posing.ik.selected.get()).toBe(ref);
});

it('keeps the picked instance if none was picked now', () => {
  const { wb } = page;
  selectPin(wb, { characterId: 'c1', pin: 1 }, HAND_L);
  expect(wb.store.selection).toEqual({ characterId: 'c1', joint: HAND_L });
});
