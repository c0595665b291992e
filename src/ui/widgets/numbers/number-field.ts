/**
 * A number field: rounded for display, exact while focused. Enter commits and leaves the field, Escape leaves it
 * without committing.
 */

import { element } from '../dom.ts';
import { leaveField } from '../focus/focus.ts';
import { setTooltip } from '../tooltip.ts';
import type { Units } from './arithmetic.ts';
import { exact, notANumber, parseNumber } from './number-text.ts';

export interface NumberFieldOptions {
  readonly label: string;
  readonly class?: string;
  /** Text shown without the focus. */
  text(value: number): string;
  /** On Enter, or on leaving the field. */
  commit(value: number): void;
  /** Why the input was refused; the previous number is shown again. */
  refuse(reason: string): void;
  /** Step of the arrow keys. */
  readonly step?: number;
  /** Units that may be typed after a number. */
  units?(): Units;
}

export class NumberField {
  readonly element: HTMLInputElement;
  private value = Number.NaN;
  /** The value's text: while the field holds another one, the user is typing. */
  private own = '';

  constructor(private readonly options: NumberFieldOptions) {
    this.element = element('input', {
      type: 'text',
      inputmode: 'decimal',
      spellcheck: 'false',
      autocomplete: 'off',
      class: `number-field ${options.class ?? ''}`,
      'aria-label': options.label,
    });
    const { label } = options;
    setTooltip(this.element, () => (Number.isNaN(this.value) ? label : `${label}: ${exact(this.value)}`));
    this.element.addEventListener('focus', () => {
      this.write(this.exactText);
      this.element.select();
    });
    this.element.addEventListener('blur', () => {
      this.finish();
      this.refresh();
    });
    this.element.addEventListener('keydown', (event) => this.onKey(event));
  }

  /** NaN: no single number to show. */
  show(value: number): void {
    if (Object.is(value, this.value)) return;
    this.value = value;
    if (document.activeElement !== this.element) this.refresh();
    // Committed, or changed elsewhere; text being typed stays.
    else if (this.element.value === this.own) {
      this.write(this.exactText);
      this.element.select();
    }
  }

  /** The same number in another format. */
  refresh(): void {
    this.write(Number.isNaN(this.value) ? '' : this.options.text(this.value));
  }

  private write(text: string): void {
    this.own = text;
    if (this.element.value !== text) this.element.value = text;
  }

  /** Text for editing. */
  private get exactText(): string {
    return Number.isNaN(this.value) ? '' : exact(this.value);
  }

  /** The new value may arrive later: the text stays until then, and isn't committed twice. */
  private finish(): void {
    const text = this.element.value;
    if (text === this.own) return;
    this.own = text;
    const typed = this.parse(text);
    if (typed === undefined) {
      // An emptied field was abandoned, not mistyped.
      if (text.trim()) this.options.refuse(notANumber(this.options.label, text));
    } else if (typed !== this.value) this.options.commit(typed);
  }

  private parse(text: string): number | undefined {
    return parseNumber(text, this.options.units?.(), this.value);
  }

  private onKey(event: KeyboardEvent): void {
    const { step } = this.options;
    if (event.key === 'Enter') {
      this.finish();
      leaveField(this.element);
    } else if (event.key === 'Escape') {
      this.write(this.exactText);
      leaveField(this.element);
    } else if (step && (event.key === 'ArrowUp' || event.key === 'ArrowDown')) {
      const sign = event.key === 'ArrowUp' ? 1 : -1;
      const typed = this.parse(this.element.value) ?? this.value;
      if (Number.isNaN(typed)) return;
      const next = Number((typed + sign * step * (event.shiftKey ? 10 : 1)).toPrecision(12));
      this.write(exact(next));
      this.options.commit(next);
    } else return;
    event.preventDefault();
  }
}
