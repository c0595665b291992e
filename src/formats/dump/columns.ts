/** Tables: what the columns are that a header names. */
import type { DumpLabel } from '../../model/dump.ts';
import { labelWith } from './labels.ts';
import { numberOfWord, numbersIn, timeIn } from './numbers.ts';
import { isLabelColumn, isPlainColumn, isTimeColumn } from './vocabulary.ts';

/** `skip`: counts rows beside their times. */
type Role = 'time' | 'index' | 'name' | 'value' | 'skip';

/** How the lines of a table are split, and what each of its columns holds. */
export interface Table {
  readonly delimiter: RegExp;
  /** Role of each field of a line. */
  readonly roles: readonly Role[];
}

/** A line that names columns, or may. */
export interface Header {
  readonly names: readonly string[];
  readonly delimiter: RegExp;
}

/** By commas and the like, else by blanks. */
export function headerOf(text: string): Header {
  const delimiter = DELIMITED.test(text) ? /[,;\t|]\s*/ : /\s+/;
  return { names: namesIn(text, delimiter), delimiter };
}

/**
 * Whether a line is a header whatever else is in it, blanks and digits, too: between commas, each cell has a word and
 * no fraction, and one is the name of a column.
 */
export function hasNamesInCells(text: string): boolean {
  if (text.length > MAX_HEADER_LENGTH || !DELIMITED.test(text)) return false;
  const { names } = headerOf(text);
  return names.some(isPlainColumn) && names.every(isNameInCell);
}

function isNameInCell(name: string): boolean {
  return !numbersIn(name) && !FRACTION.test(name) && timeIn(name) === undefined;
}

const DELIMITED = /[,;\t|]/;
const FRACTION = /(?<![\w.])[-+]?\d*\.\d/;
/** Length of hundreds of columns with long names. */
const MAX_HEADER_LENGTH = 1 << 16;

/** The fields of a header in lower case, without units behind them and quotes around them. */
function namesIn(text: string, delimiter: RegExp): readonly string[] {
  return text
    .replace(/^[#%/\s|]+/, '')
    .split(delimiter)
    .map((name) =>
      name
        .trim()
        .toLowerCase()
        .replace(/^["']|["']$/g, '')
        .replace(/[([][a-z]*[\])]$/, '')
        .trimEnd(),
    )
    .filter((name) => name !== '');
}

/**
 * The roles of the columns by their names in lower case: the first time, the first index, and names of joints. Other
 * columns that count rows are skipped; all others are values.
 */
export function tableOf(names: readonly string[], delimiter: RegExp): Table {
  const timeAt = names.findIndex(isTimeColumn);
  const indexAt = names.findIndex((name) => name !== 'name' && isLabelColumn(name));
  const roles = names.map((name, i): Role => {
    if (i === timeAt) return 'time';
    if (timeAt >= 0 && (isTimeColumn(name) || /^(frame|index|idx|id|i|#)$/.test(name))) return 'skip';
    if (name === 'name') return 'name';
    return i === indexAt ? 'index' : isLabelColumn(name) ? 'skip' : 'value';
  });
  return { delimiter, roles };
}

/** Items of the columns that hold values: the time first. @param list an item per column */
export function valuesOf<T>({ roles }: Table, list: readonly T[]): T[] {
  const times = list.filter((_, i) => roles[i] === 'time');
  return [...times, ...list.filter((_, i) => roles[i] === 'value')];
}

/** Names of the numbers of a row. */
export function columnsOf(table: Table, names: readonly string[]): readonly string[] {
  return valuesOf(
    table,
    names.map((name) => (isTimeColumn(name) ? 'time' : name)),
  );
}

/** A column of joints has names or indices. @param fields of a line */
export function labelOfFields({ roles }: Table, fields: readonly string[]): DumpLabel | null {
  const [indexAt, nameAt] = [roles.indexOf('index'), roles.indexOf('name')];
  const index = indexAt >= 0 ? numberOfWord(fields[indexAt] ?? '') : undefined;
  const own = index === undefined && indexAt >= 0 ? fields[indexAt] : undefined;
  return labelWith(index, nameAt >= 0 ? fields[nameAt] : own);
}
