/** Hit testing in the sheet, for points and boxes. Pure: the sheet's geometry and the take's keys, no canvas. */

import { keysBetween, nearestKeyTime } from '../../../edit/keys/row-keys.ts';
import type { ChannelKeys } from '../../../model/session.ts';
import type { Channel } from '../../../model/takes/take.ts';
import { secondsPerPixel, timeAt, timeX } from '../../widgets/time/time-window.ts';
import type { SelectionBox } from '../timeline/box.ts';
import type { DopeRow } from '../timeline/dope-rows.ts';
import { HEAD, rowAt, rowTop, type Sheet } from './sheet.ts';

/** What the sheet shows. */
export interface SheetKeys {
  readonly rows: readonly DopeRow[];
  /** Channels of the take. */
  readonly channels: readonly Channel[];
  /** Take time = transport time + this. */
  readonly offsetSeconds: number;
  /** First and last time of the selected keys, of the transport; absent if none is selected. */
  readonly selectedSpan?: readonly [number, number];
}

export type SheetHit =
  /** The selection's bar: its ends scale, the rest moves. */
  | { readonly kind: 'strip'; readonly part: 'start' | 'end' | 'body' }
  /** A diamond, and its keys. */
  | { readonly kind: 'keys'; readonly row: number; readonly timeSeconds: number; readonly keys: readonly ChannelKeys[] }
  | { readonly kind: 'row'; readonly row: number }
  | { readonly kind: 'nothing' };

/** Hit tolerance in pixels for diamonds, and for boxes that reach into a row. */
export const REACH = 6;
/** Width of the grips at each end of the strip's bar, outside and inside. */
export const GRIP = 7;
/** Closer times are the same frame, up to rounding. */
const SAME_SECONDS = 1e-6;

export function hitSheet(sheet: Sheet, shown: SheetKeys, x: number, y: number): SheetHit {
  if (y < 0 || y > sheet.height || x < 0 || x > sheet.width) return { kind: 'nothing' };
  if (y < HEAD) return hitStrip(sheet, shown, x);
  const row = rowAt(sheet, y);
  if (row === undefined) return { kind: 'nothing' };
  const timeSeconds = diamondNear(sheet, shown, row, x);
  if (timeSeconds === undefined) return { kind: 'row', row };
  return { kind: 'keys', row, timeSeconds, keys: keysUnder(sheet, shown, row, timeSeconds) };
}

/** The transport time of the key in a row nearest to x, if within reach. */
function diamondNear(sheet: Sheet, shown: SheetKeys, row: number, x: number): number | undefined {
  const at = timeAt(sheet, x) + shown.offsetSeconds;
  const time = nearestKeyTime(shown.channels, shown.rows[row].channels, at, REACH * secondsPerPixel(sheet));
  return time === undefined ? undefined : time - shown.offsetSeconds;
}

/** All keys of one diamond: the row's keys within one pixel, as drawn. */
function keysUnder(sheet: Sheet, shown: SheetKeys, row: number, timeSeconds: number): ChannelKeys[] {
  const pixel = secondsPerPixel(sheet);
  const left = sheet.window.from + Math.floor((timeSeconds - sheet.window.from) / pixel) * pixel;
  const same = Math.min(SAME_SECONDS, pixel / 4);
  const from = Math.min(left, timeSeconds - same) + shown.offsetSeconds;
  const to = Math.max(left + pixel * (1 - 1e-9), timeSeconds + same) + shown.offsetSeconds;
  return keysBetween(shown.channels, shown.rows[row].channels, from, to);
}

function hitStrip(sheet: Sheet, { selectedSpan }: SheetKeys, x: number): SheetHit {
  if (!selectedSpan) return { kind: 'nothing' };
  const start = timeX(sheet, selectedSpan[0]);
  const end = timeX(sheet, selectedSpan[1]);
  if (x < start - GRIP || x > end + GRIP) return { kind: 'nothing' };
  // Keys at a single time can only be moved.
  if (!(selectedSpan[1] > selectedSpan[0])) return { kind: 'strip', part: 'body' };
  // A short bar keeps a middle part for moving: its grips are outside.
  const inside = Math.min(GRIP, (end - start) / 4);
  if (x <= start + inside) return { kind: 'strip', part: 'start' };
  if (x >= end - inside) return { kind: 'strip', part: 'end' };
  return { kind: 'strip', part: 'body' };
}

/**
 * The keys whose diamonds are in a box: in every row that it touches, those between its left and right edge. The
 * summary covers rows scrolled below it, so a box that starts on it selects whole columns, and any other box ignores
 * it.
 *
 * @param box pixels; rows scrolled out of view are above or below the sheet
 */
export function sheetKeysInBox(sheet: Sheet, shown: SheetKeys, box: SelectionBox, onSummary: boolean): ChannelKeys[] {
  const from = timeAt(sheet, Math.min(box.x0, box.x1)) + shown.offsetSeconds;
  const to = timeAt(sheet, Math.max(box.x0, box.x1)) + shown.offsetSeconds;
  if (onSummary) return keysBetween(shown.channels, shown.rows[0]?.channels ?? [], from, to);
  const channels = new Set<number>();
  const [first, end] = rowsTouched(sheet, Math.min(box.y0, box.y1), Math.max(box.y0, box.y1));
  for (let row = first; row < end; row++) for (const channel of shown.rows[row].channels) channels.add(channel);
  const inOrder = [...channels].sort((a, b) => a - b);
  return keysBetween(shown.channels, inOrder, from, to);
}

/** First and end (exclusive) of the rows below the summary whose diamonds a vertical span touches. */
export function rowsTouched(sheet: Sheet, top: number, bottom: number): readonly [number, number] {
  const { rowHeight, rowCount } = sheet;
  const half = Math.min(REACH, rowHeight / 2);
  // A row's diamonds extend by `half` above and below its centre, rowTop + rowHeight / 2.
  const rowsDown = (y: number) => (y - rowTop(sheet, 1)) / rowHeight + 0.5;
  const first = Math.ceil(rowsDown(top - half));
  const end = Math.floor(rowsDown(bottom + half)) + 1;
  return [Math.max(1, Math.min(rowCount, first)), Math.max(1, Math.min(rowCount, end))];
}
