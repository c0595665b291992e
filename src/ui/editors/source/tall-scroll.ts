/**
 * Scrolling through more lines than an element can be high: browsers stop at some 33 million pixels. Up to `MAX_HEIGHT`
 * a pixel scrolled is a pixel; above, the scroll bar stands for the whole file in proportion, and wheel and keys move
 * by lines.
 */
export const MAX_HEIGHT = 10_000_000;

export interface TallList {
  readonly lines: number;
  /** Pixels. */
  readonly lineHeight: number;
  /** Pixels in view. */
  readonly room: number;
}

/** The height of what is scrolled, in pixels. */
export function scrollHeight({ lines, lineHeight }: TallList): number {
  return Math.min(MAX_HEIGHT, lines * lineHeight);
}

/** The line at the top, from 0, with fractions, for a position of the scroll bar. */
export function topAt(list: TallList, scrollTop: number): number {
  const travel = scrollHeight(list) - list.room;
  return travel > 0 ? clampTop(list, (scrollTop / travel) * lastTop(list)) : 0;
}

/** The reverse of `topAt`. */
export function scrollTopOf(list: TallList, top: number): number {
  const last = lastTop(list);
  return last > 0 ? (top / last) * (scrollHeight(list) - list.room) : 0;
}

/** Within what can be scrolled to. */
export function clampTop(list: TallList, top: number): number {
  return Math.max(0, Math.min(lastTop(list), top));
}

/** The top that shows a line with the least movement; one that is far away comes to a third of the height. */
export function topToReveal(list: TallList, top: number, line: number): number {
  const inView = list.room / list.lineHeight;
  if (line >= top && line + 1 <= top + inView) return top;
  const isNear = line > top - inView / 2 && line < top + 1.5 * inView;
  if (!isNear) return clampTop(list, line - Math.floor(inView / 3));
  return clampTop(list, line < top ? line : line + 1 - inView);
}

function lastTop({ lines, lineHeight, room }: TallList): number {
  return Math.max(0, lines - room / lineHeight);
}
