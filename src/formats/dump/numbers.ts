/** Numbers as programs print them: decimals, exponents, a float's f, and all spellings of NaN and infinity. */

const NUMBER = /^[-+\u2212]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eEdD][-+]?\d+)?[fFdDlL]?$/;
/** Longer words are not numbers; without a bound, the expressions here take time that grows with its square. */
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

/**
 * The time that a heading or comment states, in seconds: `time 1.5`, `time = 1.5 s`, `t=1.5`, `Time (s): 1.5`,
 * `time 1500 ms`, `at 1.5 s`. Not how long something took, nor the time of a day.
 */
export function timeIn(text: string): number | undefined {
  const heading = text.slice(0, MAX_HEADING);
  if (NO_TIME.test(heading)) return undefined;
  const found = TIME.exec(heading) ?? SECONDS.exec(heading);
  if (!found) return undefined;
  const [, number, unit] = found;
  return unit ? Number(number) / 1000 : Number(number);
}

const NO_TIME =
  /\b(?:frame|delta|elapsed|total|step|cpu|gpu|run|build|compile|render|load)[ _]?time|\belapsed\b|\btook\b/i;
const TIME =
  /\b(?:(?:current|cur|anim(?:ation)?|sim(?:ulation)?|sample|key|pose)[ _]?)?(?:time|t)(?:_?s(?:ec(?:onds?)?)?)?\s*(?:[([]\s*s(?:ec(?:onds?)?)?\s*[)\]]\s*)?(?:(?:is|at|of|->|=>|[:=(,|])\s*){0,2}([-+]?(?:\d+(?:\.\d*)?|\.\d+)(?:e[-+]?\d+)?)(?!\d|:\d\d|-\d)\s*(ms\b|milliseconds?\b)?/i;
/** A number of seconds without a word for it. */
const SECONDS = /(?:^\W*|@\s*|\bat\s+)([-+]?(?:\d+(?:\.\d*)?|\.\d+))\s*(?:s|secs?|seconds?)(?:\W*$|\b)/i;

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
