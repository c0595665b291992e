/** Numbers as programs print them: decimals, exponents, a float's f, and all spellings of NaN and infinity. */

const NUMBER = /^[-+\u2212]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eEdD][-+]?\d+)?[fFdDlL]?$/;
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
  // One word after the other: a list of those of a long line would take twenty times its bytes.
  const words = /[^\s,;()[\]{}<>|]+/g;
  for (let found = words.exec(text); found; found = words.exec(text)) {
    const value = numberOfWord(found[0]);
    if (value === undefined) return undefined;
    numbers.push(value);
  }
  return numbers;
}

/** The time that a heading or comment states: `time 1.5`, `time = 1.5 s`, `t=1.5`. */
export function timeIn(text: string): number | undefined {
  const found = /\b(?:time|t)\s*(?:is|at|[:=(,])?\s*([-+]?(?:\d+(?:\.\d*)?|\.\d+)(?:e[-+]?\d+)?)(?!\d)/i.exec(
    text.slice(0, MAX_HEADING),
  )?.[1];
  return found === undefined ? undefined : Number(found);
}

/** A run of CRs before an LF is part of one line end; any other CR is one. */
export function* linesOf(text: string): Generator<string, void, void> {
  for (let from = 0; from <= text.length; ) {
    const feed = text.indexOf('\n', from);
    const next = feed < 0 ? text.length : feed;
    let end = next;
    while (end > from && text[end - 1] === '\r') end--;
    const line = text.slice(from, end);
    if (line.includes('\r')) yield* line.split('\r');
    else yield line;
    from = next + 1;
  }
}
