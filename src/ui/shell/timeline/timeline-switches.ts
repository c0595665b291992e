/**
 * The tabs of the timeline, at the right end of the transport: two switches for curve editor and dope sheet, which can
 * be seen together, and further tabs, which replace both. Those for which the row has no room are in the menu *More*.
 */

import { tryById } from '../../state/actions/action.ts';
import { setActionTooltip } from '../../state/actions/tooltips.ts';
import { isPanelOpen, NARROW, openPanel } from '../../state/panels/panels.ts';
import { afterPress, shownTabs, type TimelineTabName } from '../../state/timeline.ts';
import type { Uses } from '../../state/workbench.ts';
import { button, element, keepsFocusElsewhere, setAttribute, setText, write } from '../../widgets/dom.ts';
import { icon } from '../../widgets/icons.ts';
import { type MenuEntry, menuButton } from '../../widgets/menu.ts';
import { TABS } from './timeline-tabs.ts';

/** With a line between them; the last ones yield first. */
const GROUPS: readonly (readonly TimelineTabName[])[] = [
  ['curves', 'dope'],
  ['takes', 'review', 'poses'],
  ['measure', 'steps', 'source', 'compare'],
];

/** @param onClick a tab was clicked with the mouse, which means working there */
export function timelineSwitches(
  wb: Uses<'store' | 'actions' | 'timeline' | 'settings'>,
  onClick: () => void,
  signal: AbortSignal,
): HTMLElement {
  const { timeline } = wb;
  const isOpen = () => isPanelOpen(wb.settings.get(), 'timeline');
  const press = (name: TimelineTabName) => {
    const change = afterPress(timeline.view.get(), isOpen(), name);
    if (change) timeline.change(change);
    openPanel(wb, 'timeline', change !== undefined);
  };
  const tabs = GROUPS.map((names) =>
    names.map((name) => {
      const { label } = TABS[name];
      const id = `timeline-tab-${name}`;
      const made = button(label, { role: 'tab', class: 'timeline-tab', id, tooltip: '' }, label, () => press(name));
      made.addEventListener('click', ({ detail }) => {
        if (detail > 0) onClick();
      });
      return { name, element: keepsFocusElsewhere(made) };
    }),
  );
  const list = element(
    'div',
    { role: 'tablist', class: 'timeline-tabs', 'aria-label': 'Timeline', 'aria-multiselectable': 'true' },
    ...tabs.map((group) =>
      element('span', { class: 'tab-group', role: 'presentation' }, ...group.map((t) => t.element)),
    ),
  );
  const more = keepsFocusElsewhere(element('button', { type: 'button', class: 'plain timeline-more' }, 'More'));
  const inMore = () => tabs.flat().filter((tab) => tab.element.closest('.yields') && !tab.element.hidden);
  menuButton(more, 'More panels', (): MenuEntry[] =>
    inMore().map(({ name }) => ({
      kind: 'item',
      label: TABS[name].label,
      enabled: true,
      radio: true,
      checked: isOpen() && timeline.view.get().tab === name,
      run: () => press(name),
    })),
  );
  const fold = keepsFocusElsewhere(
    button('Timeline panel', { class: 'tool timeline-button' }, icon('fold'), () => tryById(wb, 'page.timeline')),
  );
  setActionTooltip(wb, fold, 'page.timeline', () => (isOpen() ? 'Collapse timeline' : 'Open timeline'));
  const row = element('div', { class: 'timeline-switches' }, list, more, fold);

  list.addEventListener('keydown', (event) => {
    if (event.key !== 'ArrowLeft' && event.key !== 'ArrowRight') return;
    event.preventDefault();
    const all = tabs.flat().filter(({ element: tab }) => !tab.hidden && !tab.closest('.yields'));
    const from = all.findIndex(({ element: tab }) => tab === document.activeElement);
    const to = all[(from + (event.key === 'ArrowLeft' ? all.length - 1 : 1)) % all.length];
    for (const { element: tab } of all) write(tab, 'tabIndex', tab === to.element ? 0 : -1);
    to.element.focus();
  });

  const show = () => {
    const view = timeline.view.get();
    const shown = isOpen() ? shownTabs(view) : [];
    for (const { name, element: tab } of tabs.flat()) {
      setAttribute(tab, 'aria-selected', String(shown.includes(name)));
      write(tab, 'tabIndex', name === view.tab ? 0 : -1);
      write(tab, 'hidden', name !== view.tab && TABS[name].isListed?.(wb.store.document) === false);
    }
    setAttribute(fold, 'aria-pressed', String(isOpen()));
    // Not known before the page has it.
    if (row.isConnected) giveWay();
  };
  /** What yields depends on widths: before a frame is drawn with others. */
  const giveWay = () => {
    if (row.clientWidth === 0) return;
    list.classList.add('measured');
    const groups = [...list.children];
    for (const group of groups) group.classList.remove('yields');
    write(more, 'hidden', true);
    for (const group of groups.reverse()) {
      if (row.scrollWidth <= row.clientWidth) break;
      group.classList.add('yields');
      write(more, 'hidden', false);
    }
    const { tab } = timeline.view.get();
    const chosen = isOpen() && inMore().some(({ name }) => name === tab);
    setText(more, chosen ? TABS[tab].label : 'More');
    more.classList.toggle('chosen', chosen);
    // One of them has to be the stop of the keyboard.
    const all = tabs.flat().filter(({ element: one }) => !one.hidden && !one.closest('.yields'));
    if (all.length && !all.some(({ element: one }) => one.tabIndex === 0)) all[0].element.tabIndex = 0;
  };
  new ResizeObserver(giveWay).observe(row);
  timeline.view.subscribe((now, before) => {
    if (now.tab !== before.tab || now.together !== before.together) show();
  });
  wb.store.subscribe((now, before) => {
    if (now.document.review !== before.document.review) show();
  });
  wb.settings.subscribe((now, before) => {
    if (now.panels !== before.panels) show();
  });
  window.matchMedia(NARROW).addEventListener('change', show, { signal });
  show();
  return row;
}
