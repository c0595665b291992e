/**
 * The dope sheet's coordinates, in CSS pixels from the picture's top left corner:
 *
 *     y = 0            ┌── strip of the selection ──┐   the selection as a bar, to move and scale it
 *     HEAD             ├── row 0, the summary ──────┤   doesn't scroll
 *     HEAD + row       ├── rows 1 … ────────────────┤   scrolled by `scrollTop`
 *                      └────────────────────────────┘ height
 *                 x = 0 (window.from)           width (window.to)
 *
 * Times are the transport's unless stated otherwise.
 */
import type { TimeStrip } from '../../widgets/time/time-window.ts';

/** Height of the strip. */
export const HEAD = 10;

export interface Sheet extends TimeStrip {
  readonly height: number;
  readonly rowHeight: number;
  /** Including the summary. */
  readonly rowCount: number;
  /** Scroll offset in pixels of the rows below the summary. */
  readonly scrollTop: number;
}

/** Top of the scrolled rows. */
export function rowsTop({ rowHeight }: Sheet): number {
  return HEAD + rowHeight;
}

/** Top of a row, visible or not. */
export function rowTop(sheet: Sheet, row: number): number {
  return row === 0 ? HEAD : HEAD + row * sheet.rowHeight - sheet.scrollTop;
}

/** The row at a height; undefined on the strip and below the last row. */
export function rowAt(sheet: Sheet, y: number): number | undefined {
  if (y < HEAD || sheet.rowCount === 0) return undefined;
  if (y < rowsTop(sheet)) return 0;
  const row = Math.floor((y - HEAD + sheet.scrollTop) / sheet.rowHeight);
  return row < sheet.rowCount ? row : undefined;
}

/** First and end (exclusive) of the scrolled rows in view. */
export function rowsInView(sheet: Sheet): readonly [number, number] {
  const first = 1 + Math.floor(sheet.scrollTop / sheet.rowHeight);
  const end = Math.ceil((sheet.height - HEAD + sheet.scrollTop) / sheet.rowHeight);
  return [Math.max(1, first), Math.max(1, Math.min(sheet.rowCount, end))];
}
