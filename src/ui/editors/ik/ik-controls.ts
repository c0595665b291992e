/**
 * IK controls beside the mode switch: the reach of a drag, whether the root may move, removing all pins, and a hint.
 * Pose mode has the reach, and the others once they matter.
 */

import { PIN_AXES, type PinAxes } from '../../../evaluate/handles/pin-handles.ts';
import { ikOf, type RootHold, rootHold } from '../../../evaluate/ik/set-up.ts';
import { defaultIk } from '../../../model/ik.ts';
import { currentCharacter, findAction, tryById } from '../../state/actions/action.ts';
import { itemOf } from '../../state/actions/menu-entries.ts';
import { setActionTooltip } from '../../state/actions/tooltips.ts';
import type { Uses } from '../../state/workbench.ts';
import { button, element, keepsFocusElsewhere, setAttribute, setText, write } from '../../widgets/dom.ts';
import { oncePerFrame } from '../../widgets/frame.ts';
import { icon } from '../../widgets/icons.ts';
import { type MenuEntry, menuButton } from '../../widgets/menu.ts';
import { setTooltip } from '../../widgets/tooltip.ts';
import { touchWords } from '../../widgets/touch-words.ts';
import { whileShown } from '../posing/while-shown.ts';
import { REACH_MEANINGS, REACH_NAMES, reachShown } from './reach-choice.ts';
import { selectedPin } from './selected-pin.ts';

const ROOT_NAMES: Readonly<Record<RootHold, string>> = {
  moves: 'Root moves',
  'in place': 'Root in place',
  fixed: 'Root fixed',
};
const ROOT_MEANINGS: Readonly<Record<RootHold, string>> = {
  moves: 'moves when a pin needs it',
  'in place': 'keeps its position and turns, as the first bone; lock it to keep its turn too',
  fixed: 'keeps its position and turn; only other joints bend',
};

/** Created once; up to date while shown. */
export function ikControls(
  wb: Uses<'store' | 'actions' | 'posing' | 'settings'>,
  mode: 'pose' | 'ik' = 'ik',
): HTMLElement {
  const root = keepsFocusElsewhere(
    button('Root moves', { class: 'tool ik-root' }, 'Root moves', () => tryById(wb, 'ik.rootFree')),
  );
  setActionTooltip(wb, root, 'ik.rootFree', () => {
    const character = currentCharacter(wb);
    if (!character?.skeleton) return 'Allow root to move';
    return `${character.name}’s root ${ROOT_MEANINGS[rootHold(character.skeleton, ikOf(character))]}`;
  });
  const reach = keepsFocusElsewhere(
    element('button', { type: 'button', class: 'tool text-tool ik-reach' }, element('span', {}), icon('fold')),
  );
  setTooltip(reach, () => `Reach: ${REACH_MEANINGS[reachShown(wb, currentCharacter(wb))]}`);
  menuButton(reach, 'Reach of IK', () => reachEntries(wb));
  const axes = keepsFocusElsewhere(
    element('button', { type: 'button', class: 'tool text-tool ik-axes' }, element('span', {}), icon('fold')),
  );
  setTooltip(axes, 'Axes that the handles of the selected pin move it along');
  menuButton(axes, 'Axes of the pin', () => axesEntries(wb));
  const all = keepsFocusElsewhere(
    button('Unpin all', { class: 'tool' }, 'Unpin all', () => tryById(wb, 'ik.letAllGo')),
  );
  setActionTooltip(wb, all, 'ik.letAllGo', 'Remove all pins of the character');
  const hold = keepsFocusElsewhere(
    button('Hold pins over range', { class: 'tool' }, 'Hold…', () => tryById(wb, 'ik.holdPins')),
  );
  setActionTooltip(wb, hold, 'ik.holdPins', 'Hold pins over a range of the take');
  const hint = element('span', { class: 'ik-hint', role: 'note' });
  const tools = element('div', { class: 'ik-tools tools' }, reach, axes, root, all, ...(mode === 'ik' ? [hold] : []));
  const { hasDragged, wantsRoot } = wb.posing.ik;
  const show = () => {
    const character = currentCharacter(wb);
    const setup = character?.skeleton && ikOf(character);
    write(root, 'disabled', setup === undefined);
    const reachName = REACH_NAMES[reachShown(wb, character)];
    if (reach.firstElementChild) setText(reach.firstElementChild, `Reach: ${reachName}`);
    setAttribute(reach, 'aria-label', `Reach: ${reachName}`);
    write(axes, 'hidden', selectedPin(wb) === undefined);
    const axesName = `Axes: ${AXES_NAMES[wb.posing.ik.axes.get()]}`;
    if (axes.firstElementChild) setText(axes.firstElementChild, axesName);
    setAttribute(axes, 'aria-label', axesName);
    for (const each of [all, hold]) write(each, 'disabled', !setup?.pins.length);
    if (mode === 'pose') {
      // What has been set in IK acts here too, and can be undone where one meets it.
      write(root, 'hidden', setup === undefined || setup.rootIsFree === defaultIk(character?.skeleton).rootIsFree);
      write(all, 'hidden', !setup?.pins.length);
    }
    setAttribute(root, 'aria-pressed', String(setup?.rootIsFree ?? false));
    setText(root, ROOT_NAMES[character?.skeleton && setup ? rootHold(character.skeleton, setup) : 'moves']);
    root.classList.toggle('asked', setup?.rootIsFree === false && wantsRoot.get());
    setText(hint, ikHintText(setup?.pins.length ?? 0));
    write(hint, 'hidden', mode === 'pose' || hasDragged.get() || setup === undefined);
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
      wb.settings.subscribe(showSoon),
      wb.posing.ik.selected.subscribe(showSoon),
      wb.posing.ik.axes.subscribe(showSoon),
      wantsRoot.subscribe(showSoon),
    ];
  });
  return controls;
}

const AXES_NAMES: Readonly<Record<PinAxes, string>> = { world: 'World', local: 'Joint', parent: 'Parent' };

function axesEntries({ posing }: Uses<'posing'>): readonly MenuEntry[] {
  const { axes } = posing.ik;
  return PIN_AXES.map((one) => ({
    kind: 'item',
    label: AXES_NAMES[one],
    checked: axes.get() === one,
    radio: true,
    enabled: true,
    run: () => axes.set(one),
  }));
}

function reachEntries(wb: Uses<'store' | 'actions' | 'settings'>): readonly MenuEntry[] {
  return ['ik.reachLimb', 'ik.reachBody', 'ik.reachChain'].flatMap((id) => {
    const action = findAction(wb, id);
    return action ? [itemOf(wb, action)] : [];
  });
}

/** What to do first, and next. */
export function ikHintText(pins: number): string {
  if (pins === 0) return touchWords('Click a hand, foot or joint to pin it; drag others.');
  return touchWords('Drag any point; pins hold. Click a pin to remove it.');
}
