import { expect, it } from 'vitest';
import { shownTake } from '../../../../src/model/document.ts';
import { keysOf, restChannel } from '../../../../src/model/takes/take.ts';
import { channelsInView, selectKeys } from '../../../../src/ui/editors/timeline/current-take.ts';
import { runAction } from '../../../../src/ui/state/actions/action.ts';
import { channel, character, documentOf, skeleton, take, workbench } from '../../builders.ts';

/** Keys in channels 3 and 4, of the hips, and 6, of the knee. */
function sheet() {
  const none = restChannel();
  const walking = take([0, 5], none, none, none, channel(1, 2), channel(1), none, channel(3), none, none);
  const wasp = character({ skeleton: skeleton(['hips', -1], ['knee', 0]), takes: [walking] });
  const { wb } = workbench(documentOf(wasp), { framesPerSecond: 10 });
  wb.timeline.change({ tab: 'dope' });
  return {
    wb,
    times: (c: number) => [...(keysOf(shownTake(wb.store.document.characters[0])?.channels[c]).times ?? [])],
  };
}

it('has every channel with keys in view, whatever joint is selected, or those that match the filter', () => {
  const { wb } = sheet();
  wb.store.select({ characterId: 'c1', joint: 1 });
  expect(channelsInView(wb)).toEqual([3, 4, 6]);
  wb.timeline.change({ filter: 'knee' });
  expect(channelsInView(wb)).toEqual([6]);
});

it('ripples keys by a frame, and back', () => {
  const { wb, times } = sheet();
  selectKeys(wb, [{ channel: 3, indices: [0] }]);
  runAction(wb, 'dope.rippleLater');
  expect([times(3), times(4)]).toEqual([[1.1, 2.1], [1]]);
  runAction(wb, 'dope.rippleEarlier');
  expect(times(3)).toEqual([1, 2]);
});

it('expands and collapses everything', () => {
  const { wb } = sheet();
  runAction(wb, 'dope.unfoldAll');
  expect(wb.timeline.view.get().unfolded).toEqual([-1, 0, 1]);
  runAction(wb, 'dope.foldAll');
  expect(wb.timeline.view.get().unfolded).toEqual([]);
});

it('shows the curves of the channels whose keys are selected', () => {
  const { wb } = sheet();
  wb.timeline.isolate([4]);
  selectKeys(wb, [{ channel: 6, indices: [0] }]);
  runAction(wb, 'dope.curves');
  expect(wb.timeline.view.get()).toMatchObject({ tab: 'curves', list: 'pinned', pinned: [6] });
  expect(channelsInView(wb)).toEqual([6]);
});
