/**
 * The bar over the viewport: the mode switch, enforcing limits, and a place for the controls of the mode's tool
 * (`wb.posing.controls`). On a phone a menu has modes and limits.
 */

import { currentCharacter, tryById } from '../../state/actions/action.ts';
import { sectionsOf } from '../../state/actions/menu-entries.ts';
import { setActionTooltip } from '../../state/actions/tooltips.ts';
import { POSING_MODES, type PosingMode } from '../../state/posing.ts';
import type { Uses } from '../../state/workbench.ts';
import { button, element, keepsFocusElsewhere, setAttribute, setText, write } from '../../widgets/dom.ts';
import { icon } from '../../widgets/icons.ts';
import { menuButton } from '../../widgets/menu.ts';

const TEXT: Readonly<Record<PosingMode, string>> = { select: 'Select', pose: 'Pose', fk: 'FK', ik: 'IK', rig: 'Rig' };
/** Actions whose shortcuts lead to the modes. */
const KEY_OF: Readonly<Record<PosingMode, string>> = {
  select: 'posing.selectTool',
  pose: 'posing.pose',
  fk: 'posing.toggle',
  ik: 'posing.toggle',
  rig: 'posing.rig',
};
const MODE_LABELS: Readonly<Record<PosingMode, string>> = {
  pose: 'Pose: drag a hand, a foot or a head to pose its limb, or a ring to turn the selected joint',
  fk: 'Forward kinematics: rotate joints one at a time with their rings or by dragging a bone up and down',
  select: 'Select: click joints without a gizmo in the way; every drag moves the camera',
  ik: 'Inverse kinematics: click to pin a point, drag to move any point or turn a ring while pins hold',
  rig: 'Rig: drag a joint, its arrows or a face of its box; Ctrl+click to add a child',
};

export function modeBar(wb: Uses<'store' | 'actions' | 'posing' | 'settings'>): HTMLElement {
  const controls = element('div', { class: 'mode-controls' });
  const show = () => {
    const own = wb.posing.controls.get();
    controls.replaceChildren(...(own ? [own] : []));
    write(controls, 'hidden', own === undefined);
  };
  wb.posing.controls.subscribe(show);
  show();
  return element('div', { class: 'mode-bar tools' }, modeMenu(wb), modeSwitch(wb), limitsSwitch(wb), controls);
}

function modeMenu(wb: Uses<'actions' | 'posing' | 'settings'>): HTMLElement {
  const text = element('span');
  const made = element('button', { type: 'button', class: 'tool text-tool' }, text, icon('fold'));
  menuButton(made, 'Mode', () => sectionsOf(wb, [POSING_MODES.map((mode) => `posing.${mode}`), ['pose.holdLimits']]));
  const show = () => {
    setText(text, TEXT[wb.posing.mode.get()]);
    setAttribute(made, 'aria-label', `Mode: ${text.textContent}`);
  };
  wb.posing.mode.subscribe(show);
  show();
  return element('div', { class: 'mode-menu tools' }, keepsFocusElsewhere(made));
}

function modeSwitch(wb: Uses<'actions' | 'posing' | 'settings'>): HTMLElement {
  const group = element('div', { class: 'mode-switch tools', role: 'radiogroup', 'aria-label': 'Mode' });
  const made = POSING_MODES.map((mode) => {
    const one = keepsFocusElsewhere(
      button(TEXT[mode], { class: 'tool', role: 'radio' }, mode === 'select' ? icon('select') : TEXT[mode], () =>
        tryById(wb, `posing.${mode}`),
      ),
    );
    setActionTooltip(wb, one, KEY_OF[mode], MODE_LABELS[mode]);
    return { mode, one };
  });
  group.append(...made.map(({ one }) => one));
  group.addEventListener('keydown', (event) => {
    const step = event.key === 'ArrowRight' ? 1 : event.key === 'ArrowLeft' ? -1 : 0;
    if (!step) return;
    event.preventDefault();
    const next = (POSING_MODES.indexOf(wb.posing.mode.get()) + step + POSING_MODES.length) % POSING_MODES.length;
    tryById(wb, `posing.${POSING_MODES[next]}`);
    made[next].one.focus();
  });
  const show = () => {
    for (const { mode, one } of made) {
      const chosen = wb.posing.mode.get() === mode;
      setAttribute(one, 'aria-checked', String(chosen));
      write(one, 'tabIndex', chosen ? 0 : -1);
    }
  };
  wb.posing.mode.subscribe(show);
  show();
  return group;
}

function limitsSwitch(wb: Uses<'store' | 'actions' | 'settings'>): HTMLElement {
  const made = keepsFocusElsewhere(
    button('Limits', { class: 'tool' }, icon('limits'), () => tryById(wb, 'pose.holdLimits')),
  );
  made.append(element('span', { class: 'limits-text' }, 'Limits'));
  setActionTooltip(wb, made, 'pose.holdLimits', () => {
    const character = currentCharacter(wb);
    if (!character) return 'Enforce joint limits';
    return character.clampsToLimits
      ? `Limits on: ${character.name}’s joints stop at their limits`
      : `Limits off: ${character.name}’s joints can go past their limits`;
  });
  const show = () => {
    const character = currentCharacter(wb);
    write(made, 'disabled', !character?.skeleton);
    setAttribute(made, 'aria-pressed', String(character?.clampsToLimits ?? true));
  };
  wb.store.subscribe((now, before) => {
    const { document, selection } = now;
    if (document.characters !== before.document.characters || selection !== before.selection) show();
  });
  show();
  return element('div', { class: 'limits-switch tools' }, made);
}
