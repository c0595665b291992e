/** Lists of takes as CSV (RFC 4180) and JSON. */
import { harmless, quoted } from './formula-cells.ts';
import { LIST_COLUMNS, type ListColumn, type ListedTake } from './list.ts';

/** Between tags, and between flags, of one cell. */
const BETWEEN = '; ';

/** A heading and a row a take; lines end with `\r\n`. */
export function listAsCsv(takes: readonly ListedTake[]): string {
  const rows = takes.map((take) => LIST_COLUMNS.map((column) => quoted(cellOf(take, column))).join(','));
  return [LIST_COLUMNS.join(','), ...rows].map((line) => `${line}\r\n`).join('');
}

/** An array of records with the columns of the CSV; tags and flags are arrays. */
export function listAsJson(takes: readonly ListedTake[]): string {
  const records = takes.map((take) => Object.fromEntries(LIST_COLUMNS.map((column) => [column, take[column]])));
  return `[\n${records.map((record) => JSON.stringify(record)).join(',\n')}\n]\n`;
}

function cellOf(take: ListedTake, column: ListColumn): string {
  const value = take[column];
  if (value === undefined) return '';
  if (typeof value === 'number') return column === 'stars' && value === 0 ? '' : String(value);
  // A joint may have a semicolon in its name, and so a flag: it stays one flag.
  return harmless(typeof value === 'string' ? value : value.map((text) => text.replaceAll(';', ',')).join(BETWEEN));
}
