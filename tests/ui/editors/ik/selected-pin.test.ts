import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import { unpin } from '../../../../src/edit/commands/ik.ts';
import { deselectLostPin, findPin, selectedPin } from '../../../../src/ui/editors/ik/selected-pin.ts';
import { HAND_L, HAND_R, ikPage } from './ik-page.ts';

let page: ReturnType<typeof ikPage>;
beforeEach(() => {
  page = ikPage();
  const { wb } = page;
  wb.posing.ik.selected.set({ characterId: 'c1', pin: 1 });
  wb.store.select({ characterId: 'c1', joint: HAND_L });
});
afterEach(() => page.stop());

describe('the pin in hand', () => {
  it('each page has its own selected pin', () => {
    expect(selectedPin(page.wb)?.pin.id).toBe(1);
    expect(selectedPin(ikPage().wb)).toBeUndefined();
  });

  it('the selected pin stays while its joint, or a vertex of it, is selected', () => {
    deselectLostPin(page.wb, true);
    page.wb.store.select({ characterId: 'c1', joint: HAND_L, vertex: 7 });
    deselectLostPin(page.wb, true);
    expect(selectedPin(page.wb)?.pin.id).toBe(1);
  });

  it.each([
    ['another joint', { characterId: 'c1', joint: HAND_R }],
    ['the character', { characterId: 'c1' }],
    ['another character', { characterId: 'c2', joint: HAND_L }],
    ['nothing', {}],
  ])('the pin in hand is let go where %s is selected', (_what, selection) => {
    page.wb.store.select(selection);
    deselectLostPin(page.wb, true);
    expect(page.wb.posing.ik.selected.get()).toBeUndefined();
  });

  it('the selected pin stays through an edit while something else is selected', () => {
    page.wb.store.select({ characterId: 'c1' });
    deselectLostPin(page.wb, false);
    expect(selectedPin(page.wb)?.pin.id).toBe(1);
  });

  it('the selected pin is deselected when removed, and stays so when restored', () => {
    const { wb } = page;
    wb.store.apply(unpin, { characterId: 'c1', pins: [1] });
    expect(selectedPin(wb)).toBeUndefined();
    deselectLostPin(wb, false);
    wb.store.undo();
    expect(findPin(wb, { characterId: 'c1', pin: 1 })?.pin.joint).toBe(HAND_L);
    expect(selectedPin(wb)).toBeUndefined();
  });
});
