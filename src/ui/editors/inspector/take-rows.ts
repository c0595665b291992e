/** The shown take, in the character's section: its name and playback range. */

import type { GUI } from 'lil-gui';
import { renameTake, setInterpolation, setTakeRange } from '../../../edit/commands/take.ts';
import { type Character, findCharacter, shownTake } from '../../../model/document.ts';
import type { Interpolation } from '../../../model/takes/samples.ts';
import type { Take } from '../../../model/takes/take.ts';
import { attempt } from '../../state/actions/attempt.ts';
import { withoutNoise } from '../../state/joints/angles.ts';
import { openPanel } from '../../state/panels/panels.ts';
import type { Uses } from '../../state/workbench.ts';
import { element, setText } from '../../widgets/dom.ts';
import { NumberField } from '../../widgets/numbers/number-field.ts';
import { shown } from '../../widgets/numbers/number-text.ts';
import { showIn } from '../../widgets/numbers/slider.ts';
import { contentOf } from '../../widgets/section.ts';

const INTERPOLATION_NAMES: Readonly<Record<string, Interpolation>> = {
  'Nearest frame': 'nearest',
  Linear: 'linear',
  Cubic: 'cubic',
};

/** Adds the rows to an empty section. Returns functions that update their values and remove the rest. */
export function addTakeRows(
  wb: Uses<'store' | 'transport' | 'settings' | 'messages'>,
  section: GUI,
  character: Character,
  first: Take,
): { readonly update: () => void; readonly line: HTMLElement } {
  const { id } = character;
  const now = () => {
    const found = findCharacter(wb.store.document, id);
    return found && shownTake(found);
  };
  const binding = { name: first.name };
  const name = section.add(binding, 'name').name('Take');
  name.domElement.classList.add('take-name');
  name.onFinishChange((typed: string) => {
    if (!typed.trim()) wb.messages.note('A take needs a name. Its file is named after it.', 'warning');
    else if (now()) attempt(wb.messages, () => wb.store.apply(renameTake, { characterId: id, name: typed }));
    update();
  });

  const perUnit = () => (wb.settings.get().timeDisplay === 'frames' ? wb.transport.get().framesPerSecond : 1);
  const end = (label: string, make: (value: number, range: readonly [number, number]) => readonly [number, number]) =>
    new NumberField({
      label,
      text: (value) => shown(value),
      commit(value) {
        const take = now();
        if (take) wb.store.apply(setTakeRange, { characterId: id, range: make(value / perUnit(), take.range) });
        // Shows the result in the field at once.
        update();
      },
      refuse: (reason) => wb.messages.note(reason, 'warning'),
    });
  const from = end('Take start', (value, [, to]) => [value, Math.max(value, to)]);
  const to = end('Take end', (value, [first]) => [Math.min(value, first), value]);
  const unit = element('span', { class: 'faint unit' });
  const line = element(
    'div',
    { class: 'range-row' },
    element('span', { class: 'vector-name' }, 'Range'),
    from.element,
    element('span', { class: 'faint' }, '–'),
    to.element,
    unit,
  );
  contentOf(section).append(line);

  const between = { interpolation: first.samples?.interpolation ?? 'linear' };
  const interpolation =
    first.samples && section.add(between, 'interpolation', INTERPOLATION_NAMES).name('Interpolation');
  interpolation?.onChange((chosen: Interpolation) => {
    if (now()) attempt(wb.messages, () => wb.store.apply(setInterpolation, { characterId: id, interpolation: chosen }));
  });

  const update = () => {
    const take = now();
    if (!take) return;
    if (interpolation && take.samples) showIn(interpolation, take.samples.interpolation);
    if (binding.name !== take.name && !name.domElement.contains(document.activeElement)) {
      binding.name = take.name;
      name.updateDisplay();
    }
    from.show(withoutNoise(take.range[0] * perUnit()));
    to.show(withoutNoise(take.range[1] * perUnit()));
    const text = wb.settings.get().timeDisplay === 'frames' ? 'fr' : 's';
    setText(unit, text);
  };
  update();
  return { update, line };
}

/** Opens everything around the field of the take's name, and focuses it. */
export function askForTakeName(wb: Uses<'settings'>, section: GUI): void {
  openPanel(wb, 'inspector', true);
  section.open();
  const field = section.domElement.querySelector<HTMLInputElement>('.take-name input');
  field?.scrollIntoView({ block: 'nearest' });
  field?.focus();
  field?.select();
}
