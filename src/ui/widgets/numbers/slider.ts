/**
 * lil-gui's number controller with our behaviour: the slider is a line with a mark at zero and hatched ends beyond
 * limits, the field shows a rounded number until it is focused, and typing may exceed the slider's span.
 *
 * lil-gui reads and writes `object[property]`; here that is the slider's own binding, which the inspector updates from
 * the pose every frame.
 */

import type { Controller, GUI } from 'lil-gui';
import { NumberController } from 'lil-gui';
import { element, setAttribute, setStyle } from '../dom.ts';
import { leaveField } from '../focus/focus.ts';
import { isTypedIn } from '../focus/typing.ts';
import { contentOf } from '../section.ts';
import { setTooltip } from '../tooltip.ts';
import type { Units } from './arithmetic.ts';
import { exact, notANumber, parseNumber, shown } from './number-text.ts';

export interface SliderOptions {
  /** Span of the slider; absent for a field without a slider. */
  readonly span?: readonly [number, number];
  /** Range that may be typed; absent for any number. */
  readonly bounds?: readonly [number, number];
  /** What to do about the bounds, told when typing beyond them. */
  readonly remedy?: string;
  /** Limits, hatched beyond; within the span. */
  readonly limits?: readonly [number, number];
  /** The slider's step; an arrow key's is ten times that. */
  readonly step: number;
  readonly decimals: number;
  /** Shown after the number while it isn't edited. */
  readonly suffix?: string;
  /** Units that may be typed after a number. */
  readonly units?: Units;
  /** For several values, of which it shows one: typing the number that it shows is a change too. */
  readonly isForSeveral?: boolean;
}

/** What is typed in a slider's field. */
export interface Typed {
  readonly text: string;
  /** The value that `+=5` changes. */
  readonly from: number;
}

interface Binding {
  value: number;
  readonly options: SliderOptions;
}

export class Slider extends NumberController {
  declare readonly object: Binding;
  /** The number when the field got the focus. */
  private before = 0;
  /** The value that `+=5` changes. */
  private base = 0;
  private takenBack: (() => void) | undefined;
  private typing: Typed | undefined;

  /** @param refuse told why the input was refused or clamped */
  constructor(
    folder: GUI,
    label: string,
    value: number,
    options: SliderOptions,
    private readonly refuse: (reason: string) => void,
  ) {
    const binding: Binding = { value, options };
    super(folder, binding, 'value', options.span?.[0], options.span?.[1], undefined);
    this.step(options.step, false);
    this.name(label);
    setAttribute(this.$input, 'type', 'text');
    setAttribute(this.$input, 'inputmode', 'decimal');
    // On touch devices lil-gui starts with a field of type number, which can't show text such as `0°`.
    this.updateDisplay();
    // Why it is disabled is in the row's tooltip.
    setTooltip(this.$input, () =>
      this.$input.disabled ? undefined : `${exact(this.object.value)}${options.suffix ?? ''}`,
    );
    this.$input.addEventListener('focus', () => {
      this.before = this.base = this.object.value;
      this.$input.value = exact(this.object.value);
      this.$input.select();
    });
    // lil-gui would read `20+5` as 20, and stop at a comma, the decimal sign of many countries.
    this.$input.addEventListener(
      'input',
      (event) => {
        event.stopImmediatePropagation();
        const typed = numberTyped(this.$input.value, this.base, options);
        if (typed === undefined) this.takeBack();
        else this.setTyped(this._clamp(typed));
      },
      { capture: true },
    );
    // The same for its stepping by arrow keys and wheel.
    for (const kind of ['keydown', 'wheel'] as const) {
      this.$input.addEventListener(
        kind,
        (event) => {
          if (event instanceof KeyboardEvent ? !/^Arrow(Up|Down)$/.test(event.code) : !this._inputFocused) return;
          this.$input.value = exact(parseNumber(this.$input.value, options.units, this.base) ?? this.object.value);
        },
        { capture: true, passive: true },
      );
    }
    for (const kind of ['keydown', 'wheel'] as const) {
      this.$input.addEventListener(
        kind,
        (event) => {
          // After lil-gui has stepped the value.
          if (!(event instanceof KeyboardEvent) || /^Arrow(Up|Down)$/.test(event.code)) this.base = this.object.value;
        },
        { passive: true },
      );
    }
    // Before lil-gui replaces the text by its number.
    this.$input.addEventListener('blur', () => this.judge(label), { capture: true });
    this.$input.addEventListener('keydown', (event) => {
      if (event.key !== 'Escape') return;
      this.$input.value = exact(this.object.value);
      leaveField(this.$input);
      event.preventDefault();
    });
    if (options.span) this.drawScale(options.span, options.limits);
    // lil-gui drags with any button, so that opening the menu would set a value.
    this.$slider?.addEventListener(
      'mousedown',
      (event) => {
        if (event.button !== 0) event.stopImmediatePropagation();
      },
      { capture: true },
    );
    this.domElement.addEventListener('mousedown', endMissedDrag, { capture: true });
    // lil-gui waits for the finger to be lifted: else the next touch, wherever it is, would move the slider.
    this.$slider?.addEventListener('touchcancel', () => {
      this.takenBack?.();
      window.dispatchEvent(new Event('touchend'));
    });
  }

