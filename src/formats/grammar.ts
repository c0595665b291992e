/** What the text formats have in common beyond tokens: counted blocks, single numbers, names, unknown keywords. */
import type { Place } from './places.ts';
import type { Keywords, NumberSink, Tokens } from './tokens.ts';

/** A part of a grammar: suspends when the bytes run out. */
export type GrammarPart<T> = Generator<void, T, void>;

/** `wasp.skin` → `wasp`: what a model is named after. */
export function stemOfName(fileName: string): string {
  const base = fileName.slice(Math.max(fileName.lastIndexOf('/'), fileName.lastIndexOf('\\')) + 1);
  const dot = base.lastIndexOf('.');
  return dot > 0 ? base.slice(0, dot) : base;
}

/** Whether the word at hand, found where a number belongs, is no try at one but something that comes after it. */
function isMissing(t: Tokens, keywords: Keywords): boolean {
  return t.kind !== 'word' || keywords.has(t.keyword()) || (t.startsLine && !looksNumeric(t));
}

/** Whether the word at hand is a number, or was meant to be one. */
export function looksNumeric(t: Tokens): boolean {
  return /^([+-]?(\d|\.|nan|inf)|[+-]$)/.test(t.keyword());
}

/**
 * One number. What is no number counts as 0 and is an error; where nothing stands that was meant to be one, the result
 * is undefined and the token is left for what comes next.
 */
export function* number(t: Tokens, what: string, keywords: Keywords): GrammarPart<number | undefined> {
  yield* t.next();
  const value = t.value();
  if (value - value === 0) return value;
  if (isMissing(t, keywords)) {
    t.error('number-expected', `Expected ${what}, found ${t.found()}.`);
    t.again();
    return undefined;
  }
  t.notANumber(what);
  return 0;
}

/** So many numbers in a row, 0 for those that are missing. */
export function* numbers(
  t: Tokens,
  count: number,
  what: (i: number) => string,
  keywords: Keywords,
): GrammarPart<number[]> {
  const all = new Array<number>(count).fill(0);
  for (let i = 0; i < count; i++) {
    const value = yield* number(t, what(i), keywords);
    if (value === undefined) break;
    all[i] = value;
  }
  return all;
}

/** Numbers as long as there are any; at most `kept` of them are kept, but all counted. */
export function* numberRun(
  t: Tokens,
  kept: number,
  what: string,
  keywords: Keywords,
): GrammarPart<{ all: number[]; found: number }> {
  const all: number[] = [];
  let found = 0;
  for (;;) {
    yield* t.next();
    let value = t.value();
    if (value - value !== 0) {
      if (isMissing(t, keywords)) {
        t.again();
        return { all, found };
      }
      t.notANumber(what);
      value = 0;
    }
    if (found++ < kept) all.push(value);
  }
}

/** `N {`. A count is a hint only: whatever it is, what is there is used. Undefined when there is no usable count. */
export function* countAndBrace(t: Tokens, what: string, keywords: Keywords): GrammarPart<number | undefined> {
  let count = yield* number(t, `the number of ${what}`, keywords);
  if (count !== undefined && count % 1 !== 0) {
    t.error('count-fractional', `Expected a whole number of ${what}, found ${t.found()}.`);
    count = undefined;
  }
  yield* openBrace(t, `the number of ${what}`);
  return count;
}

/** A `{`; without one, goes on as if it were there. */
export function* openBrace(t: Tokens, after: string): GrammarPart<void> {
  if ((yield* t.next()) === '{') return;
  t.error('brace-missing', `Expected "{" after ${after}, found ${t.found()}.`);
  t.again();
}

/** The `}` of a block is at hand: does what was declared agree with what was found? */
export function checkCount(t: Tokens, what: string, declared: number | undefined, found: number): void {
  if (declared === undefined || declared === found) return;
  t.warn('count-mismatch', `Expected ${declared} ${what} as declared, found ${found}.`, `used ${found}`);
}

/** The token at hand is nothing that belongs into `where`: one warning for equal ones, and on behind it. */
export function* skipStrange(t: Tokens, where: string, expected: string): GrammarPart<void> {
  const message = () => `Expected ${expected} in ${where}, found ${t.found()}.`;
  if (t.kind === '{') {
    t.warn('brace-unexpected', message(), 'skipped to its "}"');
    yield* t.skipBlock();
    return;
  }
  if (Number.isNaN(t.value())) t.warnOnce('keyword-unknown', t.keyword() || t.found(), message, 'skipped');
  else t.warnOnce('number-unexpected', '', message, 'skipped');
  yield* t.skipUnknown();
}

