/**
 * What is written beside the gizmo: the joint's name, and a DOF with its limits; that of the handle under the pointer
 * or in the hand, else the active one. To the right of the rings, or to the left where there is no room, never over
 * them.
 */
import type { Layout } from '../../../view/gizmo/shapes.ts';
import type { ScreenBox } from '../../../view/overlay.ts';
import { element, setStyle, setText, write } from '../../widgets/dom.ts';

/** CSS pixels from the outermost ring, and from the viewport's edges. */
const BESIDE = 18;
const EDGE = 4;
/** Below the bars along the viewport's upper edge. */
const TOP = 84;

/** The lines of the chip. */
export interface ChipText {
  readonly name: string;
  /** At rest: the active DOF. */
  readonly value: string;
  readonly limits: string;
}

/**
 * The chip's left and top, in CSS pixels of the viewport.
 *
 * @param size width and height of the chip
 * @param view width and height of the viewport
 */
export function chipPlace(
  { pivot: [x, y], outer }: Pick<Layout, 'pivot' | 'outer'>,
  [width, height]: readonly [number, number],
  view: readonly [number, number],
): readonly [left: number, top: number] {
  const right = x + outer + BESIDE;
  const left = x - outer - BESIDE - width;
  const fitsRight = right + width + EDGE <= view[0];
  const top = Math.min(Math.max(y - outer / 2 - height / 2, TOP), Math.max(EDGE, view[1] - height - EDGE));
  return [fitsRight || left < EDGE ? right : left, top];
}

export class GizmoChip {
  private readonly name = element('b', { class: 'chip-name' });
  private readonly value = element('span');
  private readonly note = element('span', { class: 'hand-note' });
  private readonly live = element('span', { class: 'hand-readout', hidden: true }, this.value, this.note);
  private readonly restValue = element('span');
  private readonly limits = element('span', { class: 'chip-limits' });
  private readonly rest = element('span', { class: 'chip-rest' }, this.restValue, this.limits);
  readonly element = element(
    'div',
    { class: 'gizmo-chip', 'aria-hidden': 'true', hidden: true },
    this.name,
    this.live,
    this.rest,
  );
  /** Measured when a text changes. */
  private size: readonly [number, number] | undefined;
  private shown = '';

  /** @param container the element that contains the viewport */
  constructor(container: HTMLElement) {
    container.append(this.element);
  }

  /** The value of a handle, instead of the active DOF's. @param note what limits the drag, if anything */
  show(value: string, note = ''): void {
    setText(this.value, value);
    setText(this.note, note);
    write(this.note, 'hidden', note === '');
    write(this.live, 'hidden', false);
    write(this.rest, 'hidden', true);
  }

  /** The active DOF's again. */
  hide(): void {
    write(this.live, 'hidden', true);
    write(this.rest, 'hidden', this.restValue.textContent === '');
  }

  /** Beside the gizmo; undefined: there is none. Returns the place that it takes. */
  place(layout: Layout | undefined, text: ChipText | undefined, width: number, height: number): ScreenBox | undefined {
    const { element: chip } = this;
    write(chip, 'hidden', !(layout && text));
    if (!layout || !text) return undefined;
    setText(this.name, text.name);
    setText(this.restValue, text.value);
    setText(this.limits, text.limits);
    if (this.live.hidden) write(this.rest, 'hidden', text.value === '');
    const shown = chip.textContent + String(this.live.hidden);
    if (shown !== this.shown || !this.size) this.size = [chip.offsetWidth, chip.offsetHeight];
    this.shown = shown;
    const [left, top] = chipPlace(layout, this.size, [width, height]);
    setStyle(chip, 'transform', `translate(${Math.round(left)}px, ${Math.round(top)}px)`);
    return [left, top, left + this.size[0], top + this.size[1]];
  }

  remove(): void {
    this.element.remove();
  }
}
