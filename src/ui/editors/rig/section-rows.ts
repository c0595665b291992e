/** Rows of the rig section: three numbers side by side, and lines of small controls. */

import type { GUI } from 'lil-gui';
import type { Vec3 } from '../../../math/vec3.ts';
import type { HandEdit } from '../../state/actions/hand-edit.ts';
import { withoutNoise } from '../../state/joints/angles.ts';
import type { Uses } from '../../state/workbench.ts';
import { element, setText, write } from '../../widgets/dom.ts';
import { leaveField } from '../../widgets/focus/focus.ts';
import { Slider } from '../../widgets/numbers/slider.ts';
import { contentOf } from '../../widgets/section.ts';
import { setTooltip } from '../../widgets/tooltip.ts';

export interface SectionContext {
  readonly wb: Uses<'messages'>;
  readonly edit: HandEdit;
  readonly section: GUI;
}

/** A row with its update and removal. */
export interface SectionRow {
  update(): void;
  readonly line?: HTMLElement;
}

const AXES = [0, 1, 2] as const;

/**
 * @param read undefined: no value at present
 * @param write previews; the release is one undo step
 * @param whyNot why three numbers are invalid, reported on release: typing may pass through invalid ones
 */
export function vectorRow(
  { wb, edit, section }: SectionContext,
  label: string,
  step: number,
  read: () => Vec3 | undefined,
  write: (value: Vec3) => void,
  whyNot: (value: Vec3) => string | undefined = () => undefined,
): SectionRow {
  let refusal: string | undefined;
  const line = element('div', { class: 'vector-row' }, element('span', { class: 'vector-name' }, label));
  const decimals = Math.max(2, -Math.floor(Math.log10(step)));
  const refuse = (reason: string) => {
    if (!edit.cancelled) wb.messages.note(reason, 'warning');
  };
  const update = () => {
    const now = read();
    for (const axis of AXES) if (now) sliders[axis].showValue(withoutNoise(now[axis]));
  };
  const sliders = AXES.map((axis) => {
    const letter = 'xyz'[axis];
    const slider = new Slider(section, `${label} ${letter}`, read()?.[axis] ?? 0, { step, decimals }, refuse);
    slider.showName(`${label} ${letter}`, element('span', { class: `dof-name axis-${letter}` }, letter));
    line.append(slider.domElement);
    slider.onChange((value: number) => {
      const now = read();
      if (!now) return;
      const next: [number, number, number] = [...now];
      next[axis] = value;
      refusal = whyNot(next);
      if (refusal === undefined) write(next);
      if (edit.cancelled) update();
    });
    slider.onTakenBack(() => {
      edit.cancel();
      refusal = undefined;
    });
    slider.onFinishChange(() => {
      if (refusal === undefined || edit.cancelled) edit.commit();
      else {
        // Discards the previews.
        edit.cancel();
        wb.messages.note(refusal, 'warning');
      }
      refusal = undefined;
      update();
    });
    return slider;
  });
  contentOf(section).append(line);
  return { update, line };
}

/** One number. */
export function numberRow(
  { wb, edit, section }: SectionContext,
  label: string,
  step: number,
  read: () => number | undefined,
  write: (value: number) => void,
  bounds?: readonly [number, number],
): SectionRow {
  const refuse = (reason: string) => {
    if (!edit.cancelled) wb.messages.note(reason, 'warning');
  };
  const decimals = Math.max(2, -Math.floor(Math.log10(step)));
  const slider = new Slider(section, label, read() ?? 0, { step, decimals, ...(bounds && { bounds }) }, refuse);
  const update = () => {
    const now = read();
    if (now !== undefined) slider.showValue(withoutNoise(now));
  };
  slider.onChange((value: number) => {
    write(value);
    if (edit.cancelled) update();
  });
  slider.onTakenBack(() => edit.cancel());
  slider.onFinishChange(() => {
    edit.commit();
    update();
  });
  return { update, line: slider.domElement };
}

/**
 * A select; its texts are names of joints and the like, which may occur twice.
 *
 * @param tipOf tooltip of a value, beside its text, which a narrow inspector may cut off
 */
export function choiceRow<T extends string | number>(
  label: string,
  options: readonly (readonly [value: T, text: string])[],
  read: () => T | undefined,
  write: (value: T) => void,
  tipOf: (value: T) => string = () => '',
): SectionRow & { readonly line: HTMLElement } {
  const select = element('select', { 'aria-label': label });
  options.forEach(([, text], i) => {
    select.append(element('option', { value: String(i) }, text));
  });
  const update = () => {
    const now = read();
    select.selectedIndex = options.findIndex(([value]) => value === now);
    const chosen = options[select.selectedIndex];
    const tip = chosen ? tipOf(chosen[0]) : '';
    setTooltip(select, chosen ? `${chosen[1]}${tip && `: ${tip}`}` : '');
  };
  select.addEventListener('change', () => {
    const chosen = options[select.selectedIndex];
    if (chosen) write(chosen[0]);
    update();
  });
  update();
  const name = element('span', { class: 'rig-label', 'aria-hidden': 'true' }, label);
  return { line: element('div', { class: 'rig-row' }, name, select), update };
}

/**
 * A text field; Enter or leaving the field commits.
 *
 * @param noteOf a note about the current text, shown below
 */
export function textRow(
  label: string,
  read: () => string,
  commit: (text: string) => void,
  tooltip = '',
  noteOf: () => string = () => '',
): SectionRow & { readonly line: HTMLElement; readonly field: HTMLInputElement } {
  const field = element('input', {
    type: 'text',
    spellcheck: 'false',
    autocomplete: 'off',
    'aria-label': label,
    tooltip,
  });
  const note = element('p', { class: 'rig-note', role: 'status', hidden: true });
  const update = () => {
    if (document.activeElement !== field) field.value = read();
    const text = noteOf();
    write(note, 'hidden', text === '');
    setText(note, text);
  };
  field.addEventListener('change', () => {
    if (field.value !== read()) commit(field.value);
    field.value = read();
  });
  field.addEventListener('keydown', (event) => {
    if (event.key !== 'Escape') return;
    field.value = read();
    leaveField(field);
    event.preventDefault();
  });
  update();
  const name = element('span', { class: 'rig-label', 'aria-hidden': 'true' }, label);
  const line = element('div', {}, element('div', { class: 'rig-row' }, name, field), note);
  return { line, field, update };
}

export function heading(text: string): HTMLElement {
  return element('h4', { class: 'rig-heading' }, text);
}
