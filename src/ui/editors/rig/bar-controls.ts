/** Rig mode's controls beside the mode switch, and the hint below. */

import { tryById } from '../../state/actions/action.ts';
import { setActionTooltip } from '../../state/actions/tooltips.ts';
import { RIG_SKINS, type RigSkin } from '../../state/posing.ts';
import { RIG_CHILDREN, type RigChildren } from '../../state/rig-hand.ts';
import type { Uses } from '../../state/workbench.ts';
import { button, element, keepsFocusElsewhere, setAttribute, setText, write } from '../../widgets/dom.ts';
import type { Observable } from '../../widgets/observable.ts';
import { whileShown } from '../posing/while-shown.ts';

const SKIN_TEXT: Readonly<Record<RigSkin, readonly [text: string, tip: string]>> = {
  stays: ['stays', 'The skin stays in place and is rebound (bind mode)'],
  follows: ['follows', 'The skin keeps its binding and follows the joints (pose mode)'],
};
const CHILDREN_TEXT: Readonly<Record<RigChildren, readonly [text: string, tip: string]>> = {
  follow: ['follow', 'Children move with a dragged joint'],
  stay: ['stay', 'Children stay in place when a joint is dragged'],
};

/** Created once; up to date while shown. */
export function rigControls(wb: Uses<'store' | 'actions' | 'posing' | 'settings'>): HTMLElement {
  const state = wb.posing.rig;
  const adding = keepsFocusElsewhere(
    button('Add joints', { class: 'tool' }, 'Add joints', () => tryById(wb, 'rigging.addJoints')),
  );
  setActionTooltip(wb, adding, 'rigging.addJoints', 'Add joints: each click adds a child to the selected joint');
  const text = element('span');
  const hint = element('p', { class: 'rig-hint', role: 'status' }, text);
  const show = () => {
    setAttribute(adding, 'aria-pressed', String(state.adding.get()));
    const readout = state.readout.get();
    setText(text, readout || rigHintText(wb));
    hint.classList.toggle('is-readout', readout !== '');
    // In little room it only shows while adding joints or dragging.
    hint.classList.toggle('is-known', !readout && !state.adding.get());
  };
  const skin = segments(wb.posing.rigSkin, 'Skin', RIG_SKINS, SKIN_TEXT);
  const children = segments(state.children, 'Children', RIG_CHILDREN, CHILDREN_TEXT);
  const controls = element('div', { class: 'rig-controls' }, group(adding), skin.element, children.element, hint);
  whileShown(wb.posing, controls, () => {
    for (const part of [{ show }, skin, children]) part.show();
    return [
      state.adding.subscribe(show),
      state.readout.subscribe(show),
      wb.store.subscribe((now, before) => {
        if (now.selection !== before.selection || now.document.characters !== before.document.characters) show();
      }),
      wb.posing.rigSkin.subscribe(skin.show),
      state.children.subscribe(children.show),
    ];
  });
  return controls;
}

/** One sentence: what to do next. */
function rigHintText(wb: Uses<'store' | 'posing'>): string {
  const { document, selection } = wb.store;
  const isAny = document.characters.some((c) => c.skeleton);
  const hasJoint = selection.joint !== undefined;
  if (wb.posing.rig.adding.get()) {
    if (!isAny) return 'Click to place the first joint.';
    if (!hasJoint) return 'Click the parent of the new joint.';
    return 'Click to add a joint, on a skin inside it, or on a joint to branch from it. Esc to finish.';
  }
  if (!isAny) return 'Choose Add joints and click to place the first one.';
  if (!hasJoint) return 'Click a joint to edit it, drag to move it.';
  const drag = 'Drag the joint, an arrow or a face of its box.';
  return matchMedia('(pointer: coarse)').matches ? drag : `${drag} Ctrl+click to add a child.`;
}

function group(...children: HTMLElement[]): HTMLElement {
  return element('div', { class: 'rig-group tools' }, ...children);
}

/** A labelled choice of two. If only the current one is visible, it switches to the other. */
function segments<T extends string>(
  value: Observable<T>,
  name: string,
  choices: readonly T[],
  texts: Readonly<Record<T, readonly [text: string, tip: string]>>,
): { readonly element: HTMLElement; show(): void } {
  const buttons: HTMLButtonElement[] = choices.map((choice) => {
    const [text, tip] = texts[choice];
    const made = button(`${name}: ${text}`, { class: 'tool', role: 'radio', tooltip: tip }, text, () => {
      const other = choices.find((one, i) => one !== choice && buttons[i].offsetParent === null);
      value.set(other !== undefined && value.get() === choice ? other : choice);
    });
    return keepsFocusElsewhere(made);
  });
  const show = () => {
    buttons.forEach((made, i) => {
      const isChosen = value.get() === choices[i];
      setAttribute(made, 'aria-checked', String(isChosen));
      write(made, 'tabIndex', isChosen ? 0 : -1);
    });
  };
  const whole = element(
    'div',
    { class: 'rig-group tools', role: 'radiogroup', 'aria-label': name },
    element('span', { class: 'rig-name', 'aria-hidden': 'true' }, name),
    ...buttons,
  );
  whole.addEventListener('keydown', (event) => {
    if (event.key !== 'ArrowRight' && event.key !== 'ArrowLeft') return;
    event.preventDefault();
    const at = choices.indexOf(value.get());
    const next = (at + (event.key === 'ArrowRight' ? 1 : choices.length - 1)) % choices.length;
    value.set(choices[next]);
    buttons[next].focus();
  });
  return { element: whole, show };
}
