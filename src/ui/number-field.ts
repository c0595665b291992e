/** A number to read and to type: rounded while it is only looked at, exact once it has the focus. */
import { element } from './dom.ts';
import { exact, parseNumber } from './number-text.ts';

export interface NumberFieldOptions {
  readonly label: string;
  readonly class?: string;
  /** What is shown without the focus. */
  text(value: number): string;
  /** Enter, or leaving the field. */
  commit(value: number): void;
  /** What an arrow key adds. */
  readonly step?: number;
}

export class NumberField {
  readonly element: HTMLInputElement;
  private value = Number.NaN;

  constructor(private readonly options: NumberFieldOptions) {
    this.element = element('input', {
      type: 'text',
      inputmode: 'decimal',
      spellcheck: 'false',
      autocomplete: 'off',
      class: `number-field ${options.class ?? ''}`,
      'aria-label': options.label,
    });
    this.element.addEventListener('focus', () => {
      this.element.value = exact(this.value);
      this.element.select();
    });
    this.element.addEventListener('blur', () => {
      this.finish();
      this.refresh();
    });
    this.element.addEventListener('keydown', (event) => this.onKey(event));
  }

  show(value: number): void {
    if (Object.is(value, this.value)) return;
    this.value = value;
    if (document.activeElement !== this.element) this.refresh();
  }

  /** The same number in another manner. */
  refresh(): void {
    const text = Number.isNaN(this.value) ? '' : this.options.text(this.value);
    if (this.element.value !== text) this.element.value = text;
    // Exact also for who only looks.
    if (!Number.isNaN(this.value)) this.element.title = `${this.options.label}: ${exact(this.value)}`;
  }

  private finish(): void {
    const typed = parseNumber(this.element.value);
    if (typed === undefined || typed === this.value) return;
    this.options.commit(typed);
  }

  private onKey(event: KeyboardEvent): void {
    const { step } = this.options;
    if (event.key === 'Enter') {
      this.finish();
      this.element.value = exact(this.value);
      this.element.select();
    } else if (event.key === 'Escape') {
      this.element.value = exact(this.value);
      this.element.blur();
    } else if (step && (event.key === 'ArrowUp' || event.key === 'ArrowDown')) {
      const sign = event.key === 'ArrowUp' ? 1 : -1;
      const typed = parseNumber(this.element.value) ?? this.value;
      this.options.commit(Number((typed + sign * step * (event.shiftKey ? 10 : 1)).toPrecision(12)));
      this.element.value = exact(this.value);
    } else return;
    event.preventDefault();
  }
}
