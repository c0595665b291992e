/** The panel below the transport: curve editor and dope sheet as tabs, with the edge that sets its height. */
import { button, element, keepsFocusElsewhere } from '../dom.ts';
import { icon } from '../icons.ts';
import { isPanelOpen, NARROW } from '../panels.ts';
import { splitter } from '../splitter.ts';
import type { Workbench } from '../workbench.ts';
import { TIMELINE_TABS, type TimelineTab, type TimelineTabName } from './timeline.ts';

const LABELS: Readonly<Record<TimelineTabName, string>> = { curves: 'Curves', dope: 'Dope sheet' };

/** @param tabs each is built once and stays, hidden or not */
export function timelinePanel(wb: Workbench, tabs: Readonly<Record<TimelineTabName, TimelineTab>>): HTMLElement {
  const { timeline } = wb;
  const titles = TIMELINE_TABS.map((name) => {
    const title = keepsFocusElsewhere(
      button(LABELS[name], { role: 'tab', class: 'timeline-tab', id: `timeline-tab-${name}` }, LABELS[name], () =>
        timeline.change({ tab: name }),
      ),
    );
    const { element: body } = tabs[name];
    body.setAttribute('role', 'tabpanel');
    body.setAttribute('aria-labelledby', title.id);
    return { name, title, body };
  });
  const list = element('div', { role: 'tablist', class: 'timeline-tabs', 'aria-label': 'Timeline' });
  list.append(...titles.map((t) => t.title));
  list.addEventListener('keydown', (event) => {
    if (event.key !== 'ArrowLeft' && event.key !== 'ArrowRight') return;
    event.preventDefault();
    const other = TIMELINE_TABS[(TIMELINE_TABS.indexOf(timeline.view.get().tab) + 1) % TIMELINE_TABS.length];
    timeline.change({ tab: other });
    titles.find((t) => t.name === other)?.title.focus();
  });
  const fold = keepsFocusElsewhere(
    button('Fold the timeline', { class: 'tool timeline-fold' }, icon('close'), () =>
      wb.settings.update((s) => ({ ...s, panels: { ...s.panels, timelineOpen: false } })),
    ),
  );
  const panel = element(
    'section',
    { class: 'timeline', 'aria-label': 'Timeline', 'data-panel': 'timeline' },
    splitter(wb, 'timelineHeight', 'Height of the timeline'),
    element('div', { class: 'timeline-head' }, list, fold),
    ...titles.map((t) => t.body),
  );

  const show = () => {
    const { tab } = timeline.view.get();
    const open = isPanelOpen(wb.settings.get(), 'timeline');
    panel.hidden = !open;
    timeline.tab = open ? tabs[tab] : undefined;
    for (const { name, title, body } of titles) {
      const chosen = name === tab;
      title.setAttribute('aria-selected', String(chosen));
      title.tabIndex = chosen ? 0 : -1;
      body.hidden = !chosen;
      tabs[name].setVisible(open && chosen);
    }
  };
  timeline.view.subscribe((now, before) => {
    if (now.tab !== before.tab) show();
  });
  wb.settings.subscribe((now, before) => {
    if (now.panels !== before.panels) show();
  });
  window.matchMedia(NARROW).addEventListener('change', show);
  show();
  return panel;
}
