/**
 * Layout of the page:
 *
 *     menu bar
 *     outliner | viewport | inspector        outliner and inspector collapse, and become drawers on a narrow page
 *     transport                              neither without a take, while the timeline is collapsed
 *     timeline: the ruler, and below it curves, dope sheet and lists, which collapse and are collapsed at first
 *
 * On phones and upright tablets the ruler is above the transport, the panels are sheets above both, and the bar of
 * sheets is at the foot (`sheet-bar.ts`).
 */

import { isBarShown, isPanelOpen, NARROW, openPanel, SHEETS } from '../state/panels/panels.ts';
import { splitter } from '../state/panels/splitter.ts';
import type { Uses } from '../state/workbench.ts';
import { element, setAttribute, write } from '../widgets/dom.ts';
import { REGION } from '../widgets/focus/focus.ts';
import { returnFocus } from '../widgets/focus/focus-regions.ts';
import { sizePanels } from './panel-sizes.ts';

export interface Parts {
  readonly menuBar: HTMLElement;
  readonly outliner: HTMLElement;
  readonly stage: HTMLElement;
  readonly inspector: HTMLElement;
  readonly transport: HTMLElement;
  readonly timeline: HTMLElement;
  readonly status: HTMLElement;
  readonly sheetBar: HTMLElement;
}

/** @param tabs of the timeline, which are in the transport, or on a sheet in the timeline itself */
export function layout(
  wb: Uses<'store' | 'settings' | 'viewport'>,
  root: HTMLElement,
  parts: Parts,
  tabs: HTMLElement,
  signal: AbortSignal,
): void {
  const veil = element('div', { class: 'drawer-veil', 'aria-hidden': 'true' });
  const body = element(
    'div',
    { class: 'page-body' },
    parts.outliner,
    splitter(wb, 'outlinerWidth', 'Width of the outliner'),
    parts.stage,
    splitter(wb, 'inspectorWidth', 'Width of the inspector'),
    parts.inspector,
    veil,
  );
  for (const [region, part] of Object.entries<HTMLElement>({ ...parts })) {
    setAttribute(part, REGION, region);
    const name = part.getAttribute('aria-label');
    if (name && part.localName !== 'footer') part.prepend(element('h2', { class: 'off-screen' }, name));
  }
  // Replaces the frame of `index.html`.
  write(root, 'className', 'page');
  parts.stage.append(parts.status);
  root.replaceChildren(parts.menuBar, body, parts.transport, parts.timeline, parts.sheetBar);

  const narrow = window.matchMedia(NARROW);
  const sheets = window.matchMedia(SHEETS);
  const tabsInTransport = tabs.parentElement;
  const placeTabs = () => (sheets.matches ? parts.timeline : tabsInTransport)?.append(tabs);
  const show = () => {
    const settings = wb.settings.get();
    sizePanels(root, settings);
    for (const each of [parts.transport, parts.timeline]) write(each, 'hidden', !isBarShown(wb));
    root.classList.toggle('narrow', narrow.matches);
    for (const name of ['outliner', 'inspector'] as const) {
      const hadFocus = parts[name].contains(document.activeElement);
      // Hidden panels can't have the focus either.
      parts[name].inert = !isPanelOpen(settings, name);
      if (hadFocus && parts[name].inert) returnFocus();
    }
  };
  const closeDrawers = () => {
    openPanel(wb, 'outliner', false);
    openPanel(wb, 'inspector', false);
  };
  wb.settings.subscribe((now, before) => {
    if (now.panels !== before.panels) show();
  });
  wb.store.subscribe((now, before) => {
    if (now.document === before.document || isBarShown(wb) !== parts.timeline.hidden) return;
    show();
    // What was opened is framed in the next frame, before the viewport would hear of its size.
    wb.viewport.fitScreen();
  });
  narrow.addEventListener('change', show, { signal });
  sheets.addEventListener('change', placeTabs, { signal });
  veil.addEventListener('click', closeDrawers);
  root.addEventListener(
    'keydown',
    (event) => {
      const { drawer } = wb.settings.get().panels;
      if (event.key !== 'Escape' || !narrow.matches || event.defaultPrevented || drawer === 'none') return;
      event.preventDefault();
      closeDrawers();
    },
    { signal },
  );
  placeTabs();
  show();
}
