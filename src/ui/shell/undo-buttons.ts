/** Undo and redo, in the menu bar at all sizes: on a touch screen there are no keys for them. */

import { actionLabel, findAction, reasonNot, tryAction } from '../state/actions/action.ts';
import { setActionTooltip } from '../state/actions/tooltips.ts';
import type { Action, Uses } from '../state/workbench.ts';
import { button, element, keepsFocusElsewhere, setAttribute } from '../widgets/dom.ts';
import { icon } from '../widgets/icons.ts';

/** Two buttons. Their names and tooltips tell the step, or why there is none. */
export function undoButtons(wb: Uses<'store' | 'actions' | 'settings'>): HTMLElement {
  const all = element('div', { class: 'undo-buttons', role: 'group', 'aria-label': 'Undo and redo' });
  for (const way of ['undo', 'redo'] as const) {
    const action = findAction(wb, `edit.${way}`);
    if (action) all.append(stepButton(wb, action, way));
  }
  return all;
}

function stepButton(
  wb: Uses<'store' | 'actions' | 'settings'>,
  action: Action,
  name: 'undo' | 'redo',
): HTMLButtonElement {
  const made = keepsFocusElsewhere(button(action.id, { class: 'tool' }, icon(name), () => tryAction(wb, action)));
  let shown: string | undefined;
  const show = () => {
    const reason = reasonNot(wb, action);
    const label = actionLabel(wb, action);
    if (label === shown) return;
    shown = label;
    // Not `disabled`: a press then tells the reason.
    setAttribute(made, 'aria-disabled', String(reason !== undefined));
    setAttribute(made, 'aria-label', label);
    setActionTooltip(wb, made, action.id, reason ?? label);
  };
  wb.store.subscribe(show);
  show();
  return made;
}
