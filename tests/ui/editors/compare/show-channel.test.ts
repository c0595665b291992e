import { expect, it } from 'vitest';
import { showChannel } from '../../../../src/ui/editors/compare/show-channel.ts';
import { characterOf, OWN } from '../../../teaching/lesson-files.ts';
import { documentOf, workbench } from '../../builders.ts';

const walker = characterOf(...OWN.walker);

function shownAt(timeSeconds: number) {
  const { wb } = workbench(documentOf(walker), { timeSeconds });
  const { window: before } = wb.timeline.view.get();
  showChannel(wb, walker, 4);
  return { before, view: wb.timeline.view.get(), joint: wb.store.selection.joint };
}

it('a channel that differs is shown alone, with its reasons and with the current time in view', () => {
  const inside = shownAt(0.5);
  expect(inside.view).toMatchObject({ tab: 'curves', showsWhy: true, isolated: [4], window: inside.before });
  expect(inside.joint).toBe(0);
  for (const time of [-2, 40]) {
    const { before, view } = shownAt(time);
    expect(view.window.from).toBeLessThan(Math.min(time, before.from));
    expect(view.window.to).toBeGreaterThan(Math.max(time, before.to));
  }
});
