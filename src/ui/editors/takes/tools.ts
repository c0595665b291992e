/** Controls of the takes tab, beside the tabs: a filter, and actions on the selected takes. */

import { actionLabel, findAction, isEnabled, tryAction } from '../../state/actions/action.ts';
import { itemOf } from '../../state/actions/menu-entries.ts';
import { setActionTooltip } from '../../state/actions/tooltips.ts';
import type { Uses } from '../../state/workbench.ts';
import { button, element, keepsFocusElsewhere, setAttribute, setText, write } from '../../widgets/dom.ts';
import { focusPanel } from '../../widgets/focus/focus.ts';
import { isMac } from '../../widgets/focus/keyboard.ts';
import { toolbar } from '../../widgets/focus/roving.ts';
import { oncePerFrame } from '../../widgets/frame.ts';
import { icon } from '../../widgets/icons.ts';
import { type MenuEntry, menuButton } from '../../widgets/menu.ts';
import { setTooltip } from '../../widgets/tooltip.ts';
import { compareEntries } from './compare-menu.ts';
import { chosenTakes, listOfTakes } from './play.ts';
import { takeRows } from './rows.ts';
import { countTexts } from './table.ts';
import { takesToCompare, takeToCompare } from './which-takes.ts';

/** Buttons with texts and tooltips. */
const BUTTONS: readonly (readonly [id: string, text: string, tooltip: string])[] = [
  ['take.alone', 'Alone', 'Play selected take alone (Enter)'],
  ['take.together', 'Together', 'Play only the selected takes, together'],
  ['take.showAll', 'Show all', 'Show all characters'],
];
/** Takes that are found without a filter. */
const FEW = 6;
const COMPARE_TIP = `Overlays two takes and measures the distance between their joints. ${isMac ? 'Cmd' : 'Ctrl'}+click a second take, or choose it in the menu`;
const ARRANGING = ['take.alignStarts', 'take.resetOffsets', 'line', 'take.put.grid', 'take.put.spot', 'take.put.space'];

export function takeTools(
  wb: Uses<'store' | 'viewport' | 'transport' | 'actions' | 'timeline' | 'settings' | 'messages' | 'dialog'>,
): HTMLElement {
  const refreshing: (() => void)[] = [];
  const buttons = BUTTONS.map(([id, text, tooltip]) => {
    const action = findAction(wb, id);
    const made = keepsFocusElsewhere(
      button(tooltip, { class: 'tool text-tool' }, text, () => action && tryAction(wb, action)),
    );
    refreshing.push(() => {
      write(made, 'disabled', !(action && isEnabled(wb, action)));
    });
    return made;
  });
  const { element: compare, refresh: refreshCompare } = compareButton(wb);
  refreshing.push(refreshCompare);
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
  const counted = element('span');
  const chosen = element('span');
  const filter = takeFilter(wb);
  const show = () => {
    for (const refresh of refreshing) refresh();
    const count = takeRows(wb.store.document).length;
    const [takes, selected] = countTexts(listOfTakes(wb).length, count, chosenTakes(wb).length);
    setText(counted, takes);
    setText(chosen, selected);
    const { comparison, view } = wb.timeline.takes;
    tools.classList.toggle('few', (count <= FEW || comparison.get() !== undefined) && !view.get().filter);
  };
  const showSoon = oncePerFrame(show);
  wb.store.subscribe(showSoon);
  wb.timeline.takes.view.subscribe(showSoon);
  wb.timeline.takes.comparison.subscribe(showSoon);
  const tools = element(
    'div',
    { class: 'take-tools' },
    filter,
    toolbar(
      element(
        'div',
        { class: 'tools', 'aria-label': 'Takes' },
        step('take.previous', 'Previous take', 'previousTake'),
        step('take.next', 'Next take', 'nextTake'),
        // First: on small pages later ones are scrolled to.
        compare,
        ...buttons,
        arrange,
      ),
    ),
    element('span', { class: 'take-count', role: 'status' }, counted, chosen),
  );
  show();
  return tools;
}

/** Compares the two selected takes, or the only two; otherwise a menu of those that one can be compared with. */
function compareButton(
  wb: Uses<'store' | 'viewport' | 'transport' | 'actions' | 'timeline' | 'settings' | 'messages' | 'dialog'>,
): { readonly element: HTMLElement; refresh(): void } {
  const action = findAction(wb, 'take.compare');
  const label = element('span', {}, 'Compare');
  const made = keepsFocusElsewhere(element('button', { type: 'button', class: 'tool text-tool' }, label, icon('fold')));
  const isComparing = () => wb.timeline.takes.comparison.get() !== undefined;
  const runsAtOnce = () => isComparing() || takesToCompare(wb) !== undefined;
  menuButton(
    made,
    'Compare with',
    () => {
      const row = takeToCompare(wb);
      return row ? compareEntries(wb, row) : [];
    },
    () => {
      if (!action || !runsAtOnce()) return false;
      tryAction(wb, action);
      return true;
    },
  );
  const refresh = () => {
    const atOnce = runsAtOnce();
    write(made, 'disabled', !isComparing() && takeRows(wb.store.document).length < 2);
    setText(label, isComparing() ? 'Stop comparing' : 'Compare');
    made.classList.toggle('at-once', atOnce);
    setAttribute(made, 'aria-haspopup', atOnce ? undefined : 'menu');
    setAttribute(made, 'aria-label', atOnce && action ? actionLabel(wb, action) : 'Compare with');
    const tip = made.disabled ? 'Comparing needs two takes: open another capture or animation' : COMPARE_TIP;
    setTooltip(made, isComparing() ? 'Restore the view from before comparing' : tip);
  };
  return { element: made, refresh };
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
