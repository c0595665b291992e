/**
 * A number to read and to type: rounded while it is only looked at, exact once it has the focus. Enter takes what was
 * typed and lets go, Escape lets go without.
 */
import type { Units } from './arithmetic.ts';
import { element } from './dom.ts';
import { leaveField } from './focus.ts';
import { exact, notANumber, parseNumber } from './number-text.ts';
import { setTooltip } from './tooltip.ts';

export interface NumberFieldOptions {
  readonly label: string;
  readonly class?: string;
  /** What is shown without the focus. */
  text(value: number): string;
  /** Enter, or leaving the field. */
  commit(value: number): void;
  /** Why what was typed is not taken; the number that was there comes back. */
  refuse(reason: string): void;
  /** What an arrow key adds. */
  readonly step?: number;
  /** What may be typed behind a number. */
  units?(): Units;
}

export class NumberField {
  readonly element: HTMLInputElement;
  private value = Number.NaN;
  /** The text that stands for the value: while the field holds another one, someone is typing. */
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

  /** NaN: the field stands for no one number. */
  show(value: number): void {
    if (Object.is(value, this.value)) return;
    this.value = value;
    if (document.activeElement !== this.element) this.refresh();
    // What was typed and taken, or changed elsewhere; what is being typed stays.
    else if (this.element.value === this.own) {
      this.write(this.exactText);
      this.element.select();
    }
  }

  /** The same number in another manner. */
  refresh(): void {
    this.write(Number.isNaN(this.value) ? '' : this.options.text(this.value));
  }

  private write(text: string): void {
    this.own = text;
    if (this.element.value !== text) this.element.value = text;
  }

  /** What is there to be edited. */
  private get exactText(): string {
    return Number.isNaN(this.value) ? '' : exact(this.value);
  }

  /** Whoever takes it may be told of it later only: the text stays until then, and is not taken twice. */
  private finish(): void {
    const text = this.element.value;
    if (text === this.own) return;
    this.own = text;
    const typed = this.parse(text);
    if (typed === undefined) {
      // Emptied and left: given up, not mistyped.
      if (text.trim()) this.options.refuse(notANumber(this.options.label, text));
    } else if (typed !== this.value) this.options.commit(typed);
  }

  private parse(text: string): number | undefined {
    return parseNumber(text, this.options.units?.());
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
