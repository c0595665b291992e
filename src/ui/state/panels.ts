/**
 * The side panels: beside the viewport if there is room, and remembered so; on a narrow page drawers over it, at most
 * one open, initially none.
 */
import type { Settings } from './settings.ts';
import type { Uses } from './workbench.ts';

export type PanelName = 'outliner' | 'inspector' | 'timeline';

/** Where panels are drawers. */
export const NARROW = '(max-width: 1023px), (max-height: 479px)';

function isNarrow(): boolean {
  return globalThis.matchMedia?.(NARROW).matches ?? false;
}

export function isPanelOpen({ panels }: Settings, panel: PanelName): boolean {
  // Narrow pages have no room for it.
  if (panel === 'timeline') return panels.timelineOpen && !isNarrow();
  if (isNarrow()) return panels.drawer === panel;
  return panel === 'outliner' ? panels.outlinerOpen : panels.inspectorOpen;
}

export function openPanel(wb: Uses<'settings'>, panel: PanelName, open: boolean): void {
  const now = wb.settings.get();
  if (isPanelOpen(now, panel) === open) return;
  const beside = { [`${panel}Open`]: open };
  const change = isNarrow() && panel !== 'timeline' ? { drawer: open ? panel : ('none' as const) } : beside;
  wb.settings.set({ ...now, panels: { ...now.panels, ...change } });
}
