/**
 * Two fields over a DOF's row: its limits; an empty field is no limit on that side. Both are committed in one step, so
 * that typing never passes through unintended limits.
 */
import { setLimit } from '../../../edit/commands/limits.ts';
import { inTurn } from '../../../edit/in-turn.ts';
import { findCharacter } from '../../../model/document.ts';
import { characterDofs } from '../../../model/skeleton/dofs.ts';
import { type Limit, UNLIMITED } from '../../../model/skeleton/skeleton.ts';
import { shownPerUnit, typedUnits, unitText, withoutNoise } from '../../state/joints/angles.ts';
import type { Uses } from '../../state/workbench.ts';
import { element } from '../../widgets/dom.ts';
import type { Units } from '../../widgets/numbers/arithmetic.ts';
import { exact, parseNumber } from '../../widgets/numbers/number-text.ts';
import type { Slider } from '../../widgets/numbers/slider.ts';

/** @param dofs that get the limits; the fields show the first one's */
export function editLimits(
  wb: Uses<'store' | 'settings'>,
  slider: Slider,
  characterId: string,
  dofs: readonly number[],
): void {
  const [index] = dofs;
  const character = findCharacter(wb.store.document, characterId);
  const dof = character && characterDofs(character.skeleton, character.morphs)[index];
  if (!dof) return;
  const { angles } = wb.settings.get();
  const name = dofs.length === 1 ? dof.name : `${dof.name} of ${dofs.length} joints`;
  const factor = shownPerUnit(dof.unit, angles);
  const shown = (value: number, none: number) => (value === none ? '' : exact(withoutNoise(value * factor)));
  const field = (label: string, value: string) =>
    element('input', {
      type: 'text',
      inputmode: 'decimal',
      spellcheck: 'false',
      autocomplete: 'off',
      class: 'number-field',
      'aria-label': label,
      placeholder: 'none',
      value,
    });
  const min = field('Lower limit', shown(dof.limit.min, UNLIMITED.min));
  const max = field('Upper limit', shown(dof.limit.max, UNLIMITED.max));
  const said = element('p', { class: 'limit-error', role: 'alert' });
  const form = element(
    'form',
    { class: 'limit-form', method: 'dialog' },
    element('span', { class: 'faint' }, `Limits of ${name}`),
    min,
    element('span', { class: 'faint' }, '–'),
    max,
    element('span', { class: 'faint' }, unitText(dof.unit, angles).trim()),
    element('button', { type: 'submit', class: 'plain' }, 'Set'),
  );
  const dialog = element('dialog', { class: 'limit-editor', 'aria-label': `Limits of ${name}` }, form, said);
  form.addEventListener('submit', (event) => {
    event.preventDefault();
    const limit = typedLimit(min.value, max.value, factor, typedUnits(dof.unit, angles));
    if (typeof limit === 'string') said.textContent = limit;
    else {
      dialog.close();
      const each = dofs.map((one) => ({ characterId, dof: one, ...limit }));
      wb.store.apply(inTurn(setLimit, `Set limits of ${name}`), each);
    }
  });
  dialog.addEventListener('close', () => dialog.remove());
  dialog.addEventListener('pointerdown', (event) => {
    // A click outside hits the dialog itself: its backdrop.
    if (event.target === dialog) dialog.close();
  });
  document.body.append(dialog);
  dialog.showModal();
  const row = slider.domElement.getBoundingClientRect();
  const { width, height } = dialog.getBoundingClientRect();
  dialog.style.left = `${Math.max(4, Math.min(row.left, window.innerWidth - width - 4))}px`;
  dialog.style.top = `${Math.max(4, Math.min(row.bottom, window.innerHeight - height - 4))}px`;
  min.select();
}

/**
 * The limits of two fields, or what is wrong with them.
 *
 * @param perUnit displayed units per model unit
 * @param units that may be typed
 */
export function typedLimit(lower: string, upper: string, perUnit: number, units?: Units): Limit | string {
  const numberIn = (text: string, none: number) => {
    const typed = parseNumber(text, units);
    return text.trim() === '' ? none : typed === undefined ? Number.NaN : typed / perUnit;
  };
  const min = numberIn(lower, UNLIMITED.min);
  const max = numberIn(upper, UNLIMITED.max);
  if (Number.isNaN(min) || Number.isNaN(max)) return 'A limit must be a number, or empty for none.';
  return min > max ? 'The lower limit is above the upper one.' : { min, max };
}
