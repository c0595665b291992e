/**
 * The panels: around the viewport if there is room, and remembered so. On a narrow page, side panels are drawers over
 * it, at most one open, and the timeline a drawer below it; initially all are closed. On phones and upright tablets all
 * three are sheets below the viewport, at most one open.
 */
import type { Settings } from '../settings.ts';
import type { Uses } from '../workbench.ts';

export type PanelName = 'outliner' | 'inspector' | 'timeline';

/** Where panels are drawers. */
export const NARROW = '(max-width: 1023px), (max-height: 479px)';

/** Where panels are sheets: `styles/sheets.css`. */
export const SHEETS = '(max-width: 860px) and (min-height: 480px)';

function isNarrow(query = NARROW): boolean {
  return globalThis.matchMedia?.(query).matches ?? false;
}

export function isPanelOpen({ panels }: Settings, panel: PanelName): boolean {
  if (panel === 'timeline') return isNarrow() ? panels.timelineDrawer : panels.timelineOpen;
  if (isNarrow()) return panels.drawer === panel;
  return panel === 'outliner' ? panels.outlinerOpen : panels.inspectorOpen;
}

/** Whether transport and timeline are on the page: without any take there is nothing to play, unless a tab is open. */
export function isBarShown({ store, settings }: Uses<'store' | 'settings'>): boolean {
  return (
    isPanelOpen(settings.get(), 'timeline') || store.document.characters.some((c) => c.takes.length > 0 || c.driver)
  );
}

export function openPanel(wb: Uses<'settings'>, panel: PanelName, open: boolean): void {
  const now = wb.settings.get();
  if (isPanelOpen(now, panel) === open) return;
  const alone = open && isNarrow(SHEETS);
  const change = !isNarrow()
    ? { [`${panel}Open`]: open }
    : panel === 'timeline'
      ? { timelineDrawer: open, ...(alone && { drawer: 'none' as const }) }
      : { drawer: open ? panel : ('none' as const), ...(alone && { timelineDrawer: false }) };
  wb.settings.set({ ...now, panels: { ...now.panels, ...change } });
}
