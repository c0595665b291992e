/** Dragging a row of the list of layers up or down: a line shows where it will be; Escape gives up. */
import { element } from '../../widgets/dom.ts';
import { followPointer } from '../../widgets/drag.ts';
import { waitOutDrag } from '../../widgets/focus/keyboard.ts';

/** A press that moves less is a click. */
const CLICK_PIXELS = 4;

export interface OrderedList {
  readonly element: HTMLElement;
  readonly space: HTMLElement;
  /** CSS pixels. */
  rowHeight(): number;
  /** Number of rows that can be moved; they come first. */
  movable(): number;
  /** The row of an event; −1 for none. */
  indexOf(event: Event): number;
  /** A row goes to another place in the list. */
  move(from: number, to: number): void;
}

/** The place that a row comes to when it is dropped between two. @param gap 0 above the first row */
export function placeAfterDrop(from: number, gap: number): number {
  return gap > from ? gap - 1 : gap;
}

export function letRowsBeMoved(list: OrderedList): void {
  let press: PointerEvent | undefined;
  list.element.addEventListener('pointerdown', (event) => {
    const { target, button, pointerType } = event;
    const isRow = target instanceof Element && !target.closest('input,button');
    press = button === 0 && pointerType !== 'touch' && isRow ? event : undefined;
  });
  list.element.addEventListener('pointermove', (event) => {
    const from = press ? list.indexOf(press) : -1;
    if (!press || event.buttons === 0 || from < 0 || from >= list.movable()) return;
    if (Math.abs(event.clientY - press.clientY) <= CLICK_PIXELS) return;
    press = undefined;
    // Captured only now: a click on the captured list would be of no row.
    follow(list, from, event);
  });
}

function follow(list: OrderedList, from: number, begin: PointerEvent): void {
  const line = element('div', { class: 'drop-line layer-drop' });
  let gap = from;
  const move = ({ clientY }: PointerEvent) => {
    const { top } = list.space.getBoundingClientRect();
    gap = Math.max(0, Math.min(list.movable(), Math.round((clientY - top) / list.rowHeight())));
    line.style.top = `${gap * list.rowHeight() - 1}px`;
  };
  list.space.append(line);
  move(begin);
  const stop = followPointer(list.element, begin, {
    move,
    key(event) {
      waitOutDrag(event);
      if (event.key !== 'Escape') return;
      event.preventDefault();
      event.stopPropagation();
      line.remove();
      stop();
    },
    over(_, release) {
      line.remove();
      const to = release ? placeAfterDrop(from, gap) : from;
      if (to !== from) list.move(from, to);
    },
  });
}
