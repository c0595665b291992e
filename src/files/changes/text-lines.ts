/** A text as lines, and lines as what they mean: numbers by value, words in any case, whatever the blanks between them. */

/** The lines of a text, without their ends. */
export interface TextLines {
  readonly lines: readonly string[];
  /** The end of each line; empty for the last one. */
  readonly ends: readonly string[];
}

/** Lines are those of `formats/places.ts`: a run of CRs followed by LF is one line end, any other CR is one each. */
export function splitLines(text: string): TextLines {
  const lines: string[] = [];
  const ends: string[] = [];
  let at = 0;
  for (const { 0: end, index } of text.matchAll(/\r*\n|\r/g)) {
    lines.push(text.slice(at, index));
    ends.push(end);
    at = index + end.length;
  }
  lines.push(text.slice(at));
  ends.push('');
  return { lines, ends };
}

/** The text that the lines were split from. */
export function joinLines({ lines, ends }: TextLines): string {
  return lines.map((line, i) => line + ends[i]).join('');
}

/** Words, numbers and braces. */
export function tokensOf(line: string): readonly string[] {
  return line.match(TOKEN) ?? [];
}

/** As all formats have them. */
export const TOKEN = /[^ \t\r\n{}]+|[{}]/g;
const NUMBER = /^[-+]?(?:\d+(?:\.\d*)?|\.\d+)(?:e[-+]?\d+)?$/i;

/** Equal for tokens that mean the same. */
export function meaningOf(token: string): string {
  if (!NUMBER.test(token)) return token.toLowerCase();
  const value = Number(token);
  return Object.is(value, -0) ? '-0' : String(value);
}

/** Equal for lines that mean the same; empty for one without tokens. A byte order mark means nothing. */
export function lineMeaning(line: string): string {
  return tokensOf(line.replace(/^\uFEFF/, ''))
    .map(meaningOf)
    .join(' ');
}

/** The words before its first number or brace: what a line sets. Empty for a row of numbers. */
export function headOf(meaning: string): string {
  return /^(?:(?![-+.\d{}])\S+ ?)*/.exec(meaning)?.[0].trim() ?? '';
}

/** Numbers that stand for lines, equal for equal ones. */
export class LineIds {
  private readonly ids = new Map<string, number>();

  /** A number for each line; equal lines have equal ones, in all calls. */
  of(lines: readonly string[]): Int32Array {
    return Int32Array.from(lines, (line) => {
      const known = this.ids.get(line);
      if (known !== undefined) return known;
      this.ids.set(line, this.ids.size);
      return this.ids.size - 1;
    });
  }
}
