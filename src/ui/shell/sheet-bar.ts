/** The bar at the foot of phones and upright tablets: the panels, which open as sheets above it. */

import { tryById } from '../state/actions/action.ts';
import { isPanelOpen, NARROW, openPanel, type PanelName } from '../state/panels/panels.ts';
import { shownTabs } from '../state/timeline.ts';
import type { Uses } from '../state/workbench.ts';
import { element, keepsFocusElsewhere, setAttribute } from '../widgets/dom.ts';
import { type IconName, icon } from '../widgets/icons.ts';

interface Sheet {
  readonly label: string;
  readonly icon: IconName;
  readonly panel: PanelName;
  /** Opens it. */
  readonly action: string;
  /** Of a sheet that is one of the timeline's tabs. */
  readonly tab?: 'curves' | 'takes';
}

const SHEETS: readonly Sheet[] = [
  { label: 'Joints', icon: 'outliner', panel: 'outliner', action: 'page.outliner' },
  { label: 'Curves', icon: 'curveTools', panel: 'timeline', action: 'page.tab.curves', tab: 'curves' },
  { label: 'Takes', icon: 'take', panel: 'timeline', action: 'page.tab.takes', tab: 'takes' },
  { label: 'Inspector', icon: 'inspector', panel: 'inspector', action: 'page.inspector' },
];

export function sheetBar(wb: Uses<'actions' | 'settings' | 'timeline'>, signal: AbortSignal): HTMLElement {
  const isOpen = ({ panel, tab }: Sheet) =>
    isPanelOpen(wb.settings.get(), panel) && (!tab || shownTabs(wb.timeline.view.get()).includes(tab));
  const made = SHEETS.map((sheet) => {
    const { label } = sheet;
    const one = element('button', { type: 'button' }, icon(sheet.icon), label);
    one.addEventListener('click', () => {
      if (isOpen(sheet)) openPanel(wb, sheet.panel, false);
      else tryById(wb, sheet.action);
    });
    return keepsFocusElsewhere(one);
  });
  const show = () => {
    for (const [i, sheet] of SHEETS.entries()) setAttribute(made[i], 'aria-pressed', String(isOpen(sheet)));
  };
  wb.settings.subscribe(show);
  wb.timeline.view.subscribe(show);
  window.matchMedia(NARROW).addEventListener('change', show, { signal });
  show();
  return element('nav', { class: 'sheet-bar', 'aria-label': 'Panels' }, ...made);
}
