/** Writes a take as CSV (RFC 4180): the names of the columns, and a line a frame. */
import { shortest, tableColumns } from './table.ts';
import type { TakeArrays } from './take-arrays.ts';

/** Frames in a piece: some hundred kilobytes. */
const PIECE_ROWS = 64;

/**
 * The table of a take as CSV in pieces, to be written one after the other. Numbers are the shortest that read back the
 * same.
 */
export function* csvPieces(arrays: TakeArrays): Generator<string> {
  const columns = tableColumns(arrays).map((column) => ({ ...column, short: shortest(column.data) }));
  yield `${columns.map(({ name }) => cell(name)).join(',')}\n`;
  let text = '';
  for (let row = 0; row < arrays.frameCount; row++) {
    text += `${columns.map(({ data, first, step, short }) => short(data[first + row * step])).join(',')}\n`;
    if (row % PIECE_ROWS < PIECE_ROWS - 1) continue;
    yield text;
    text = '';
  }
  yield text;
}

/** In quotes where the text would end the cell. */
function cell(text: string): string {
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}