  /** Where the number is typed. */
  get field(): HTMLInputElement {
    return this.$input;
  }

  /** Contains the name. */
  get nameElement(): HTMLElement {
    return this.$name;
  }

  /** Shows its name as these, which alone don't identify it to screen readers. @param spoken name for them */
  showName(spoken: string, ...shownAs: Node[]): void {
    this.$name.replaceChildren(...shownAs);
    this.$input.removeAttribute('aria-labelledby');
    setAttribute(this.$input, 'aria-label', spoken);
  }

  /**
   * Called instead of setting the previous number when the input is invalid: lets the owner cancel its edit, so that
   * nothing is left of it.
   */
  onTakenBack(callback: () => void): this {
    this.takenBack = callback;
    return this;
  }

  /** In `onChange`: the text, if that was typed; undefined for a drag or a step. */
  get typed(): Typed | undefined {
    return this.typing;
  }

  private setTyped(value: number): void {
    this.typing = { text: this.$input.value, from: this.base };
    if (this.object.options.isForSeveral && Object.is(value, this.object.value)) this._callOnChange();
    else this.setValue(value);
    this.typing = undefined;
  }

  /** The text so far isn't what is meant: `20` of `20 km`. */
  private takeBack(): void {
    // Of several values, others may have changed while the shown one is as before.
    if (Object.is(this.object.value, this.before) && !this.object.options.isForSeveral) return;
    if (!this.takenBack) this.setValue(this.before);
    else {
      this.takenBack();
      this.showValue(this.before);
    }
  }

  /** Reports why the number isn't what was typed. */
  private judge(label: string): void {
    const text = this.$input.value;
    if (!isTypedIn(this.$input) || !text.trim() || text === exact(this.object.value)) return;
    const reason = refusalOf(label, text, this.object.options, this.base);
    if (reason) this.refuse(reason);
  }

  /** Shows another value without an edit. */
  showValue(value: number): void {
    if (Object.is(this.object.value, value)) return;
    this.object.value = value;
    this.updateDisplay();
  }

  override updateDisplay(): this {
    // Called by lil-gui's constructor, before any of our fields but the binding exist.
    const { value, options } = this.object;
    const { span } = options;
    if (span) {
      const at = Math.max(0, Math.min(1, (value - span[0]) / (span[1] - span[0] || 1)));
      setStyle(this.$slider, '--at', at.toFixed(4));
      this.$slider.classList.toggle('beyond', value < span[0] || value > span[1]);
    }
    if (!this._inputFocused) {
      const text = shown(value, options.decimals) + (options.suffix ?? '');
      if (this.$input.value !== text) this.$input.value = text;
    }
    return this;
  }

