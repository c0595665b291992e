/** Buttons in the transport that open the collapsed timeline at one of its tabs. While it is open its own tabs are there. */

import { isPanelOpen, openPanel } from '../../state/panels/panels.ts';
import { TIMELINE_TABS, type TimelineTabName } from '../../state/timeline.ts';
import type { Uses } from '../../state/workbench.ts';
import { button, element, keepsFocusElsewhere } from '../../widgets/dom.ts';
import { type MenuEntry, menuButton } from '../../widgets/menu.ts';
import { TABS } from './timeline-tabs.ts';

/** Those that have a button of their own; the others are in a menu. */
const FIRST: readonly TimelineTabName[] = ['curves', 'dope', 'takes'];

export function timelineOpeners(wb: Uses<'store' | 'timeline' | 'settings'>): HTMLElement {
  const open = (tab: TimelineTabName) => {
    wb.timeline.change({ tab });
    openPanel(wb, 'timeline', true);
  };
  const more = element('button', { type: 'button', class: 'plain' }, 'More');
  menuButton(more, 'More panels', (): readonly MenuEntry[] =>
    TIMELINE_TABS.filter((name) => !FIRST.includes(name)).flatMap((name) => {
      const { label, isListed } = TABS[name];
      const isThere = isListed?.(wb.store.document) ?? true;
      return isThere ? [{ kind: 'item' as const, label, enabled: true, run: () => open(name) }] : [];
    }),
  );
  const made = element(
    'div',
    { class: 'timeline-openers', role: 'group', 'aria-label': 'Open timeline' },
    ...FIRST.map((name) => {
      const { label } = TABS[name];
      return keepsFocusElsewhere(button(label, { class: 'plain' }, label, () => open(name)));
    }),
    more,
  );
  const show = () => {
    made.hidden = isPanelOpen(wb.settings.get(), 'timeline');
  };
  wb.settings.subscribe((now, before) => {
    if (now.panels !== before.panels) show();
  });
  show();
  return made;
}
