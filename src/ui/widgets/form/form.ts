/**
 * The form of a dialog: what it is about, fields that are declared, a summary of the result, and the buttons. Applying
 * is the dialog's; while its answers are refused, the summary says why.
 */
import { UserError } from '../../../model/user-error.ts';
import { element, setText, write } from '../dom.ts';
import { unitsBehind } from '../numbers/arithmetic.ts';
import { parseNumber } from '../numbers/number-text.ts';

/** Values with their labels, in order. */
export type Choices = Readonly<Record<string, string>> | readonly (readonly [value: string, label: string])[];

/** The answers, by the names of the fields. */
export interface Answers {
  /** @throws UserError if it is none */
  number(name: string): number;
  choice(name: string): string;
}

interface AnyField {
  readonly name: string;
  readonly label: string;
  /** Asked again after each answer; default: always. */
  shownIf?(answers: Answers): boolean;
}

export interface NumberAsked extends AnyField {
  readonly kind: 'number';
  /** Default: none. */
  readonly value?: number;
  readonly placeholder?: string;
  /** Shown after the field. */
  readonly unit?: string;
}

export interface ChoiceAsked extends AnyField {
  readonly kind: 'choice';
  /** Default: the first. */
  readonly value?: string;
  readonly options: Choices;
  /** Has the focus first; default: the first number, else a button. */
  readonly autofocus?: boolean;
}

export interface CheckAsked extends AnyField {
  readonly kind: 'check';
  readonly value: boolean;
}

export type Asked = NumberAsked | ChoiceAsked | CheckAsked;

type More<A extends Asked> = Partial<Omit<A, 'kind' | 'name' | 'label'>>;

/** @param value default: none */
export function askNumber(name: string, label: string, value?: number, more?: More<NumberAsked>): NumberAsked {
  return { kind: 'number', name, label, ...(value !== undefined && { value }), ...more };
}

export function askChoice(name: string, label: string, options: Choices, more?: More<ChoiceAsked>): ChoiceAsked {
  return { kind: 'choice', name, label, options, ...more };
}

export interface FormParts {
  readonly about?: string;
  /** Elements are shown between the fields. */
  readonly asked: readonly (Asked | HTMLElement)[];
  /** Below the summary. */
  readonly below?: readonly HTMLElement[];
  /** Before Cancel. */
  readonly buttons?: readonly HTMLElement[];
  /** Other ways to apply the answers: they are refused together. */
  readonly beside?: readonly HTMLButtonElement[];
  /** Label of the button that applies them. */
  readonly apply: string;
  readonly applyTooltip?: string;
  /** An answer was changed: of a field, or of one of the elements between. */
  changed?(field: string | undefined): void;
  applied(): void;
  close(): void;
}

interface Field {
  readonly asked: Asked;
  readonly control: HTMLInputElement | HTMLSelectElement;
  readonly row: HTMLElement;
}

export class Form implements Answers {
  readonly element: HTMLFormElement;
  readonly cancel = plainButton('Cancel', () => this.parts.close());
  private readonly apply: HTMLButtonElement;
  private readonly summary = element('p', { class: 'tool-result', role: 'status' });
  private readonly fieldset = element('fieldset', { class: 'tool-fields' });
  private readonly fields = new Map<string, Field>();

  constructor(private readonly parts: FormParts) {
    const { about, asked, below = [], buttons = [], beside = [] } = parts;
    this.apply = element(
      'button',
      { type: 'submit', class: 'plain primary', tooltip: parts.applyTooltip },
      parts.apply,
    );
    this.fieldset.append(...asked.map((one) => (one instanceof HTMLElement ? one : this.rowOf(one))));
    this.element = element(
      'form',
      { class: 'tool-form' },
      about !== undefined && element('p', { class: 'faint' }, about),
      this.fieldset,
      this.summary,
      ...below,
      element('div', { class: 'tool-buttons' }, ...buttons, this.cancel, ...beside, this.apply),
    );
    this.showFields();
    this.element.addEventListener('input', ({ target }) => {
      const field = [...this.fields.values()].find(({ control }) => control === target);
      parts.changed?.(field?.asked.name);
      this.showFields();
    });
    this.element.addEventListener('submit', (event) => {
      event.preventDefault();
      if (!this.apply.disabled) parts.applied();
    });
  }

