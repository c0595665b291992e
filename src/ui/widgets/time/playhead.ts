/** The playhead, drawn alike over the scrubber, the curves and the dope sheet: a line, and its time in the ruler. */

export interface Playhead {
  /** Centre of the line, in CSS pixels like everything here. */
  readonly x: number;
  readonly text: string;
  readonly lineWidth: number;
  /** Bottom end of the line. */
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

/** By font and text; all digits are assumed to be as wide as 0. */
const widths = new Map<string, number>();
/** Fonts change only with the theme, and texts differ only in length: a few entries suffice. */
const MAX_WIDTHS = 256;

/** CSS pixels. Cached, as measuring text every frame is slow. */
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
  // At the edges the label stays in view, and only the line moves on.
  const middle = Math.max(half, Math.min(width - half, x));
  g.beginPath();
  g.roundRect(Math.round(middle - half), inset, 2 * half, end - inset, 3);
  g.fill();
  g.fillStyle = colours.playheadText;
  g.textAlign = 'center';
  g.textBaseline = 'middle';
  g.fillText(text, Math.round(middle), rulerHeight / 2);
}
