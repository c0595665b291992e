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

/** Empty lines are left out. A run of CRs before an LF is part of one line end; any other CR is one. */
export function readCsv(text: string, separator: string): Csv {
  const rows: CsvRow[] = [];
  let cells: string[] = [];
  let cell = '';
  /** What of the text is not yet in the cell: character by character, a cell would take 32 times its length. */
  let from = 0;
  /** Up to which a run of CRs was looked at. */
  let run = 0;
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
    if (c === '\r' && i >= run) for (run = i + 1; text[run] === '\r'; ) run++;
    const endsLine = c === '\n' || (c === '\r' && text[run] !== '\n');
    if (isQuoted) {
      if (c === '"') {
        cell += text.slice(from, i);
        from = i + 1;
        // Of two quotes the second is the cell's.
        if (text[from] === '"') i++;
        else isQuoted = false;
      }
    } else if (c === '"' && cell === '' && from === i) {
      isQuoted = true;
      opened = line;
      from = i + 1;
    } else if (c === separator || c === '\n' || c === '\r') {
      cell += text.slice(from, i);
      from = i + 1;
      if (c === separator) {
        cells.push(cell);
        cell = '';
      } else if (endsLine) endRow();
    }
    if (endsLine) line++;
    if (endsLine && !isQuoted) start = line;
  }
  cell += text.slice(from);
  if (cell !== '' || cells.length > 0) endRow();
  return { rows, ...(isQuoted && { unclosed: opened }) };
}
