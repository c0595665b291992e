/** Numbers as programs print them: decimals, exponents, a float's f, and all spellings of NaN and infinity. */

const NUMBER = /^[-+\u2212]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][-+]?\d+)?[fFdDlL]?$/;
/** Longer words are no numbers; without a bound, the expressions here take time that grows with its square. */
const MAX_LENGTH = 64;
/** Headings are shorter. */
const MAX_HEADING = 200;
const NOT_FINITE = /^[-+]?(?:nan(?:\([a-z0-9]*\))?|inf|infinity|\d\.#(?:inf|ind|qnan|snan)\w*)$/i;

/** The number that a word is; undefined if it is none. */
export function numberOfWord(word: string): number | undefined {
  if (word.length > MAX_LENGTH) return undefined;
  if (NUMBER.test(word)) {
    const plain = Number(word);
    if (!Number.isNaN(plain)) return plain;
    return Number(
      word
        .replace('\u2212', '-')
        .replace(/[fFlL]$|[dD]$/, '')
        .replace(/[dD]/, 'e'),
    );
  }
  if (!NOT_FINITE.test(word)) return undefined;
  if (!/inf/i.test(word)) return Number.NaN;
  return word.startsWith('-') ? Number.NEGATIVE_INFINITY : Number.POSITIVE_INFINITY;
}

/** All numbers of a text without any other words; undefined if there are others. */
export function numbersIn(text: string): number[] | undefined {
  const numbers: number[] = [];
  for (const word of text.split(/[\s,;()[\]{}<>|]+/)) {
    if (word === '') continue;
    const value = numberOfWord(word);
    if (value === undefined) return undefined;
    numbers.push(value);
  }
  return numbers;
}

/** The time that a heading or comment states: `time 1.5`, `time = 1.5 s`, `t=1.5`. */
export function timeIn(text: string): number | undefined {
  const found = /\b(?:time|t)\s*(?:is|at|[:=(,])?\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)(?!\d)/i.exec(
    text.slice(0, MAX_HEADING),
  )?.[1];
  return found === undefined ? undefined : Number(found);
}

/** A run of CRs before an LF is part of one line end; any other CR is one. */
export function linesOf(text: string): string[] {
  return text.split('\n').flatMap((part) => {
    let end = part.length;
    while (end > 0 && part[end - 1] === '\r') end--;
    return part.slice(0, end).split('\r');
  });
}
