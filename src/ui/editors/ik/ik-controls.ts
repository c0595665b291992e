/** IK controls beside the mode switch: whether the root may move, removing all pins, and a hint. */

import { ikOf } from '../../../evaluate/ik/set-up.ts';
import { button, element, keepsFocusElsewhere, setAttribute, setText } from '../../kit/dom.ts';
import { oncePerFrame } from '../../kit/frame.ts';
import { touchWords } from '../../kit/touch-words.ts';
import { currentCharacter, tryById } from '../../state/action.ts';
import { setActionTooltip } from '../../state/tooltips.ts';
import type { Uses } from '../../state/workbench.ts';
import { whileShown } from '../posing/while-shown.ts';

/** Created once; up to date while shown. */
export function ikControls(wb: Uses<'store' | 'actions' | 'posing' | 'settings'>): HTMLElement {
  const root = keepsFocusElsewhere(
    button('Root moves', { class: 'tool ik-root' }, 'Root moves', () => tryById(wb, 'ik.rootFree')),
  );
  setActionTooltip(wb, root, 'ik.rootFree', () => {
    const character = currentCharacter(wb);
    if (!character) return 'Allow root to move';
    return ikOf(character).rootIsFree
      ? `${character.name}’s root moves when a pin needs it`
      : `${character.name}’s root is fixed; only joints bend`;
  });
  const all = keepsFocusElsewhere(
    button('Unpin all', { class: 'tool' }, 'Unpin all', () => tryById(wb, 'ik.letAllGo')),
  );
  setActionTooltip(wb, all, 'ik.letAllGo', 'Remove all pins of the character');
  const hold = keepsFocusElsewhere(
    button('Hold pins over range', { class: 'tool' }, 'Hold…', () => tryById(wb, 'ik.holdPins')),
  );
  setActionTooltip(wb, hold, 'ik.holdPins', 'Hold pins over a range of the take');
  const hint = element('span', { class: 'ik-hint', role: 'note' });
  const tools = element('div', { class: 'ik-tools tools' }, root, all, hold);
  const { hasDragged, wantsRoot } = wb.posing.ik;
  const show = () => {
    const character = currentCharacter(wb);
    const setup = character?.skeleton && ikOf(character);
    root.disabled = setup === undefined;
    all.disabled = hold.disabled = !setup?.pins.length;
    setAttribute(root, 'aria-pressed', String(setup?.rootIsFree ?? false));
    setText(root, setup?.rootIsFree === false ? 'Root fixed' : 'Root moves');
    root.classList.toggle('asked', setup?.rootIsFree === false && wantsRoot.get());
    setText(hint, ikHintText(setup?.pins.length ?? 0));
    hint.hidden = hasDragged.get() || setup === undefined;
  };
  const showSoon = oncePerFrame(show);
  const controls = element('div', { class: 'ik-controls' }, tools, hint);
  whileShown(wb.posing, controls, () => {
    show();
    return [
      wb.store.subscribe((now, before) => {
        if (now.document.characters !== before.document.characters || now.selection !== before.selection) showSoon();
      }),
      hasDragged.subscribe(show),
      wantsRoot.subscribe(showSoon),
    ];
  });
  return controls;
}

/** What to do first, and next. */
export function ikHintText(pins: number): string {
  if (pins === 0) return touchWords('Click a hand, foot or joint to pin it; drag others.');
  return touchWords('Drag any point; pins hold. Click a pin to remove it.');
}
