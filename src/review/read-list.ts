/**
 * Reads lists of takes: the CSV and JSON that are written, those columns in any order and number in a table saved by a
 * spreadsheet, or plain paths, one a line. Only the path is needed.
 */
import { cutMessage } from '../model/cut-text.ts';
import type { Diagnostic } from '../model/diagnostic.ts';
import { MOST_STARS, NO_REVIEW, tagsOf, VERDICTS, type Verdict } from '../model/review.ts';
import { readCsv, separatorOf } from './csv.ts';
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
  const report = new Report(file);
  const takes = /^\s*[[{]/.test(content) ? fromJson(content, report) : fromLines(content, report);
  const byPath = new Map<string, ListedTake>();
  for (const take of takes) {
    if (byPath.has(take.path)) {
      report.warn('path-repeated', `"${take.path}" is listed twice.`, 0, 'used the last row');
      byPath.delete(take.path);
    }
    byPath.set(take.path, take);
  }
  if (byPath.size === 0 && !report.hasErrors) report.fail('list-empty', 'The list has no paths.', 0);
  return { takes: report.hasErrors ? [] : [...byPath.values()], diagnostics: report.diagnostics };
}

/** Whether a text is a list with columns, rather than any other CSV or JSON. */
export function isTakeList(text: string): boolean {
  const content = text.replace(/^\ufeff/, '');
  if (/^\s*\[/.test(content)) return /^\s*\[\s*\{\s*"path"\s*:/.test(content);
  const [line] = content.split(/\r|\n/, 1);
  return columnsIn(line.split(separatorOf(line))) !== undefined;
}

class Report {
  readonly diagnostics: Diagnostic[] = [];
  hasErrors = false;

  constructor(private readonly file: string) {}

  warn(code: string, message: string, line: number, assumed: string): void {
    this.diagnostics.push({
      severity: 'warning',
      code,
      message: cutMessage(message),
      file: this.file,
      line,
      column: 0,
      assumed,
    });
  }

  fail(code: string, message: string, line: number): void {
    this.hasErrors = true;
    this.diagnostics.push({ severity: 'error', code, message: cutMessage(message), file: this.file, line, column: 0 });
  }
}

/** What a cell or a member holds, still as found. */
type Found = Partial<Record<ListColumn, unknown>>;

function fromLines(text: string, report: Report): ListedTake[] {
  const separator = separatorOf(text);
  const [heading] = text.split(/\r|\n/, 1);
  const columns = columnsIn(readCsv(heading, separator).rows[0]?.cells ?? []);
  if (!columns) return plainPaths(text);
  const { rows, unclosed } = readCsv(text, separator);
  if (unclosed !== undefined) {
    report.fail('quote-unclosed', 'Expected a closing quote, found the end of the file.', unclosed);
    return [];
  }
  return rows.slice(1).flatMap(({ cells, line }) => {
    const found: Found = {};
    columns.forEach((column, c) => {
      if (column && cells[c] !== undefined) found[column] = meant(cells[c]);
    });
    return takeOf(found, line, report);
  });
}

function plainPaths(text: string): ListedTake[] {
  const lines = text.split(/\r\n|\r|\n/).map((line) => line.trim());
  return lines.filter((line) => line !== '').map((path) => ({ path: slashed(path), ...NO_REVIEW }));
}

/** Of each cell of a heading, its column; undefined without a path. */
function columnsIn(cells: readonly string[]): (ListColumn | undefined)[] | undefined {
  const columns = cells.map((cell) => {
    const name = cell.trim().replaceAll('"', '').toLowerCase();
    return LIST_COLUMNS.find((column) => column === name);
  });
  return columns.includes('path') ? columns : undefined;
}

function fromJson(text: string, report: Report): ListedTake[] {
  let parsed: unknown;
  try {
    parsed = JSON.parse(text);
  } catch (error) {
    report.fail('json-expected', `Expected JSON: ${error instanceof Error ? error.message : String(error)}.`, 0);
    return [];
  }
  if (!Array.isArray(parsed)) {
    report.fail('list-expected', 'Expected an array of takes, found an object.', 0);
    return [];
  }
  return parsed.flatMap((each: unknown, i) => {
    if (typeof each === 'string') return takeOf({ path: each }, 0, report);
    if (typeof each === 'object' && each !== null) return takeOf(each, 0, report);
    report.fail('take-expected', `Expected a path or a record with one as take ${i + 1}, found ${String(each)}.`, 0);
    return [];
  });
}

function takeOf(found: Found, line: number, report: Report): ListedTake[] {
  const path = typeof found.path === 'string' ? slashed(found.path.trim()) : '';
  if (path === '') {
    report.warn('path-expected', 'Expected a path, found none.', line, 'skipped');
    return [];
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
  return [
    {
      path,
      verdict: verdictOf(found.verdict, line, report),
      stars: starsOf(found.stars, line, report),
      tags: tagsOf(textsOf(found.tags).join(';')),
      notes: typeof notes === 'string' ? notes : '',
      ...Object.fromEntries([...counts, ...words]),
      ...(flags && { flags }),
    },
  ];
}

function verdictOf(found: unknown, line: number, report: Report): Verdict {
  const text = typeof found === 'string' ? found.trim().toLowerCase() : '';
  const verdict = VERDICTS.find((each) => each === text);
  if (verdict === undefined && text !== '') {
    report.warn('verdict-unknown', `Expected "good", "bad" or nothing, found "${text}".`, line, 'used none');
  }
  return verdict ?? '';
}

function starsOf(found: unknown, line: number, report: Report): number {
  const value = numberOf(found) ?? 0;
  if (Number.isInteger(value) && value >= 0 && value <= MOST_STARS) return value;
  report.warn('stars-expected', `Expected 0 to ${MOST_STARS} stars, found ${value}.`, line, 'used none');
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

/** Of an array, or a cell with semicolons. */
function textsOf(found: unknown): string[] {
  const texts = Array.isArray(found) ? found : typeof found === 'string' ? found.split(';') : [];
  return texts.flatMap((text) => (typeof text === 'string' && text.trim() !== '' ? [text.trim()] : []));
}

function slashed(path: string): string {
  return path.replaceAll('\\', '/');
}
