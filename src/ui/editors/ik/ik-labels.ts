/** A few lines of text that stand beside points of the picture: names of pins, and what is in the way of one. */
import { element, setText } from '../../kit/dom.ts';
import type { Uses } from '../../state/workbench.ts';
import type { PlaceOnScreen } from './nearest-on-screen.ts';

export type LabelKind = 'name' | 'gap';

export interface Label {
  readonly text: string;
  readonly kind: LabelKind;
  /** Client coordinates of the point that it stands beside. */
  readonly x: number;
  readonly y: number;
  /** What it is about: of several of one thing the last one is shown. */
  readonly of: string;
  /** Where it stands of its point: on the side away from the character's middle, which it would hide. */
  readonly side: 'left' | 'right';
}

/** CSS pixels from the point, and from the edges of the picture. */
const BESIDE = 14;
const EDGE = 4;
/** Above and below what floats over the top. */
const HEAD_ROOM = 12;
/** CSS pixels: of a label, as `ik.css` has it, of a letter of the small font and of its lines. */
const WIDEST = 280;
const LETTER = 7;
const LINE = 16;
/** CSS pixels about a pin that no label is to cover. */
const CLEAR = 9;
/** Up and down, in heights of the label, where both sides are taken. */
const SHIFTS = [0, 1, -1, 2, -2];

/** One for each thing: what is in the way of a pin says whose it is as well. */
export function oneForEach(labels: readonly Label[]): Label[] {
  return [...new Map(labels.map((label) => [label.of, label])).values()];
}

/** Where a label stands beside its point. */
export interface LabelSpot {
  readonly side: Label['side'];
  /** CSS pixels that its middle is below the point. */
  readonly lower: number;
}

/**
 * Which side of its point a label stands on: its own, where there is room for it and no pin under it; else the other;
 * else higher or lower. About: nothing is measured.
 * @param x of its point, from the picture's left
 * @param width of the picture
 * @param pins what it is not to cover, in the same coordinates
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
  // The point itself is not to be hidden: where there is no room on one side, it is the other.
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
 * Where that is, as CSS has it, with nothing measured: percentages are of the label's own size.
 * @param top how high what floats over the top of the picture is
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
  const high = top > 0 ? top + HEAD_ROOM : EDGE;
  return `translate(${within(EDGE, width, start)}, ${within(high, height, `calc(${px(y + lower)} - 50%)`)})`;
}

export class IkLabels {
  readonly element = element('div', { class: 'ik-labels' });
  private readonly lines: HTMLElement[] = [];
  /** What is in the way, said once it stays: it changes with every move of the hand. */
  private readonly spoken = element('div', { class: 'visually-hidden', role: 'status' });

  /** Under what floats over the picture's top. */
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

  /** @param pins client coordinates of what no label is to cover */
  show(labels: readonly Label[], pins: readonly PlaceOnScreen[]): void {
    const { left, top, width, height } = labels.length
      ? this.wb.viewport.canvas.getBoundingClientRect()
      : { left: 0, top: 0, width: 0, height: 0 };
    const shown = oneForEach(labels);
    const taken = shown.length ? pins.map((pin) => ({ x: pin.x - left, y: pin.y - top })) : [];
    shown.forEach((label, i) => {
      const { text, kind, x, y } = label;
      const line = this.line(i);
      setText(line, text);
      line.dataset.kind = kind;
      const isOut = x < left || y < top || x > left + width || y > top + height;
      // A target out of the picture still says what is in the way, at the edge.
      line.hidden = isOut && kind === 'name';
      const inX = Math.min(Math.max(x - left, 0), width);
      const inY = Math.min(Math.max(y - top, 0), height);
      const spot = labelSpot(label, inX, inY, width, taken);
      line.dataset.side = spot.side;
      line.style.transform = labelPlace(spot, inX, inY, width, height, this.top);
    });
    for (let i = shown.length; i < this.lines.length; i++) this.lines[i].hidden = true;
  }

  /** For who can't see it. */
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
    line.hidden = false;
    return line;
  }
}
