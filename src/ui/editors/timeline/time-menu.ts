/** The context menu of a point in time: of the rulers, the scrubber, and by keyboard of the current time. */
import { type Playback, pause } from '../../../edit/playback.ts';
import { countUnkeyed } from '../../../edit/unkeyed.ts';
import { findAction, tryAction } from '../../state/actions/action.ts';
import { sectionsOf } from '../../state/actions/menu-entries.ts';
import type { Uses } from '../../state/workbench.ts';
import { type MenuEntry, type MenuItem, type MenuPlace, openMenu } from '../../widgets/menu.ts';
import { shown } from '../../widgets/numbers/number-text.ts';

type Page = Uses<'actions' | 'transport' | 'settings' | 'store'>;

/** @param timeSeconds of the transport */
export function openTimeMenu(wb: Page, timeSeconds: number, at: MenuPlace): void {
  openMenu(at, timeEntries(wb, timeSeconds), { label: timeText(wb, timeSeconds) });
}

/** Of the current time, actions; of another one also going there. */
export function timeEntries(wb: Page, timeSeconds: number): MenuEntry[] {
  const item = (label: string, run: () => void): MenuItem => ({ kind: 'item', label, enabled: true, run });
  const change = (next: (now: Playback) => Playback) => () => wb.transport.update(next);
  const goThere = change((p) => ({ ...pause(p, false), timeSeconds }));
  const runThere = (id: string) => () => {
    const action = findAction(wb, id);
    if (!action) return;
    goThere();
    tryAction(wb, action);
  };
  // Going there would discard what is unkeyed here, which is not what would then be keyed.
  const isUnkeyed = countUnkeyed(wb.store.document, null) > 0;
  const keyHere: MenuItem = {
    ...item('Key whole pose here', runThere('key.pose')),
    enabled: !isUnkeyed,
    detail: isUnkeyed ? 'Key or undo the unkeyed changes first' : undefined,
  };
  const isNow = wb.transport.get().timeSeconds === timeSeconds;
  return [
    { kind: 'note', text: timeText(wb, timeSeconds) },
    ...sectionsOf(wb, [
      isNow ? ['key.pose', 'key.deleteHere'] : [item('Go here', goThere), keyHere],
      [
        item(
          'Set range start here',
          change((p) => ({ ...p, range: [timeSeconds, Math.max(timeSeconds, p.range[1])] })),
        ),
        item(
          'Set range end here',
          change((p) => ({ ...p, range: [Math.min(timeSeconds, p.range[0]), timeSeconds] })),
        ),
        'play.wholeRange',
        'take.rangeFromPlayed',
      ],
      isNow ? ['marker.add'] : [item('Add marker here', runThere('marker.add'))],
      ['play.previousKey', 'play.nextKey'],
      ['Edit/Edit takes', 'View/Time', 'Play/Loop', 'Play/Speed'],
    ]),
  ];
}

/** `1.25 s`, or `frame 30` if times are in frames. */
export function timeText({ transport, settings }: Uses<'transport' | 'settings'>, timeSeconds: number): string {
  if (settings.get().timeDisplay === 'seconds') return `${shown(timeSeconds)} s`;
  return `frame ${shown(timeSeconds * transport.get().framesPerSecond)}`;
}
