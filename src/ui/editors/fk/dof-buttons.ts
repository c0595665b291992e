/**
 * Buttons for the selected joint's DOFs, beside the mode switch. The active one is pressed; linked ones show what they
 * follow.
 */
import { coupleOf } from '../../../model/skeleton/couples.ts';
import { characterDofs } from '../../../model/skeleton/dofs.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import { dofClass } from '../../state/joints/dof-class.ts';
import { limitValueText } from '../../state/joints/dof-text.ts';
import { type ResolvedJoint, selectedJoint } from '../../state/joints/selected-joint.ts';
import type { Uses } from '../../state/workbench.ts';
import { element, keepsFocusElsewhere, write } from '../../widgets/dom.ts';
import { coupleText } from '../inspector/dof-rows.ts';
import { activeDof, chooseDof, dofsByHand, dofsOfJoint, freeDofs, isLockedDof } from '../posing/active-dof.ts';
import { channelName, namedChannel } from '../timeline/channels.ts';

export function dofButtons(wb: Uses<'store' | 'posing' | 'settings' | 'messages'>): {
  readonly element: HTMLElement;
  readonly dispose: () => void;
} {
  const group = element('div', { class: 'dof-buttons tools', role: 'radiogroup', 'aria-label': 'Active DOF' });
  const show = () => {
    const selected = selectedJoint(wb);
    write(group, 'hidden', selected === undefined);
    if (!selected) return;
    const { character, skeleton } = selected;
    const all = characterDofs(skeleton, []);
    const own = dofsOfJoint(selected);
    const byHand = dofsByHand(selected);
    const active = activeDof(wb);
    const hadFocus = group.contains(document.activeElement);
    const parts = own.flatMap((dof) => {
      const couple = coupleOf(skeleton, dof);
      if (couple) {
        const followed = channelName(namedChannel(character, couple.follows));
        const tooltip = `${all[dof].name} ${coupleText(couple, all[dof], character, wb.settings.get().angles)}`;
        return [element('span', { class: 'dof-note is-linked', tooltip }, `${all[dof].name} ← ${followed}`)];
      }
      if (isLockedDof(selected, dof) && byHand.includes(dof)) return [lockedButton(wb, selected, dof)];
      return byHand.includes(dof)
        ? [dofButton(wb, dof, all[dof].name, dofClass(character.skeleton, all[dof]), dof === active)]
        : [];
    });
    if (!own.length) parts.push(element('span', { class: 'dof-note' }, 'fixed: no DOF'));
    else if (!parts.length) parts.push(element('span', { class: 'dof-note' }, 'rotates freely'));
    group.replaceChildren(...parts);
    if (hadFocus) group.querySelector<HTMLElement>('[aria-checked=true]')?.focus();
  };
  group.addEventListener('keydown', (event) => {
    const step = event.key === 'ArrowRight' ? 1 : event.key === 'ArrowLeft' ? -1 : 0;
    const selected = selectedJoint(wb);
    const now = activeDof(wb);
    if (!step || !selected || now === undefined) return;
    event.preventDefault();
    const dofs = freeDofs(selected);
    chooseDof(wb, dofs[(dofs.indexOf(now) + step + dofs.length) % dofs.length]);
  });
  let skeleton = selectedJoint(wb)?.skeleton;
  let holds = selectedJoint(wb)?.character.clampsToLimits;
  const stops = [
    wb.posing.chosenDof.subscribe(show),
    wb.store.subscribe((now, before) => {
      const next = selectedJoint(wb);
      const isSame = next?.skeleton === skeleton && next?.character.clampsToLimits === holds;
      skeleton = next?.skeleton;
      holds = next?.character.clampsToLimits;
      if (now.selection !== before.selection || !isSame) show();
    }),
  ];
  show();
  return { element: group, dispose: () => stops.forEach((stop) => void stop()) };
}

/** Of a DOF that can't change; a press tells why. */
function lockedButton(
  wb: Uses<'settings' | 'messages'>,
  { character, skeleton, joint }: ResolvedJoint,
  dof: number,
): HTMLElement {
  const one = characterDofs(skeleton, [])[dof];
  const limit = limitValueText(one, one.limit.min, character, wb.settings.get().angles);
  const why =
    `${one.name} of ${jointName(skeleton, joint)} is locked: both limits are ${limit}. ` +
    'Change them in rig mode, or turn off Edit > Enforce limits.';
  const made = element(
    'button',
    {
      type: 'button',
      class: `tool dof-button is-locked ${dofClass(skeleton, one)}`,
      role: 'radio',
      'aria-checked': 'false',
      'aria-disabled': 'true',
      tooltip: why,
      tabindex: -1,
    },
    one.name,
  );
  made.addEventListener('click', () => wb.messages.note(why));
  return keepsFocusElsewhere(made);
}

function dofButton(
  wb: Uses<'store' | 'posing'>,
  dof: number,
  name: string,
  colour: string,
  isActive: boolean,
): HTMLElement {
  const made = element(
    'button',
    {
      type: 'button',
      class: `tool dof-button ${colour}`,
      role: 'radio',
      'aria-checked': String(isActive),
      tooltip: `${name}: drag the bone up or down to change it`,
      tabindex: isActive ? 0 : -1,
    },
    name,
  );
  made.addEventListener('click', () => chooseDof(wb, dof));
  return keepsFocusElsewhere(made);
}
