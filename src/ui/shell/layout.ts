/**
 * Layout of the page:
 *
 *     menu bar
 *     outliner | viewport | inspector        outliner and inspector collapse, and become drawers on a narrow page
 *     transport
 *     timeline: curves or dope sheet         collapses; hidden on a narrow page
 */
import { element } from '../kit/dom.ts';
import { isPanelOpen, NARROW, openPanel } from '../state/panels.ts';
import { clampSize, splitter } from '../state/splitter.ts';
import type { Uses } from '../state/workbench.ts';

/** Sizes chosen by the layout until the user sets them. */
const HEIGHTS = [
  ['filesHeight', '--files-height'],
  ['timelineHeight', '--timeline-height'],
] as const;

export interface Parts {
  readonly menuBar: HTMLElement;
  readonly outliner: HTMLElement;
  readonly stage: HTMLElement;
  readonly inspector: HTMLElement;
  readonly transport: HTMLElement;
  readonly timeline: HTMLElement;
}

export function layout(wb: Uses<'settings'>, root: HTMLElement, parts: Parts, signal: AbortSignal): void {
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
  // Replaces the frame of `index.html`.
  root.className = 'page';
  root.replaceChildren(parts.menuBar, body, parts.transport, parts.timeline);

  const narrow = window.matchMedia(NARROW);
  const show = () => {
    const settings = wb.settings.get();
    const { panels } = settings;
    root.style.setProperty('--outliner-width', `${clampSize('outlinerWidth', panels.outlinerWidth)}px`);
    root.style.setProperty('--inspector-width', `${clampSize('inspectorWidth', panels.inspectorWidth)}px`);
    for (const [size, property] of HEIGHTS) {
      if (panels[size]) root.style.setProperty(property, `${clampSize(size, panels[size])}px`);
      else root.style.removeProperty(property);
    }
    root.classList.toggle('narrow', narrow.matches);
    for (const name of ['outliner', 'inspector'] as const) {
      const open = isPanelOpen(settings, name);
      root.classList.toggle(`${name}-folded`, !open);
      // Hidden panels can't have the focus either.
      parts[name].inert = !open;
    }
  };
  const closeDrawers = () => {
    openPanel(wb, 'outliner', false);
    openPanel(wb, 'inspector', false);
  };
  wb.settings.subscribe((now, before) => {
    if (now.panels !== before.panels) show();
  });
  narrow.addEventListener('change', show, { signal });
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
  show();
}