/** A `}` is at hand that closes nothing. */
export function braceTooMany(t: Tokens): void {
  t.warn('brace-unexpected', 'Unmatched "}": every block is already closed.', 'ignored');
}

/** `what` comes a second time: the later one is used. */
export function warnRepeated(t: Tokens, what: string): void {
  t.warn('repeated', `${what} appears a second time.`, 'the later one is used');
}

/**
 * How long to make an array of `length` that needs room for `needed`, when `expected` are said to come. A count is a
 * hint: it is followed up to 16 times what is there already, or 4 times where that is large. Without one it doubles.
 */
export function nextLength(length: number, needed: number, expected: number): number {
  const trusted = length < LARGE ? 16 * length : 4 * length;
  if (expected >= needed && expected <= trusted) return Math.ceil(expected);
  return Math.max(needed, expected > trusted ? 4 * length : 2 * length);
}

/** 8 MB of doubles. */
const LARGE = 1 << 20;
/** What a list begins with at most, 32 kB: a file of thousands of blocks must not take room for a whole file in each. */
const MAX_AT_FIRST = 1 << 12;

/** A growing list of numbers, read straight into place: `positions` and its kin. */
export class NumberList implements NumberSink {
  values: Float64Array;
  count = 0;
  readonly usesUp = false;

  /** `expected`: how many are declared, if any; allocated at once only as far as the bytes at hand could fill it. */
  constructor(
    t: Tokens,
    private readonly expected: number | undefined,
  ) {
    const wanted = expected !== undefined && expected > 0 ? expected : 256;
    const first = Math.min(t.numbersAtHand(), wanted, MAX_AT_FIRST);
    this.values = new Float64Array(Math.max(16, Math.ceil(first)));
  }

  flush(): void {
    const grown = new Float64Array(nextLength(this.values.length, this.values.length + 1, this.expected ?? 0));
    grown.set(this.values);
    this.values = grown;
  }

  /** What was read, and nothing behind it. */
  all(): Float64Array {
    return this.count === this.values.length ? this.values : this.values.slice(0, this.count);
  }
}

/** `N { x y z … }`: rows of so many numbers. The keyword is at hand. */
export function* rows(t: Tokens, what: string, width: number, keywords: Keywords): GrammarPart<Float64Array> {
  const declared = yield* countAndBrace(t, what, keywords);
  const sink = new NumberList(t, declared === undefined ? undefined : declared * width);
  yield* t.numbers(sink, what, keywords);
  checkRows(t, what, width, declared, sink.count);
  return sink.all();
}

/** The end of a block of rows is at hand. */
export function checkRows(t: Tokens, what: string, width: number, declared: number | undefined, found: number): void {
  if (t.kind !== '}') return;
  if (found % width !== 0) {
    const message = `Expected ${width} numbers per row of ${what}, found ${found % width} in the last row.`;
    t.error('row-incomplete', message);
  } else checkCount(t, what, declared, found / width);
}

/** Wrong indices of a block: the first one is told, the rest counted. */
export class WrongIndices {
  private first: { code: string; message: string; place: Place } | undefined;
  private count = 0;

  /** `what`: "the index of a vertex"; `bound`: how many there are, Infinity where that is not known. */
  constructor(
    private readonly what: string,
    private readonly bound: () => string,
  ) {}

  /** In a sink's `flush`: number `slot` is no index. (A closure for the place would cost a loop its speed.) */
  addSlot(index: number, t: Tokens, slot: number): void {
    if (this.count++ === 0) this.note(index, t.placeOfSlot(slot));
  }

  add(index: number, place: Place): void {
    if (this.count++ === 0) this.note(index, place);
  }

  private note(index: number, place: Place): void {
    const isFractional = index % 1 !== 0;
    const expected = isFractional ? `a whole number for ${this.what}` : `${this.what}${this.bound()}`;
    this.first = {
      code: isFractional ? 'index-fractional' : 'index-out-of-range',
      message: `Expected ${expected}, found ${index}`,
      place,
    };
  }

  /** Tells what was found, with `more` that were only counted. */
  tell(t: Tokens, more = 0): void {
    const { first } = this;
    if (first) t.report.error(first.code, `${first.message}${andMore(this.count - 1 + more)}.`, first.place);
  }
}

export function andMore(count: number): string {
  return count > 0 ? ` (and ${count} more like it)` : '';
}

/** 2^32: a larger index can't be held, and no file has as many vertices. */
export const MAX_COUNT = 4294967296;
