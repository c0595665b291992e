/** The playhead, drawn alike over the scrubber, the curves and the dope sheet: a line, and what time it is in the ruler. */

export interface Playhead {
  /** Of the line's middle, in CSS pixels as everything here. */
  readonly x: number;
  readonly text: string;
  readonly lineWidth: number;
  /** How far the line goes down. */
  readonly bottom: number;
}

export interface PlayheadPlace {
  readonly width: number;
  readonly rulerHeight: number;
  /** Between the ruler's edges and the label. */
  readonly inset: number;
}

export interface PlayheadColours {
  readonly playhead: string;
  readonly playheadText: string;
  readonly font: string;
}

/** By font and text; digits are all taken to be as wide as 0, which a label has room for. */
const widths = new Map<string, number>();
/** Fonts change with the theme at most, and texts by their length: it is never so many. */
const MAX_WIDTHS = 256;

/** CSS pixels. Asked in every frame, and measuring text is slow. */
function widthOf(g: CanvasRenderingContext2D, font: string, text: string): number {
  const key = `${font} ${text.replace(/\d/g, '0')}`;
  let width = widths.get(key);
  if (width === undefined) {
    if (widths.size >= MAX_WIDTHS) widths.clear();
    width = g.measureText(text).width;
    widths.set(key, width);
  }
  return width;
}

export function drawPlayheadAt(
  g: CanvasRenderingContext2D,
  { x, text, lineWidth, bottom }: Playhead,
  { width, rulerHeight, inset }: PlayheadPlace,
  colours: PlayheadColours,
): void {
  g.font = colours.font;
  const half = Math.ceil(widthOf(g, colours.font, text) / 2) + 5;
  if (x < -half || x > width + half) return;
  const end = rulerHeight - 1 - inset;
  g.fillStyle = colours.playhead;
  g.fillRect(Math.round(x - lineWidth / 2), end, lineWidth, bottom - end);
  // At the edges the label stays whole, and only the line goes on.
  const middle = Math.max(half, Math.min(width - half, x));
  g.beginPath();
  g.roundRect(Math.round(middle - half), inset, 2 * half, end - inset, 3);
  g.fill();
  g.fillStyle = colours.playheadText;
  g.textAlign = 'center';
  g.textBaseline = 'middle';
  g.fillText(text, Math.round(middle), rulerHeight / 2);
}
