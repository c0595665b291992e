/**
 * The right panel, in place from the start; its content is loaded after the first picture, playing or not. While the
 * manual is read, it has this place.
 */

import { MANUAL_WINDOW, type ManualPage } from '../state/manual-link.ts';
import { onDemand, soon } from '../state/on-demand.ts';
import { isPanelOpen, openPanel } from '../state/panels/panels.ts';
import type { Uses, Workbench } from '../state/workbench.ts';
import { element } from '../widgets/dom.ts';
import { returnFocus } from '../widgets/focus/focus-regions.ts';
import type { ManualPanel } from './help/manual-panel.ts';

export interface InspectorPanel {
  readonly element: HTMLElement;
  /** Resolves when its content is there, or couldn't be loaded. */
  readonly filled: Promise<void>;
}

export function inspectorPanel(wb: Workbench, signal: AbortSignal): InspectorPanel {
  const panel = element('section', { class: 'panel inspector', 'aria-label': 'Inspector', 'data-panel': 'inspector' });
  const fill = async () => {
    const module = await onDemand(wb.messages, 'The inspector', () => import('../editors/inspector/inspector.ts'));
    module?.fillInspector(wb, panel);
  };
  const filled = new Promise<void>((done) => soon(wb, () => done(fill())));
  showManualIn(wb, panel);
  followManualLinks(wb, signal);
  return { element: panel, filled };
}

function showManualIn(wb: Uses<'manual' | 'messages' | 'settings'>, panel: HTMLElement): void {
  let shown: ManualPanel | undefined;
  let wasOpen = true;
  wb.manual.subscribe(async (asked, before) => {
    if (asked && !before) wasOpen = isPanelOpen(wb.settings.get(), 'inspector');
    if (!asked) {
      const hadFocus = shown?.element.contains(document.activeElement);
      shown?.element.remove();
      panel.classList.remove('has-manual');
      openPanel(wb, 'inspector', wasOpen);
      if (hadFocus) returnFocus();
      return;
    }
    const module = await onDemand(wb.messages, 'The manual', () => import('./help/manual-panel.ts'));
    // Closed meanwhile, or another page was asked for.
    if (!module || wb.manual.get() !== asked) return;
    shown ??= new module.ManualPanel(() => wb.manual.set(undefined));
    panel.append(shown.element);
    panel.classList.add('has-manual');
    openPanel(wb, 'inspector', true);
    shown.show(asked.page);
  });
}

/** Links into the manual open it here, unless a dialog is in the way or another window was asked for. */
function followManualLinks(wb: Uses<'manual' | 'dialog'>, signal: AbortSignal): void {
  const follow = (event: MouseEvent) => {
    const link =
      event.target instanceof Element && event.target.closest<HTMLAnchorElement>(`a[target=${MANUAL_WINDOW}]`);
    if (!link || wb.dialog.get() || event.ctrlKey || event.metaKey || event.shiftKey) return;
    event.preventDefault();
    // The addresses of such links are made from pages (`manualAnchor`).
    wb.manual.set({ page: link.href.slice(new URL('manual/', document.baseURI).href.length) as ManualPage });
  };
  document.addEventListener('click', follow, { signal });
}
