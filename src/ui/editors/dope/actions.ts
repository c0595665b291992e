/** Actions of the dope sheet beyond those on keys: ripple, collapsing rows, showing curves. */

import { rippleKeys } from '../../../edit/commands/keys.ts';
import { needs } from '../../state/actions/needs.ts';
import type { Action, Uses } from '../../state/workbench.ts';
import { onAllInHand, selectedKeysInView } from '../timeline/current-take.ts';
import { allFolds } from '../timeline/dope-rows.ts';
import { rippleSeconds } from '../timeline/edit-all.ts';
import { needsKeys, needsTimeline } from '../timeline/key-actions.ts';
import { changeChannelView, channelViewOf, type TimelinePart, timelineTake } from '../timeline/timeline-take.ts';
import { showCurves } from './show-curves.ts';

const MENU = 'Keys/Dope sheet';

export const DOPE_ACTIONS: readonly Action[] = [
  {
    id: 'dope.ripples',
    label: 'Ripple: move later keys along',
    group: 'Keys',
    menu: MENU,
    section: 15,
    shortcuts: ['R'],
    panel: 'timeline',
    icon: 'ripple',
    checked: (wb) => wb.timeline.view.get().ripples,
    run: (wb) => wb.timeline.change({ ripples: !wb.timeline.view.get().ripples }),
  },
  ripple('dope.rippleLater', 'Ripple one frame later', '>', 1),
  ripple('dope.rippleEarlier', 'Ripple one frame earlier', '<', -1),
  {
    id: 'dope.curves',
    label: 'Show curves of selected keys',
    group: 'Keys',
    menu: MENU,
    section: 16,
    panel: 'timeline',
    refuses: needsKeys,
    run: (wb) =>
      showCurves(
        wb,
        selectedKeysInView(wb).map((k) => k.channel),
      ),
  },
  {
    id: 'dope.allRows',
    label: 'Show rows without keys',
    group: 'Keys',
    menu: MENU,
    section: 17,
    panel: 'timeline',
    icon: 'allRows',
    checked: (wb) => wb.timeline.view.get().allRows,
    run: (wb) => wb.timeline.change({ allRows: !wb.timeline.view.get().allRows }),
  },
  {
    id: 'dope.unfoldAll',
    label: 'Expand all',
    group: 'Keys',
    menu: MENU,
    section: 17,
    panel: 'timeline',
    refuses: needsTimeline,
    run(wb) {
      for (const { character, take } of partsOf(wb))
        changeChannelView(wb.timeline, character.id, { unfolded: allFolds(character, take) });
    },
  },
  {
    id: 'dope.foldAll',
    label: 'Collapse all',
    group: 'Keys',
    menu: MENU,
    section: 17,
    panel: 'timeline',
    refuses: needs('All rows are collapsed.', (wb) =>
      partsOf(wb).some(({ character: { id } }) => channelViewOf(wb.timeline.view.get(), id).unfolded.length > 0),
    ),
    run(wb) {
      for (const { character } of partsOf(wb)) changeChannelView(wb.timeline, character.id, { unfolded: [] });
    },
  },
];

function partsOf(wb: Uses<'store'>): readonly TimelinePart[] {
  return timelineTake(wb)?.parts ?? [];
}

function ripple(id: string, label: string, shortcut: string, frames: number): Action {
  return {
    id,
    label,
    group: 'Keys',
    menu: MENU,
    section: 15,
    shortcuts: [shortcut],
    panel: 'timeline',
    repeats: true,
    refuses: needsKeys,
    run(wb) {
      const current = timelineTake(wb);
      if (!current) return;
      const keys = selectedKeysInView(wb);
      const seconds = rippleSeconds(current, keys, frames / wb.transport.get().framesPerSecond);
      wb.store.apply(onAllInHand(wb, rippleKeys), { characterId: current.character.id, keys, seconds });
    },
  };
}
