/**
 * The dope sheet's coordinates, in CSS pixels from the picture's top left corner:
 *
 *     y = 0            ┌── time ruler ──────────────┐
 *     STRIP_TOP        ├── strip of the selection ──┤   what is selected, as one bar: moved and scaled by it
 *     HEAD             ├── row 0, the summary ──────┤   stays where it is
 *     HEAD + row       ├── rows 1 … ────────────────┤   scrolled by `scrollTop`
 *                      └────────────────────────────┘ height
 *                 x = 0 (window.from)           width (window.to)
 *
 * Times are the transport's unless they are called the clip's.
 */
import type { TimeWindow } from '../../kit/time-window.ts';
import { TIME_RULER_HEIGHT } from '../timeline/time-ruler.ts';

export const STRIP_TOP: number = TIME_RULER_HEIGHT;
export const STRIP_HEIGHT = 10;
export const HEAD: number = STRIP_TOP + STRIP_HEIGHT;

export interface Sheet {
  readonly width: number;
  readonly height: number;
  readonly window: TimeWindow;
  readonly rowHeight: number;
  /** The summary is one of them. */
  readonly rowCount: number;
  /** Pixels that the rows below the summary are scrolled up by. */
  readonly scrollTop: number;
}

export function secondsPerPixel({ window, width }: Sheet): number {
  return (window.to - window.from) / Math.max(1, width);
}

export function sheetX(sheet: Sheet, seconds: number): number {
  return (seconds - sheet.window.from) / secondsPerPixel(sheet);
}

export function sheetTime(sheet: Sheet, x: number): number {
  return sheet.window.from + x * secondsPerPixel(sheet);
}

/** Where the scrolled rows begin. */
export function rowsTop({ rowHeight }: Sheet): number {
  return HEAD + rowHeight;
}

/** Upper edge of a row, on screen or not. */
export function rowTop(sheet: Sheet, row: number): number {
  return row === 0 ? HEAD : HEAD + row * sheet.rowHeight - sheet.scrollTop;
}

/** The row at a height; undefined on the ruler, the strip, and below the last row. */
export function rowAt(sheet: Sheet, y: number): number | undefined {
  if (y < HEAD || sheet.rowCount === 0) return undefined;
  if (y < rowsTop(sheet)) return 0;
  const row = Math.floor((y - HEAD + sheet.scrollTop) / sheet.rowHeight);
  return row < sheet.rowCount ? row : undefined;
}

/** First and end (not included) of the scrolled rows that can be seen. */
export function rowsInView(sheet: Sheet): readonly [number, number] {
  const first = 1 + Math.floor(sheet.scrollTop / sheet.rowHeight);
  const end = Math.ceil((sheet.height - HEAD + sheet.scrollTop) / sheet.rowHeight);
  return [Math.max(1, first), Math.max(1, Math.min(sheet.rowCount, end))];
}
