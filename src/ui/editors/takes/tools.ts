/** Controls of the takes tab, beside the tabs: a filter, and actions on the selected takes. */

import { button, element, keepsFocusElsewhere, setText } from '../../kit/dom.ts';
import { focusPanel } from '../../kit/focus.ts';
import { oncePerFrame } from '../../kit/frame.ts';
import { icon } from '../../kit/icons.ts';
import { type MenuEntry, menuButton } from '../../kit/menu.ts';
import { toolbar } from '../../kit/roving.ts';
import { setTooltip } from '../../kit/tooltip.ts';
import { actionLabel, findAction, isEnabled, tryAction } from '../../state/action.ts';
import { itemOf } from '../../state/menu-entries.ts';
import { setActionTooltip } from '../../state/tooltips.ts';
import type { Uses } from '../../state/workbench.ts';
import { chosenTakes, listOfTakes } from './play.ts';
import { takeRows } from './rows.ts';
import { countText } from './table.ts';

/** Buttons with texts and tooltips. */
const BUTTONS: readonly (readonly [id: string, text: string, tooltip: string])[] = [
  ['take.alone', 'Alone', 'Play selected take alone (Enter)'],
  ['take.together', 'Together', 'Play only the selected takes, together'],
  ['take.compare', 'Compare', 'Overlay two selected takes and measure the distance between their joints'],
  ['take.showAll', 'Show all', 'Show all characters'],
];
const ARRANGING = ['take.alignStarts', 'take.resetOffsets', 'line', 'take.put.grid', 'take.put.spot', 'take.put.space'];

export function takeTools(wb: Uses<'store' | 'actions' | 'timeline' | 'settings'>): HTMLElement {
  const refreshing: (() => void)[] = [];
  const buttons = BUTTONS.map(([id, text, tooltip]) => {
    const action = findAction(wb, id);
    const made = keepsFocusElsewhere(
      button(tooltip, { class: 'tool text-tool' }, text, () => action && tryAction(wb, action)),
    );
    refreshing.push(() => {
      made.disabled = !(action && isEnabled(wb, action));
      if (id !== 'take.compare' || !action) return;
      setText(made, wb.timeline.takes.comparison.get() ? 'Stop comparing' : text);
      made.setAttribute('aria-label', actionLabel(wb, action));
    });
    return made;
  });
  const arrange = keepsFocusElsewhere(
    element('button', { type: 'button', class: 'tool text-tool' }, 'Arrange', icon('fold')),
  );
  setTooltip(arrange, 'When and where the selected takes play, or all visible ones');
  menuButton(arrange, 'Arrange', () => arrangeEntries(wb));
  const step = (id: string, label: string, name: 'previousTake' | 'nextTake') => {
    const action = findAction(wb, id);
    const made = keepsFocusElsewhere(
      button(label, { class: 'tool' }, icon(name), () => action && tryAction(wb, action)),
    );
    setActionTooltip(wb, made, id, label);
    return made;
  };
  const counted = element('span', { class: 'take-count', role: 'status' });
  const show = () => {
    for (const refresh of refreshing) refresh();
    const { document } = wb.store;
    setText(counted, countText(listOfTakes(wb).length, takeRows(document).length, chosenTakes(wb).length));
  };
  const showSoon = oncePerFrame(show);
  wb.store.subscribe(showSoon);
  wb.timeline.takes.view.subscribe(showSoon);
  wb.timeline.takes.comparison.subscribe(showSoon);
  show();
  return element(
    'div',
    { class: 'take-tools' },
    takeFilter(wb),
    toolbar(
      element(
        'div',
        { class: 'tools', 'aria-label': 'Takes' },
        step('take.previous', 'Previous take', 'previousTake'),
        step('take.next', 'Next take', 'nextTake'),
        ...buttons,
        arrange,
      ),
    ),
    counted,
  );
}

export function arrangeEntries(wb: Uses<'actions' | 'settings'>): MenuEntry[] {
  return ARRANGING.flatMap((id): MenuEntry[] => {
    const action = findAction(wb, id);
    if (action) return [itemOf(wb, action)];
    return id === 'line' ? [{ kind: 'line' }] : [];
  });
}

function takeFilter(wb: Uses<'timeline'>): HTMLElement {
  const { takes } = wb.timeline;
  const input = element('input', {
    type: 'search',
    'aria-label': 'Filter takes by name',
    placeholder: 'Filter',
    spellcheck: 'false',
    autocomplete: 'off',
  });
  input.addEventListener('input', () => takes.change({ filter: input.value }));
  input.addEventListener('keydown', (event) => {
    if (event.isComposing) return;
    if (event.key === 'Escape' && input.value) takes.change({ filter: '' });
    else if (event.key === 'Enter' || event.key === 'ArrowDown') focusPanel(input);
    else return;
    event.preventDefault();
  });
  takes.view.subscribe(({ filter }) => {
    if (input.value !== filter) input.value = filter;
  });
  return element('div', { class: 'search take-filter' }, icon('search'), input);
}
