/**
 * Reads lists of takes: the CSV and JSON that are written, those columns in any order and number in a table saved by a
 * spreadsheet, or plain paths, one a line. Only the path is needed.
 */

import { type Diagnostic, MAX_KEPT, moreThanKept } from '../model/diagnostic.ts';
import { cutMessage } from '../model/names/cut-text.ts';
import { MAX_STARS, NO_REVIEW, tagsOf, VERDICTS, type Verdict } from '../model/takes/review.ts';
import { eachRow, firstLineOf, lineEndsOf, separatorOf } from './csv.ts';
import { meant } from './formula-cells.ts';
import { LIST_COLUMNS, type ListColumn, type ListedTake } from './list.ts';

export interface ReadList {
  /** Each path once: the last row of it counts. */
  readonly takes: readonly ListedTake[];
  readonly diagnostics: readonly Diagnostic[];
}

/** @param file its name, for messages */
export function readList(text: string, file: string): ReadList {
  const content = text.replace(/^\ufeff/, '');
  const list = new List(file);
  if (/^\s*[[{]/.test(content)) readJson(content, list);
  else readLines(content, list);
  return list.finish();
}

/** Whether a text is a list with columns, rather than any other CSV or JSON. */
export function isTakeList(text: string): boolean {
  const content = text.replace(/^\ufeff/, '');
  if (/^\s*\[/.test(content)) return /^\s*\[\s*\{\s*"path"\s*:/.test(content);
  return columnsIn(firstLineOf(content)) !== undefined;
}

/** What was read so far, with up to 100 problems of each severity. */
class List {
  private readonly byPath = new Map<string, ListedTake>();
  private readonly diagnostics: Diagnostic[] = [];
  private warnings = 0;
  private errors = 0;

  constructor(private readonly file: string) {}

  add(take: ListedTake, line: number): void {
    const { path } = take;
    if (this.byPath.delete(path)) {
      this.warn('path-repeated', `"${path}" is listed twice.`, line, 'used the last row');
    }
    this.byPath.set(path, take);
  }

  warn(code: string, message: string, line: number, assumed: string): void {
    if (++this.warnings > MAX_KEPT) return;
    const { file } = this;
    const severity = 'warning';
    this.diagnostics.push({ severity, code, message: cutMessage(message), file, line, column: 0, assumed });
  }

  fail(code: string, message: string, line: number): void {
    if (++this.errors > MAX_KEPT) return;
    const { file } = this;
    this.diagnostics.push({ severity: 'error', code, message: cutMessage(message), file, line, column: 0 });
  }

  finish(): ReadList {
    if (this.byPath.size === 0 && this.errors === 0) this.fail('list-empty', 'The list has no paths.', 0);
    const { file, diagnostics, errors, warnings } = this;
    return {
      takes: errors > 0 ? [] : [...this.byPath.values()],
      diagnostics: [...diagnostics, ...moreThanKept('error', errors, file), ...moreThanKept('warning', warnings, file)],
    };
  }
}

/** What a cell or a member holds, still as found. */
type Found = Partial<Record<ListColumn, unknown>>;

function readLines(text: string, list: List): void {
  const columns = columnsIn(firstLineOf(text));
  if (!columns) {
    readPaths(text, list);
    return;
  }
  let isHeading = true;
  const unclosed = eachRow(text, separatorOf(text), ({ cells, line }) => {
    const found: Found = {};
    for (const [c, column] of columns) if (cells[c] !== undefined) found[column] = meant(cells[c]);
    if (!isHeading) addTake(found, line, list);
    isHeading = false;
  });
  if (unclosed === undefined) return;
  list.fail('quote-unclosed', 'Expected a closing quote, found the end of the file.', unclosed);
}

function readPaths(text: string, list: List): void {
  const endsAt = lineEndsOf(text);
  let from = 0;
  let line = 1;
  for (let i = 0; i <= text.length; i++) {
    const c = text[i];
    if (i < text.length && c !== '\n' && c !== '\r') continue;
    const path = text.slice(from, i).trim();
    if (path !== '') list.add({ path: slashed(path), ...NO_REVIEW }, line);
    from = i + 1;
    if (i < text.length && endsAt(i)) line++;
  }
}

/** By its index, what a cell of a heading is called, where it is a known column; undefined without a path. */
function columnsIn(heading: string): ReadonlyMap<number, ListColumn> | undefined {
  const columns = new Map<number, ListColumn>();
  eachRow(heading, separatorOf(heading), ({ cells }) => {
    cells.forEach((cell, c) => {
      const name = cell.trim().replaceAll('"', '').toLowerCase();
      const column = LIST_COLUMNS.find((each) => each === name);
      if (column) columns.set(c, column);
    });
  });
  return [...columns.values()].includes('path') ? columns : undefined;
}

function readJson(text: string, list: List): void {
  let parsed: unknown;
  try {
    parsed = JSON.parse(text);
  } catch (error) {
    list.fail('json-expected', `Expected JSON: ${error instanceof Error ? error.message : String(error)}.`, 0);
    return;
  }
  if (!Array.isArray(parsed)) {
    list.fail('list-expected', 'Expected an array of takes, found an object.', 0);
    return;
  }
  parsed.forEach((each: unknown, i) => {
    if (typeof each === 'string') addTake({ path: each }, 0, list);
    else if (typeof each === 'object' && each !== null) addTake(each, 0, list);
    else {
      list.fail(
        'take-expected',
        `Expected take ${i + 1} to be a path, or a record with one, found ${String(each)}.`,
        0,
      );
    }
  });
}

function addTake(found: Found, line: number, list: List): void {
  const path = typeof found.path === 'string' ? slashed(found.path.trim()) : '';
  if (path === '') {
    list.warn('path-expected', 'Expected a path, found none.', line, 'skipped');
    return;
  }
  const { notes } = found;
  const counts = (['frames', 'fps', 'seconds', 'joints', 'worst'] as const).flatMap((column) => {
    const value = numberOf(found[column]);
    return value === undefined ? [] : [[column, value] as const];
  });
  const words = (['unit', 'kind'] as const).flatMap((column) => {
    const value = found[column];
    return typeof value === 'string' && value.trim() !== '' ? [[column, value.trim()] as const] : [];
  });
  // An empty cell may be that of a take that was not checked.
  const flags = found.flags === undefined || found.flags === '' ? undefined : textsOf(found.flags);
  const take: ListedTake = {
    path,
    verdict: verdictOf(found.verdict, line, list),
    stars: starsOf(found.stars, line, list),
    tags: tagsIn(found.tags),
    notes: typeof notes === 'string' ? notes : '',
    ...Object.fromEntries([...counts, ...words]),
    ...(flags && { flags }),
  };
  list.add(take, line);
}

function verdictOf(found: unknown, line: number, list: List): Verdict {
  const text = typeof found === 'string' ? found.trim().toLowerCase() : '';
  const verdict = VERDICTS.find((each) => each === text);
  if (verdict === undefined && text !== '') {
    list.warn('verdict-unknown', `Expected "good", "bad" or nothing, found "${text}".`, line, 'used none');
  }
  return verdict ?? '';
}

function starsOf(found: unknown, line: number, list: List): number {
  const value = numberOf(found) ?? 0;
  if (Number.isInteger(value) && value >= 0 && value <= MAX_STARS) return value;
  list.warn('stars-expected', `Expected 0 to ${MAX_STARS} stars, found ${value}.`, line, 'used none');
  return 0;
}

function numberOf(found: unknown): number | undefined {
  // −0 is 0, as which it is written.
  if (typeof found === 'number') return Number.isFinite(found) ? found + 0 : undefined;
  if (typeof found !== 'string' || found.trim() === '') return undefined;
  // Spreadsheets of many countries write a decimal comma.
  const value = Number(found.trim().replace(',', '.'));
  return Number.isFinite(value) ? value + 0 : undefined;
}

function tagsIn(found: unknown): readonly string[] {
  const tags = tagsOf(typeof found === 'string' ? found : textsOf(found).join(';'));
  return tags.length > 0 ? tags : NO_REVIEW.tags;
}

/** Of an array, or a cell with semicolons. */
function textsOf(found: unknown): string[] {
  const texts = Array.isArray(found) ? found : typeof found === 'string' ? found.split(';') : [];
  return texts.flatMap((text) => (typeof text === 'string' && text.trim() !== '' ? [text.trim()] : []));
}

function slashed(path: string): string {
  return path.replaceAll('\\', '/');
}
