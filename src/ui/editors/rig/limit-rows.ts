/** The limits of a joint's DOFs as two fields each; an empty one is no limit on that side. */
import { limitRigged } from '../../../edit/commands/rig.ts';
import { inTurn } from '../../../edit/in-turn.ts';
import { matchingDofs } from '../../../edit/pose/same-change.ts';
import { findCharacter } from '../../../model/document.ts';
import { characterDofs, firstDofs } from '../../../model/skeleton/dofs.ts';
import { type Dof, type Limit, UNLIMITED } from '../../../model/skeleton/skeleton.ts';
import { attempt } from '../../state/actions/attempt.ts';
import { shownPerUnit, unitText, withoutNoise } from '../../state/joints/angles.ts';
import { pausePlayback } from '../../state/pause-playback.ts';
import type { Uses } from '../../state/workbench.ts';
import { element } from '../../widgets/dom.ts';
import { leaveField } from '../../widgets/focus/focus.ts';
import { exact, shown } from '../../widgets/numbers/number-text.ts';
import { typedLimit } from './limit-editor.ts';
import { rigging } from './rigging-args.ts';
import type { SectionRow } from './section-rows.ts';

/**
 * @param index of the DOF among its joint's
 * @param others selected joints besides: what is typed is set for the same DOF of each that has it
 */
export function limitRow(
  wb: Uses<'store' | 'transport' | 'timeline' | 'posing' | 'settings' | 'messages'>,
  characterId: string,
  joint: number,
  index: number,
  { name, unit }: Dof,
  others: readonly number[],
): SectionRow & { readonly line: HTMLElement } {
  const perUnit = () => shownPerUnit(unit, wb.settings.get().angles);
  const dofNow = () => {
    const character = findCharacter(wb.store.document, characterId);
    if (!character?.skeleton) return undefined;
    const dof = (firstDofs(character.skeleton)[joint] ?? 0) + index;
    const found = characterDofs(character.skeleton, character.morphs)[dof];
    return found && { dof, limit: found.limit };
  };
  const textOf = (side: 'min' | 'max', asExact: boolean) => {
    const value = dofNow()?.limit[side];
    if (value === undefined || value === UNLIMITED[side]) return '';
    const number = withoutNoise(value * perUnit());
    return asExact ? exact(number) : shown(number);
  };
  const take = (side: 'min' | 'max') => {
    const now = dofNow();
    if (!now) return;
    const { min, max } = fields;
    const typed = typedLimit(min.value, max.value, perUnit());
    if (typeof typed === 'string') {
      wb.messages.note(typed, 'warning');
      update();
      return;
    }
    // The other field shows a rounded number: use the exact one.
    const limitOf = (limit: Limit) =>
      side === 'min' ? { min: typed.min, max: limit.max } : { min: limit.min, max: typed.max };
    pausePlayback(wb);
    const { skeleton } = findCharacter(wb.store.document, characterId) ?? {};
    const dofs = [now.dof, ...(skeleton ? matchingDofs(skeleton, others, now.dof) : [])];
    const all = characterDofs(skeleton, []);
    const shared = rigging(wb, { id: characterId });
    const each = dofs.map((dof) => ({ ...shared, dof, ...limitOf(all[dof].limit) }));
    const command = inTurn(limitRigged, `Set limits of ${name} of ${dofs.length} joints`);
    attempt(wb.messages, () => wb.store.apply(command, each));
    update();
  };
  const field = (side: 'min' | 'max', label: string) =>
    limitField(
      `${label} limit of ${name}`,
      (asExact) => textOf(side, asExact),
      () => take(side),
    );
  const fields = { min: field('min', 'Lower'), max: field('max', 'Upper') };
  const update = () => {
    for (const side of ['min', 'max'] as const) {
      if (document.activeElement !== fields[side]) fields[side].value = textOf(side, false);
    }
  };
  update();
  const line = element(
    'div',
    { class: 'rig-row' },
    element('span', { class: 'rig-label', 'aria-hidden': 'true' }, name),
    fields.min,
    element('span', { class: 'unit', 'aria-hidden': 'true' }, '–'),
    fields.max,
    element('span', { class: 'unit', 'aria-hidden': 'true' }, unitText(unit, wb.settings.get().angles).trim()),
  );
  return { line, update };
}

/** @param textOf its text now: exact while it is edited */
function limitField(label: string, textOf: (asExact: boolean) => string, changed: () => void): HTMLInputElement {
  const made = element('input', {
    type: 'text',
    inputmode: 'decimal',
    spellcheck: 'false',
    autocomplete: 'off',
    class: 'number-field',
    placeholder: 'none',
    'aria-label': label,
  });
  made.addEventListener('focus', () => {
    made.value = textOf(true);
    made.select();
  });
  made.addEventListener('blur', () => {
    made.value = textOf(false);
  });
  made.addEventListener('change', changed);
  made.addEventListener('keydown', (event) => {
    if (event.key !== 'Escape') return;
    made.value = textOf(true);
    leaveField(made);
    event.preventDefault();
  });
  return made;
}