  number(name: string): number {
    const { asked } = this.field(name);
    const unit = asked.kind === 'number' ? asked.unit : undefined;
    const typed = parseNumber(this.text(name), unit ? unitsBehind(unit) : undefined);
    if (typed === undefined) throw new UserError(`${asked.label} must be a number.`);
    return typed;
  }

  choice(name: string): string {
    return this.field(name).control.value;
  }

  /** What was typed, without blanks around it. */
  text(name: string): string {
    return this.field(name).control.value.trim();
  }

  isChecked(name: string): boolean {
    const { control } = this.field(name);
    return control instanceof HTMLInputElement && control.checked;
  }

  isShown(name: string): boolean {
    return !this.field(name).row.hidden;
  }

  control(name: string): Field['control'] {
    return this.field(name).control;
  }

  /** Gives a field its first answer again, of options too. */
  reset(asked: Asked): void {
    const { control } = this.field(asked.name);
    if (asked.kind === 'choice') this.setOptions(asked.name, asked.options, asked.value);
    else if (asked.kind === 'number') control.value = asked.value === undefined ? '' : String(asked.value);
    else if (control instanceof HTMLInputElement) control.checked = asked.value;
  }

  /**
   * Replaces the options of a choice.
   *
   * @param value chosen if it is there, else the first is; default: what was chosen
   */
  setOptions(name: string, options: Choices, value = this.choice(name)): void {
    const { control } = this.field(name);
    control.replaceChildren(...optionsOf(options));
    const values = pairsOf(options).map(([own]) => own);
    control.value = values.includes(value) ? value : (values[0] ?? '');
  }

  /** The summary, or why the answers are refused. */
  say(text: string, isWrong = false): void {
    setText(this.summary, text);
    this.summary.classList.toggle('wrong', isWrong);
  }

  /** Whether the answers can be applied now. */
  allow(isAllowed: boolean): void {
    for (const button of [this.apply, ...(this.parts.beside ?? [])]) write(button, 'disabled', !isAllowed);
  }

  get isAllowed(): boolean {
    return !this.apply.disabled;
  }

  /** No answer can be changed meanwhile. */
  lock(isLocked: boolean): void {
    write(this.fieldset, 'disabled', isLocked);
  }

  /** Shows the fields that these answers ask for. */
  showFields(): void {
    for (const { asked, row } of this.fields.values()) write(row, 'hidden', asked.shownIf?.(this) === false);
  }

  private field(name: string): Field {
    const field = this.fields.get(name);
    if (!field) throw new Error(`The form has no field ${name}.`);
    return field;
  }

  private rowOf(asked: Asked): HTMLElement {
    const control = controlOf(asked);
    const label = element('span', {}, asked.label);
    const unit = asked.kind === 'number' && asked.unit ? element('span', { class: 'faint' }, asked.unit) : undefined;
    const row =
      asked.kind === 'check'
        ? element('label', { class: 'tool-check' }, control, label)
        : element('label', { class: 'tool-field' }, label, control, unit);
    this.fields.set(asked.name, { asked, control, row });
    return row;
  }
}

/** A button of a dialog that applies nothing by itself. */
export function plainButton(label: string, run: () => void): HTMLButtonElement {
  const made = element('button', { type: 'button', class: 'plain' }, label);
  made.addEventListener('click', run);
  return made;
}

function controlOf(asked: Asked): HTMLInputElement | HTMLSelectElement {
  switch (asked.kind) {
    case 'number':
      return element('input', {
        type: 'text',
        inputmode: 'decimal',
        autocomplete: 'off',
        class: 'number-field',
        placeholder: asked.placeholder,
        value: asked.value,
      });
    case 'check':
      return element('input', { type: 'checkbox', checked: asked.value });
    case 'choice': {
      const made = element('select', { autofocus: asked.autofocus === true }, ...optionsOf(asked.options));
      if (asked.value !== undefined) made.value = asked.value;
      return made;
    }
  }
}

function pairsOf(choices: Choices): readonly (readonly [value: string, label: string])[] {
  return Array.isArray(choices) ? choices : Object.entries(choices);
}

function optionsOf(choices: Choices): HTMLOptionElement[] {
  return pairsOf(choices).map(([value, label]) => element('option', { value }, label));
}
