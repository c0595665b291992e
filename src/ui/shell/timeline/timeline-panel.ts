/**
 * The panel below the transport: curve editor, dope sheet, takes and poses as tabs, with a splitter for its height. The
 * tabs are scripts of their own, so that the page shows its character first.
 */
import { movedNotice } from '../../editors/retarget/moved.ts';
import { onDemand, whenIdle } from '../../state/on-demand.ts';
import { isPanelOpen, NARROW, openPanel } from '../../state/panels/panels.ts';
import { splitter } from '../../state/panels/splitter.ts';
import { TIMELINE_TABS, type TimelineTab, type TimelineTabName } from '../../state/timeline.ts';
import type { Uses } from '../../state/workbench.ts';
import { button, element, keepsFocusElsewhere, setText } from '../../widgets/dom.ts';
import { focusPanel } from '../../widgets/focus/focus.ts';
import { icon } from '../../widgets/icons.ts';
import { TABS } from './timeline-tabs.ts';

/**
 * @param load loads and builds a tab; called once, when it is first shown; for the initial tab not before the page is
 *   idle, since the first frame has priority
 */
export function timelinePanel(
  wb: Uses<'store' | 'timeline' | 'settings' | 'messages' | 'loading' | 'dialog'>,
  load: (name: TimelineTabName) => Promise<TimelineTab>,
  signal: AbortSignal,
): HTMLElement {
  const { timeline } = wb;
  const places = TIMELINE_TABS.map((name) => {
    const { label } = TABS[name];
    const title = keepsFocusElsewhere(
      button(label, { role: 'tab', class: 'timeline-tab', id: `timeline-tab-${name}` }, label, () =>
        timeline.change({ tab: name }),
      ),
    );
    title.addEventListener('click', (event) => {
      // A click means working there, so the panel gets the focus; by keyboard it stays on the tabs.
      if (event.detail === 0) return;
      isGoneTo = true;
      show();
    });
    const tools = element('div', { class: 'timeline-tools' });
    // Until loaded.
    const waiting = element('p', { class: 'empty' }, `${label} …`);
    const body = element('div', { class: 'timeline-body', role: 'tabpanel', 'aria-labelledby': title.id }, waiting);
    return { name, title, tools, body, waiting };
  });
  let isGoneTo = false;
  const built = new Map<TimelineTabName, TimelineTab>();
  const build = async (name: TimelineTabName) => {
    const place = places.find((p) => p.name === name);
    const what = `The ${TABS[name].label.toLowerCase()}`;
    const tab = await onDemand(wb.messages, what, () => load(name));
    if (!tab && place) setText(place.waiting, `${what} could not be loaded.`);
    if (!tab || signal.aborted) return;
    built.set(name, tab);
    if (tab.tools) place?.tools.append(tab.tools);
    place?.body.replaceChildren(tab.element);
    show();
  };
  let isStarting = true;
  const asked = new Set<TimelineTabName>();
  const need = (name: TimelineTabName) => {
    if (asked.has(name)) return;
    asked.add(name);
    if (isStarting) whenIdle(wb, () => void build(name));
    else void build(name);
  };
  const isListed = (name: TimelineTabName) =>
    name === timeline.view.get().tab || (TABS[name].isListed?.(wb.store.document) ?? true);
  const list = element('div', { role: 'tablist', class: 'timeline-tabs', 'aria-label': 'Timeline' });
  list.append(...places.map((p) => p.title));
  list.addEventListener('keydown', (event) => {
    if (event.key !== 'ArrowLeft' && event.key !== 'ArrowRight') return;
    event.preventDefault();
    const listed = TIMELINE_TABS.filter(isListed);
    const step = event.key === 'ArrowLeft' ? listed.length - 1 : 1;
    const other = listed[(listed.indexOf(timeline.view.get().tab) + step) % listed.length];
    timeline.change({ tab: other });
    places.find((p) => p.name === other)?.title.focus();
  });
  const fold = keepsFocusElsewhere(
    button('Collapse timeline', { class: 'tool timeline-fold' }, icon('close'), () => openPanel(wb, 'timeline', false)),
  );
  const panel = element(
    'section',
    { class: 'timeline', 'aria-label': 'Timeline', 'data-panel': 'timeline' },
    splitter(wb, 'timelineHeight', 'Height of the timeline'),
    element('div', { class: 'timeline-head' }, list, ...places.map((p) => p.tools), fold),
    movedNotice(wb),
    ...places.map((p) => p.body),
  );

  let handsOver = false;
  let inView: TimelineTabName | undefined;
  const show = () => {
    const { tab } = timeline.view.get();
    const open = isPanelOpen(wb.settings.get(), 'timeline');
    panel.hidden = !open;
    if (open) need(tab);
    timeline.tab = open ? built.get(tab) : undefined;
    handsOver ||= places.some((p) => p.name !== tab && p.body.contains(document.activeElement));
    for (const { name, title, tools, body } of places) {
      const chosen = name === tab;
      title.setAttribute('aria-selected', String(chosen));
      title.tabIndex = chosen ? 0 : -1;
      title.hidden = !isListed(name);
      body.hidden = tools.hidden = !chosen;
      built.get(name)?.setVisible(open && chosen);
    }
    // On phones the tabs scroll, and one may be chosen elsewhere.
    if (open && inView !== tab)
      places.find((p) => p.name === tab)?.title.scrollIntoView({ block: 'nearest', inline: 'nearest' });
    inView = open ? tab : undefined;
    // The focused element was hidden, so the keyboard would be dead. A tab being loaded gets the focus when ready.
    if ((handsOver || isGoneTo) && timeline.tab) {
      const { activeElement } = document;
      if (isGoneTo || panel.contains(activeElement) || activeElement === document.body) focusPanel(panel);
      handsOver = isGoneTo = false;
    }
  };
  timeline.view.subscribe((now, before) => {
    if (now.tab !== before.tab) show();
  });
  wb.store.subscribe((now, before) => {
    if (now.document.review !== before.document.review) show();
  });
  wb.settings.subscribe((now, before) => {
    if (now.panels !== before.panels) show();
  });
  window.matchMedia(NARROW).addEventListener('change', show, { signal });
  show();
  isStarting = false;
  return panel;
}
