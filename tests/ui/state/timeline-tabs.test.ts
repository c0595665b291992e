import { expect, it } from 'vitest';
import { afterPress, shownTabs, Timeline } from '../../../src/ui/state/timeline.ts';

const press = (tab: 'curves' | 'dope' | 'takes', together: boolean, isOpen: boolean, name: typeof tab) =>
  afterPress({ tab, together }, isOpen, name);

it('curve editor and dope sheet are two switches, and any other tab replaces both', () => {
  expect(press('curves', false, true, 'dope')).toEqual({ tab: 'dope', together: true });
  expect(press('dope', true, true, 'curves')).toEqual({ tab: 'dope', together: false });
  expect(press('dope', true, true, 'takes')).toEqual({ tab: 'takes', together: false });
  expect(press('takes', false, true, 'dope')).toEqual({ tab: 'dope', together: false });
});

it('a press on the last tab that is seen folds the timeline, and one on any tab of a folded one opens it', () => {
  expect(press('curves', false, true, 'curves')).toBeUndefined();
  expect(press('takes', false, true, 'takes')).toBeUndefined();
  expect(press('curves', false, false, 'curves')).toEqual({ tab: 'curves', together: false });
  expect(press('curves', true, false, 'dope')).toEqual({ tab: 'dope', together: false });
});

it('of two tabs the dope sheet is above, whichever keys are for', () => {
  for (const tab of ['curves', 'dope'] as const) expect(shownTabs({ tab, together: true })).toEqual(['dope', 'curves']);
  expect(shownTabs({ tab: 'takes', together: true })).toEqual(['takes']);
});

it('a fitted window stays fitted as its width changes, until it is zoomed or panned', () => {
  const timeline = new Timeline();
  timeline.resize(1000);
  timeline.fit([0, 4]);
  const { window } = timeline.view.get();
  timeline.resize(500);
  const narrower = timeline.view.get().window;
  expect(narrower.to - narrower.from).toBeGreaterThan(window.to - window.from);
  timeline.change({ window: { from: 1, to: 2 } });
  timeline.resize(900);
  expect(timeline.view.get().window).toEqual({ from: 1, to: 2 });
});
