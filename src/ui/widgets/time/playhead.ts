/** The playhead: a line through the ruler and all plots below it, and its time on a flag in the ruler. CSS pixels. */
import type { Extent } from './ruler.ts';

export interface FlagColours {
  readonly playhead: string;
  readonly playheadText: string;
  readonly font: string;
}

const LINE_WIDTH = 2;
/** Between a flag's text and its ends, and between the flag and the edges above and below. */
const PADDING = 5;
const INSET = 1;

/** By font and text; all digits are assumed to be as wide as 0. */
const widths = new Map<string, number>();
/** Fonts change only with the theme, and texts differ only in length: a few entries suffice. */
const MAX_WIDTHS = 256;

/** Cached, as measuring text every frame is slow. */
export function widthOf(g: CanvasRenderingContext2D, font: string, text: string): number {
  const key = `${font} ${text.replace(/\d/g, '0')}`;
  let width = widths.get(key);
  if (width === undefined) {
    if (widths.size >= MAX_WIDTHS) widths.clear();
    width = g.measureText(text).width;
    widths.set(key, width);
  }
  return width;
}

export function drawPlayheadLine(
  g: CanvasRenderingContext2D,
  x: number,
  top: number,
  bottom: number,
  colour: string,
): void {
  g.fillStyle = colour;
  g.fillRect(Math.round(x - LINE_WIDTH / 2), top, LINE_WIDTH, bottom - top);
}

/**
 * Where the flag of a playhead at `x` is: at the edges it stays in view, and only the line moves on; undefined far
 * outside.
 *
 * @param width of the ruler
 */
export function flagExtent(x: number, textWidth: number, width: number): Extent | undefined {
  const half = Math.ceil(textWidth / 2) + PADDING;
  if (x < -half || x > width + half) return undefined;
  const middle = Math.max(half, Math.min(width - half, x));
  return [Math.round(middle - half), Math.round(middle - half) + 2 * half];
}

/** @param height of the part of the ruler that has the numbers */
export function drawFlag(
  g: CanvasRenderingContext2D,
  [left, right]: Extent,
  text: string,
  height: number,
  colours: FlagColours,
): void {
  g.fillStyle = colours.playhead;
  g.beginPath();
  g.roundRect(left, INSET, right - left, height - 2 * INSET, 3);
  g.fill();
  g.font = colours.font;
  g.fillStyle = colours.playheadText;
  g.textAlign = 'center';
  g.textBaseline = 'middle';
  g.fillText(text, (left + right) / 2, height / 2);
}
