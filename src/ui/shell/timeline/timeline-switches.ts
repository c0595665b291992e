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

type Parts = Uses<'store' | 'actions' | 'timeline' | 'settings'>;

/** @param onClick a tab was clicked with the mouse, which means working there */
export function timelineSwitches(wb: Parts, onClick: () => void, signal: AbortSignal): HTMLElement {
  return new Switches(wb, onClick, signal).element;
}

interface Tab {
  readonly name: TimelineTabName;
  readonly element: HTMLElement;
}

class Switches {
  readonly element: HTMLElement;
  private readonly tabs: readonly (readonly Tab[])[];
  private readonly list: HTMLElement;
  private readonly more = keepsFocusElsewhere(
    element('button', { type: 'button', class: 'plain timeline-more' }, 'More'),
  );
  private readonly fold: HTMLElement;

  constructor(
    private readonly wb: Parts,
    private readonly onClick: () => void,
    signal: AbortSignal,
  ) {
    this.tabs = GROUPS.map((names) => names.map((name) => this.tabOf(name)));
    this.list = element(
      'div',
      { role: 'tablist', class: 'timeline-tabs', 'aria-label': 'Timeline', 'aria-multiselectable': 'true' },
      ...this.tabs.map((group) =>
        element('span', { class: 'tab-group', role: 'presentation' }, ...group.map((t) => t.element)),
      ),
    );
    this.list.addEventListener('keydown', (event) => this.onKey(event));
    menuButton(this.more, 'More panels', () => this.entriesOfMore());
    this.fold = keepsFocusElsewhere(
      button('Timeline panel', { class: 'tool timeline-button' }, icon('fold'), () => tryById(wb, 'page.timeline')),
    );
    setActionTooltip(wb, this.fold, 'page.timeline', () => (this.isOpen() ? 'Collapse timeline' : 'Open timeline'));
    this.element = element('div', { class: 'timeline-switches' }, this.list, this.more, this.fold);
    new ResizeObserver(() => this.giveWay()).observe(this.element);
    wb.timeline.view.subscribe((now, before) => {
      if (now.tab !== before.tab || now.together !== before.together) this.show();
    });
    wb.store.subscribe((now, before) => {
      if (now.document.review !== before.document.review) this.show();
    });
    wb.settings.subscribe((now, before) => {
      if (now.panels !== before.panels) this.show();
    });
    window.matchMedia(NARROW).addEventListener('change', () => this.show(), { signal });
    this.show();
  }

  private isOpen(): boolean {
    return isPanelOpen(this.wb.settings.get(), 'timeline');
  }

  private tabOf(name: TimelineTabName): Tab {
    const { label } = TABS[name];
    const id = `timeline-tab-${name}`;
    const made = button(label, { role: 'tab', class: 'timeline-tab', id, tooltip: '' }, label, () => this.press(name));
    made.addEventListener('click', ({ detail }) => {
      if (detail > 0) this.onClick();
    });
    return { name, element: keepsFocusElsewhere(made) };
  }

  private press(name: TimelineTabName): void {
    const { timeline } = this.wb;
    const change = afterPress(timeline.view.get(), this.isOpen(), name);
    if (change) timeline.change(change);
    openPanel(this.wb, 'timeline', change !== undefined);
  }

  private inRow(): readonly Tab[] {
    return this.tabs.flat().filter(({ element: tab }) => !tab.hidden && !tab.closest('.yields'));
  }

  private inMore(): readonly Tab[] {
    return this.tabs.flat().filter(({ element: tab }) => tab.closest('.yields') && !tab.hidden);
  }

  private entriesOfMore(): MenuEntry[] {
    const isOpen = this.isOpen();
    return this.inMore().map(({ name }) => ({
      kind: 'item',
      label: TABS[name].label,
      enabled: true,
      radio: true,
      checked: isOpen && this.wb.timeline.view.get().tab === name,
      run: () => this.press(name),
    }));
  }

  private onKey(event: KeyboardEvent): void {
    if (event.key !== 'ArrowLeft' && event.key !== 'ArrowRight') return;
    event.preventDefault();
    const all = this.inRow();
    const from = all.findIndex(({ element: tab }) => tab === document.activeElement);
    const to = all[(from + (event.key === 'ArrowLeft' ? all.length - 1 : 1)) % all.length];
    for (const { element: tab } of all) write(tab, 'tabIndex', tab === to.element ? 0 : -1);
    to.element.focus();
  }

  private show(): void {
    const { store, timeline } = this.wb;
    const view = timeline.view.get();
    const shown = this.isOpen() ? shownTabs(view) : [];
    for (const { name, element: tab } of this.tabs.flat()) {
      setAttribute(tab, 'aria-selected', String(shown.includes(name)));
      write(tab, 'tabIndex', name === view.tab ? 0 : -1);
      write(tab, 'hidden', name !== view.tab && TABS[name].isListed?.(store.document) === false);
    }
    setAttribute(this.fold, 'aria-pressed', String(this.isOpen()));
    // Not known before the page has it.
    if (this.element.isConnected) this.giveWay();
  }

  /** By the tab that is open, if it is in there: a name that takes more room. */
  private nameMore(): void {
    const { tab } = this.wb.timeline.view.get();
    const chosen = this.isOpen() && this.inMore().some(({ name }) => name === tab);
    setText(this.more, chosen ? TABS[tab].label : 'More');
    this.more.classList.toggle('chosen', chosen);
  }

  /** What yields depends on widths: before a frame is drawn with others. */
  private giveWay(): void {
    const { element: row, list, more } = this;
    if (row.clientWidth === 0) return;
    list.classList.add('measured');
    const groups = [...list.children];
    for (const group of groups) group.classList.remove('yields');
    write(more, 'hidden', true);
    for (const group of groups.reverse()) {
      if (row.scrollWidth <= row.clientWidth) break;
      group.classList.add('yields');
      write(more, 'hidden', false);
      this.nameMore();
    }
    // One of them has to be the stop of the keyboard.
    const all = this.inRow();
    if (all.length && !all.some(({ element: one }) => one.tabIndex === 0)) all[0].element.tabIndex = 0;
  }
}
