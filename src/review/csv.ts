/** Reads comma-separated values (RFC 4180), with any of the separators that spreadsheets write. */

export interface CsvRow {
  /** From 1; where the row starts, since quoted cells may contain line ends. */
  readonly line: number;
  readonly cells: readonly string[];
}

export interface Csv {
  readonly rows: readonly CsvRow[];
  /** The line of a quote that nothing closes. */
  readonly unclosed?: number;
}

/** Comma, semicolon or tab: the one that the first line has most of. */
export function separatorOf(text: string): string {
  const [line] = text.split(/\r|\n/, 1);
  const counts = [',', ';', '\t'].map((separator) => ({ separator, count: line.split(separator).length }));
  return counts.reduce((a, b) => (b.count > a.count ? b : a)).separator;
}

/** Empty lines are left out. */
export function readCsv(text: string, separator: string): Csv {
  const rows: CsvRow[] = [];
  let cells: string[] = [];
  let cell = '';
  let line = 1;
  let start = 1;
  let isQuoted = false;
  let opened = 0;
  const endRow = () => {
    cells.push(cell);
    if (cells.length > 1 || cells[0].trim() !== '') rows.push({ line: start, cells });
    cells = [];
    cell = '';
  };
  for (let i = 0; i < text.length; i++) {
    const c = text[i];
    const endsLine = c === '\n' || (c === '\r' && text[i + 1] !== '\n');
    if (isQuoted) {
      if (c !== '"') cell += c;
      else if (text[i + 1] === '"') cell += text[i++];
      else isQuoted = false;
    } else if (c === '"' && cell === '') {
      isQuoted = true;
      opened = line;
    } else if (c === separator) {
      cells.push(cell);
      cell = '';
    } else if (endsLine) endRow();
    else if (c !== '\r') cell += c;
    if (endsLine) line++;
    if (endsLine && !isQuoted) start = line;
  }
  if (cell !== '' || cells.length > 0) endRow();
  return { rows, ...(isQuoted && { unclosed: opened }) };
}
