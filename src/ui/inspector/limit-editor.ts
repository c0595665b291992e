/**
 * Two numbers over a DOF's row: its limits, typed. Both become one step when they are taken, so that typing never passes
 * through limits that nobody meant.
 */
import { setLimit } from '../../edit/commands/limits.ts';
import { findCharacter } from '../../model/document.ts';
import { characterDofs } from '../../model/dofs.ts';
import { isUnlimited } from '../../model/skeleton.ts';
import { shownPerUnit, unitText, withoutNoise } from '../angles.ts';
import { element } from '../dom.ts';
import { exact, parseNumber } from '../number-text.ts';
import type { Workbench } from '../workbench.ts';
import type { Slider } from './slider.ts';

export function editLimits(wb: Workbench, slider: Slider, characterId: string, index: number): void {
  const character = findCharacter(wb.store.document, characterId);
  const dof = character && characterDofs(character.skeleton, character.morphs)[index];
  if (!dof) return;
  const { angles } = wb.settings.get();
  const factor = shownPerUnit(dof.unit, angles);
  const shown = (value: number) => (isUnlimited(dof.limit) ? '' : exact(withoutNoise(value * factor)));
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
  const min = field('Lower limit', shown(dof.limit.min));
  const max = field('Upper limit', shown(dof.limit.max));
  const said = element('p', { class: 'limit-error', role: 'alert' });
  const form = element(
    'form',
    { class: 'limit-form', method: 'dialog' },
    element('span', { class: 'faint' }, `Limits of ${dof.name}`),
    min,
    element('span', { class: 'faint' }, '–'),
    max,
    element('span', { class: 'faint' }, unitText(dof.unit, angles).trim()),
    element('button', { type: 'submit', class: 'plain' }, 'Set'),
  );
  const dialog = element('dialog', { class: 'limit-editor', 'aria-label': `Limits of ${dof.name}` }, form, said);
  form.addEventListener('submit', (event) => {
    event.preventDefault();
    const low = parseNumber(min.value);
    const high = parseNumber(max.value);
    if (low === undefined || high === undefined) said.textContent = 'Two numbers are needed.';
    else if (low > high) said.textContent = 'The lower limit is above the upper one.';
    else {
      dialog.close();
      wb.store.apply(setLimit, { characterId, dof: index, min: low / factor, max: high / factor });
    }
  });
  dialog.addEventListener('close', () => dialog.remove());
  dialog.addEventListener('pointerdown', (event) => {
    // Outside of it is still the dialog itself: its backdrop.
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
