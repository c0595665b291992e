/**
 * The cell at the left of the ruler: the take that is shown, with its active layer, and a menu of the takes that could
 * be and of layers.
 */

import { activeLayer } from '../../../model/takes/layers.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import { sectionsOf } from '../../state/actions/menu-entries.ts';
import type { Uses } from '../../state/workbench.ts';
import { element, keepsFocusElsewhere, setAttribute, setText, write } from '../../widgets/dom.ts';
import { icon } from '../../widgets/icons.ts';
import { type MenuEntry, menuButton } from '../../widgets/menu.ts';
import { middleCut } from '../../widgets/middle-cut.ts';
import { setTooltip } from '../../widgets/tooltip.ts';
import { currentTake } from '../timeline/current-take.ts';
import { playAlone } from './play.ts';
import { shownKey, takeRows } from './rows.ts';

/** More are found faster in the list of takes. */
const MAX_IN_MENU = 24;

export function takeCell(
  wb: Uses<'store' | 'actions' | 'viewport' | 'transport' | 'timeline' | 'settings' | 'messages'>,
): HTMLElement {
  const name = middleCut('take-cell-name');
  const active = element('span', { class: 'take-cell-layer', hidden: true });
  setTooltip(active, 'The layer that poses and keys go into');
  const made = keepsFocusElsewhere(
    element(
      'button',
      { type: 'button', class: 'take-cell', 'data-panel': 'transport' },
      icon('take'),
      name.element,
      active,
      icon('fold'),
    ),
  );
  menuButton(made, 'Takes', (): MenuEntry[] => {
    const character = currentCharacter(wb);
    const shown = character && shownKey(character);
    const rows = takeRows(wb.store.document).filter((row) => row.characterId === character?.id);
    const others: MenuEntry[] = rows.slice(0, MAX_IN_MENU).map((row) => ({
      kind: 'item',
      label: row.name,
      enabled: true,
      checked: row.key === shown,
      radio: true,
      run: () => playAlone(wb, row),
    }));
    const edits = sectionsOf(wb, [
      ['take.list', 'Keys/Layers'],
      ['take.new', 'take.duplicate', 'take.rename', 'take.remove'],
    ]);
    return others.length ? [...others, { kind: 'line' }, ...edits] : edits;
  });
  const show = () => {
    const take = currentTake(wb)?.take;
    const layer = take && activeLayer(take)?.name;
    name.show(take?.name ?? 'No take');
    setText(active, layer ?? '');
    write(active, 'hidden', layer === undefined);
    made.classList.toggle('faint', take === undefined);
    setAttribute(made, 'aria-label', take ? `Take ${take.name}${layer ? `, layer ${layer}` : ''}` : 'No take');
  };
  wb.store.subscribe((now, before) => {
    if (now.document !== before.document || now.selection.characterId !== before.selection.characterId) show();
  });
  show();
  return made;
}
