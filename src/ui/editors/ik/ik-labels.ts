/** A few labels beside points in the viewport: names of pins, and why one can't reach its target. */

import type { Uses } from '../../state/workbench.ts';
import { element, setStyle, setText, write } from '../../widgets/dom.ts';
import type { PlaceOnScreen } from './nearest-on-screen.ts';

export type LabelKind = 'name' | 'gap';

export interface Label {
  readonly text: string;
  readonly kind: LabelKind;
  /** Client coordinates of its point. */
  readonly x: number;
  readonly y: number;
  /** What it is about: of several for one thing the last is shown. */
  readonly of: string;
  /** Preferred side of its point: away from the character's centre. */
  readonly side: 'left' | 'right';
}

/** CSS pixels from the point, and from the viewport's edges. */
const BESIDE = 14;
const EDGE = 4;
/** Gap above and below the toolbar at the top. */
const HEAD_ROOM = 12;
/** CSS pixels: maximum width of a label, as in `ik.css`, and size of a letter and line. */
const WIDEST = 280;
const LETTER = 7;
const LINE = 16;
/** Radius around a pin that no label may cover, CSS pixels. */
const CLEAR = 9;
/** CSS pixels: in narrower viewports a long label beside its point would cover the character. */
const NARROW = 600;
/** Vertical offsets, in label heights, tried if both sides are taken. */
const SHIFTS = [0, 1, -1, 2, -2];

/** One label per thing: the one with a pin's problem also names the pin. */
export function oneForEach(labels: readonly Label[]): Label[] {
  return [...new Map(labels.map((label) => [label.of, label])).values()];
}

/** Whether a label is put below the toolbar instead of beside its point. It names what it is about. */
export function isAside({ kind }: Pick<Label, 'kind'>, width: number): boolean {
  return kind === 'gap' && width < NARROW;
}

/** Placement of a label relative to its point. */
export interface LabelSpot {
  readonly side: Label['side'];
  /** Offset of its centre below the point, CSS pixels. */
  readonly lower: number;
}

/**
 * Chooses a label's side: its preferred one if it fits and covers no pin; else the other; else higher or lower.
 * Approximate, since nothing is measured.
 *
 * @param x of its point, from the viewport's left
 * @param width of the viewport
 * @param pins not to be covered, in the same coordinates
 */
export function labelSpot(
  { side, text }: Pick<Label, 'side' | 'text'>,
  x: number,
  y: number,
  width: number,
  pins: readonly PlaceOnScreen[] = [],
): LabelSpot {
  const wide = Math.min(WIDEST, text.length * LETTER);
  const high = LINE * Math.ceil((text.length * LETTER) / WIDEST) + 2;
  const room = BESIDE + EDGE + wide;
  const [hasLeft, hasRight] = [x >= room, x + room <= width];
  // Never cover the point itself: without room on one side, use the other.
  const other: Label['side'] = side === 'right' ? 'left' : 'right';
  const has = { left: hasLeft || !hasRight, right: hasRight || !hasLeft };
  const sides = [side, other].filter((one) => has[one]);
  const isFree = (on: Label['side'], lower: number) => {
    const near = x + (on === 'right' ? BESIDE : -BESIDE);
    const [left, right] = on === 'right' ? [near, near + wide] : [near - wide, near];
    return !pins.some(
      (pin) => pin.x > left - CLEAR && pin.x < right + CLEAR && Math.abs(pin.y - y - lower) < 0.5 * high + CLEAR,
    );
  };
  for (const shift of SHIFTS) {
    for (const on of sides) if (isFree(on, shift * (high + CLEAR))) return { side: on, lower: shift * (high + CLEAR) };
  }
  return { side: sides[0], lower: 0 };
}

/**
 * The CSS position, without measuring: percentages refer to the label's own size.
 *
 * @param top height of the toolbar over the viewport
 */
export function labelPlace(
  { side, lower }: LabelSpot,
  x: number,
  y: number,
  width: number,
  height: number,
  top = 0,
): string {
  const px = (value: number) => `${value.toFixed(1)}px`;
  const start = side === 'right' ? px(x + BESIDE) : `calc(${px(x - BESIDE)} - 100%)`;
  const within = (from: number, to: number, at: string) => `clamp(${px(from)}, ${at}, calc(${px(to - EDGE)} - 100%))`;
  return `translate(${within(EDGE, width, start)}, ${within(headRoom(top), height, `calc(${px(y + lower)} - 50%)`)})`;
}

/** CSS pixels covered at the top. */
function headRoom(top: number): number {
  return top > 0 ? top + HEAD_ROOM : EDGE;
}

export class IkLabels {
  readonly element = element('div', { class: 'ik-labels' });
  private readonly lines: HTMLElement[] = [];
  /** Announces the problem once it is stable: it changes with every move. */
  private readonly spoken = element('div', { class: 'visually-hidden', role: 'status' });

  /** Height of the toolbar over the viewport. */
  private top = 0;
  private readonly resizing = new ResizeObserver(([{ target }]) => {
    this.top = target.clientHeight;
  });

  constructor(private readonly wb: Uses<'viewport' | 'viewportElement'>) {
    this.element.append(this.spoken);
  }

  enter(): void {
    const { viewportElement } = this.wb;
    viewportElement.append(this.element);
    const head = viewportElement.parentElement?.querySelector('.stage-head');
    if (head) this.resizing.observe(head);
  }

  leave(): void {
    this.resizing.disconnect();
    this.element.remove();
  }

  /** @param pins client coordinates that no label may cover */
  show(labels: readonly Label[], pins: readonly PlaceOnScreen[]): void {
    const { left, top, width, height } = labels.length
      ? this.wb.viewport.canvas.getBoundingClientRect()
      : { left: 0, top: 0, width: 0, height: 0 };
    const shown = oneForEach(labels);
    setStyle(this.element, 'padding-top', `${headRoom(this.top)}px`);
    const taken = shown.length ? pins.map((pin) => ({ x: pin.x - left, y: pin.y - top })) : [];
    shown.forEach((label, i) => {
      const { text, kind, x, y } = label;
      const line = this.line(i);
      setText(line, text);
      write(line.dataset, 'kind', kind);
      const isOut = x < left || y < top || x > left + width || y > top + height;
      // If a target is out of view, its problem is still shown, at the edge.
      write(line, 'hidden', isOut && kind === 'name');
      line.classList.toggle('aside', isAside(label, width));
      if (isAside(label, width)) {
        setStyle(line, 'transform', '');
        return;
      }
      const inX = Math.min(Math.max(x - left, 0), width);
      const inY = Math.min(Math.max(y - top, 0), height);
      const spot = labelSpot(label, inX, inY, width, taken);
      write(line.dataset, 'side', spot.side);
      setStyle(line, 'transform', labelPlace(spot, inX, inY, width, height, this.top));
    });
    for (let i = shown.length; i < this.lines.length; i++) write(this.lines[i], 'hidden', true);
  }

  /** For screen readers. */
  say(text: string): void {
    setText(this.spoken, text);
  }

  private line(i: number): HTMLElement {
    let line = this.lines[i];
    if (!line) {
      line = element('div', { class: 'ik-label', 'aria-hidden': 'true' });
      this.lines.push(line);
      this.element.append(line);
    }
    return line;
  }
}
