/** A key for each way of the tween bar: it opens the bar with that way, and closes it when pressed again. */

import { TWEEN_WAYS, type TweenWay } from '../../state/tween-ways.ts';
import type { Action, Uses } from '../../state/workbench.ts';
import { needsKeys, needsTimeline } from '../timeline/key-actions.ts';

const ways: readonly TweenWay[] = TWEEN_WAYS;

export const TWEEN_ACTIONS: readonly Action[] = ways.map(
  ({ kind, label, shortcut, of }): Action => ({
    id: `tween.${kind}`,
    label,
    also: 'breakdown inbetween favour push pull bar',
    group: 'Keys',
    menu: 'Keys/Between keys',
    section: 11,
    shortcuts: [shortcut],
    refuses: (wb: Uses<'store' | 'timeline'>) => needsTimeline(wb) ?? (of === 'keys' ? needsKeys(wb) : undefined),
    checked: (wb) => wb.timeline.tween.get() === kind,
    run: (wb) => wb.timeline.tween.update((now) => (now === kind ? undefined : kind)),
  }),
);
