/** Reads comma-separated values (RFC 4180), with any of the separators that spreadsheets write. */

export interface CsvRow {
  /** From 1; where the row starts, since quoted cells may contain line ends. */
  readonly line: number;
  /** Up to 16,384 of them, as many as spreadsheets have. */
  readonly cells: readonly string[];
}

const MAX_CELLS = 16_384;
/** Put together at a time: a cell with many quotes would take 16 times its length. */
const MAX_PARTS = 1024;

/** Comma, semicolon or tab: the one that the first line has most of. */
export function separatorOf(text: string): string {
  const line = firstLineOf(text);
  const counts = [',', ';', '\t'].map((separator) => ({ separator, count: countOf(line, separator) }));
  return counts.reduce((a, b) => (b.count > a.count ? b : a)).separator;
}

/** Up to the first line end. */
export function firstLineOf(text: string): string {
  const end = text.search(/\r|\n/);
  return end < 0 ? text : text.slice(0, end);
}

function countOf(text: string, part: string): number {
  let count = 0;
  for (let at = text.indexOf(part); at >= 0; at = text.indexOf(part, at + 1)) count++;
  return count;
}

/**
 * Tells of the CRs and LFs of a text whether a line ends with them; to be asked from its beginning on. A run of CRs
 * before an LF is part of one line end; any other CR is one.
 */
export function lineEndsOf(text: string): (at: number) => boolean {
  /** Up to which a run of CRs was looked at. */
  let run = 0;
  return (at) => {
    if (text[at] === '\n') return true;
    if (at >= run) for (run = at + 1; text[run] === '\r'; ) run++;
    return text[run] !== '\n';
  };
}

/**
 * Gives all rows, one after the other, to `take`. Empty lines are left out.
 * @returns the line of a quote that nothing closes, whose row is left out; undefined if there is none
 */
export function eachRow(text: string, separator: string, take: (row: CsvRow) => void): number | undefined {
  const endsAt = lineEndsOf(text);
  let cells: string[] = [];
  let cell = '';
  /** What of the text is not yet in the cell: character by character, a cell would take 32 times its length. */
  let from = 0;
  /** Of a quoted cell, up to its quotes. */
  const parts: string[] = [];
  let line = 1;
  let start = 1;
  let isQuoted = false;
  let opened = 0;
  const endCell = () => {
    if (cells.length < MAX_CELLS) cells.push(cell);
    cell = '';
  };
  const endRow = () => {
    endCell();
    if (cells.length > 1 || cells[0].trim() !== '') take({ line: start, cells });
    cells = [];
  };
  for (let i = 0; i < text.length; i++) {
    const c = text[i];
    const endsLine = (c === '\n' || c === '\r') && endsAt(i);
    if (isQuoted) {
      if (c === '"') {
        isQuoted = text[i + 1] === '"';
        // Of two quotes the first is the cell's.
        parts.push(text.slice(from, isQuoted ? ++i : i));
        from = i + 1;
        if (!isQuoted || parts.length === MAX_PARTS) cell += parts.splice(0).join('');
      }
    } else if (c === '"' && cell === '' && from === i) {
      isQuoted = true;
      opened = line;
      from = i + 1;
    } else if (c === separator || c === '\n' || c === '\r') {
      cell += text.slice(from, i);
      from = i + 1;
      if (c === separator) endCell();
      else if (endsLine) endRow();
    }
    if (endsLine) line++;
    if (endsLine && !isQuoted) start = line;
  }
  if (isQuoted) return opened;
  cell += text.slice(from);
  if (cell !== '' || cells.length > 0) endRow();
  return undefined;
}