  override _clamp(value: number): number {
    const { span, bounds } = this.object.options;
    const range = this._inputFocused ? bounds : (span ?? bounds);
    return range ? Math.min(range[1], Math.max(range[0], value)) : value;
  }

  /** Steps from zero; lil-gui steps from the minimum, which gives odd numbers. */
  override _snap(value: number): number {
    return Number((Math.round(value / this._step) * this._step).toPrecision(12));
  }

  /** lil-gui expects it where it was put; it may have moved to a row with others. */
  override destroy(): void {
    contentOf(this.parent).append(this.domElement);
    super.destroy();
  }

  private drawScale([low, high]: readonly [number, number], limits?: readonly [number, number]): void {
    const size = high - low || 1;
    const partOf = (value: number) => Math.max(0, Math.min(1, (value - low) / size));
    const part = (value: number) => `${(100 * partOf(value)).toFixed(2)}%`;
    const { style, classList } = this.$slider;
    style.setProperty('--zero', partOf(0).toFixed(4));
    classList.toggle('has-zero', low < 0 && high > 0);
    if (!limits) return;
    const hatched = (side: string, width: string) => {
      const mark = element('span', { class: 'limit' });
      mark.style.setProperty(side, '0');
      // If the slider ends at the limit, a short end marks it.
      mark.style.width = `max(${width}, 5px)`;
      return mark;
    };
    this.$slider.append(hatched('left', part(limits[0])), hatched('right', part(low + high - limits[1])));
  }
}

/** lil-gui waits for the button to be let go, which a page doesn't hear of under a system's dialog. */
function endMissedDrag(): void {
  const listening = new AbortController();
  const { signal } = listening;
  const move = ({ buttons }: MouseEvent) => buttons === 0 && window.dispatchEvent(new MouseEvent('mouseup'));
  window.addEventListener('mousemove', move, { capture: true, signal });
  window.addEventListener('mouseup', () => listening.abort(), { signal });
}

/**
 * The number of a text; `from` itself if the text is what is shown of it, to its last digit: typing what is there
 * already changes nothing. With more digits it is exact. Undefined if invalid.
 *
 * @param from the value that is shown, and that `+=5` changes
 */
export function numberTyped(
  text: string,
  from: number,
  { units, decimals }: Pick<SliderOptions, 'units' | 'decimals'>,
): number | undefined {
  const typed = parseNumber(text, units, from);
  const seen = shown(from, decimals);
  return typed === parseNumber(seen, units) && digitsIn(text) <= digitsIn(seen) ? from : typed;
}

function digitsIn(text: string): number {
  return text.replace(/\D/g, '').length;
}

/** Why a text is refused or clamped; undefined if it is accepted. @param from the value that `+=5` changes */
export function refusalOf(label: string, text: string, options: SliderOptions, from?: number): string | undefined {
  const { bounds, suffix = '', remedy, units } = options;
  const typed = parseNumber(text, units, from);
  if (typed === undefined) return notANumber(label, text);
  if (!bounds || (typed >= bounds[0] && typed <= bounds[1])) return undefined;
  const inUnit = (value: number) => `${shown(value)}${suffix}`;
  const [low, high] = bounds;
  // One end may be unlimited.
  const end = typed < low ? `can’t go below ${inUnit(low)}` : `can’t go above ${inUnit(high)}`;
  const where = low === high ? `is limited to ${inUnit(low)}` : end;
  return `${label} ${where}; you entered ${inUnit(typed)}.${remedy ? ` ${remedy}` : ''}`;
}

/** Shows another value in a row of lil-gui's own, without an edit. */
export function showIn(row: Controller, value: unknown): void {
  if (row.getValue() === value) return;
  Reflect.set(row.object, row.property, value);
  row.updateDisplay();
}

/** Removes every controller of a section. */
export function removeControllers(gui: GUI): void {
  for (const controller of [...gui.controllers]) controller.destroy();
}
