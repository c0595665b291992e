/** Controls of the dope sheet: a name filter, and switches in the row of tabs. */

import { findAction, isChecked, tryAction } from '../../state/actions/action.ts';
import { setActionTooltip } from '../../state/actions/tooltips.ts';
import type { Uses } from '../../state/workbench.ts';
import { button, element, keepsFocusElsewhere, setAttribute } from '../../widgets/dom.ts';
import { toolbar } from '../../widgets/focus/roving.ts';
import { icon } from '../../widgets/icons.ts';

/** Switches and their tooltips. */
const SWITCHES: Readonly<Record<string, string>> = {
  'dope.ripples': 'Ripple: later keys move along with dragged ones. Hold Alt while dragging to invert',
  'timeline.snapsToFrames': 'Snap to frames. Hold Ctrl while dragging to invert',
  'dope.allRows': 'Show rows without keys',
};

export function dopeTools(wb: Uses<'actions' | 'timeline' | 'settings'>): HTMLElement {
  const tools = toolbar(element('div', { class: 'tools dope-tools', 'aria-label': 'Dope sheet' }));
  for (const [id, text] of Object.entries(SWITCHES)) {
    const action = findAction(wb, id);
    if (!action?.icon) continue;
    const made = keepsFocusElsewhere(
      button(text.split(/[:;]/)[0], { class: 'tool' }, icon(action.icon), () => tryAction(wb, action)),
    );
    setActionTooltip(wb, made, id, text);
    const show = () => setAttribute(made, 'aria-pressed', String(isChecked(wb, action) ?? false));
    wb.timeline.view.subscribe(show);
    show();
    tools.append(made);
  }
  return tools;
}

/** Part of a joint's or channel's name: one filter for curves and dope sheet. */
export function dopeFilter(wb: Uses<'timeline'>): HTMLElement {
  const input = element('input', {
    type: 'search',
    'aria-label': 'Filter rows by name',
    placeholder: 'Filter',
    spellcheck: 'false',
    autocomplete: 'off',
  });
  const show = () => {
    const { filter } = wb.timeline.view.get();
    if (input.value !== filter) input.value = filter;
  };
  input.addEventListener('input', () => wb.timeline.change({ filter: input.value }));
  input.addEventListener('keydown', (event) => {
    if (event.key !== 'Escape' || !input.value) return;
    event.preventDefault();
    wb.timeline.change({ filter: '' });
  });
  wb.timeline.view.subscribe(show);
  show();
  return element('div', { class: 'search dope-filter' }, icon('search'), input);
}
