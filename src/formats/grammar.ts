/** Grammar that text formats share beyond tokens: counted blocks, single numbers, names, unknown keywords. */
import type { Severity } from '../model/diagnostic.ts';
import type { Place } from './places.ts';
import type { Keywords, Mark, NumberSink, Tokens } from './tokens.ts';
import { shortName } from './words.ts';

/** Part of a grammar; suspends when the bytes run out. */
export type GrammarPart<T> = Generator<void, T, void>;

/** `wasp.skin` → `wasp`: the name of a model. */
export function stemOfName(fileName: string): string {
  const base = fileName.slice(Math.max(fileName.lastIndexOf('/'), fileName.lastIndexOf('\\')) + 1);
  const dot = base.lastIndexOf('.');
  return dot > 0 ? base.slice(0, dot) : base;
}

/** Whether the current word, where a number is expected, is not a misspelt number but what comes after it. */
function isMissing(t: Tokens, keywords: Keywords): boolean {
  return t.kind !== 'word' || keywords.has(t.keyword()) || (t.startsLine && !looksNumeric(t));
}

/** Whether the current word is a number, or meant as one. */
export function looksNumeric(t: Tokens): boolean {
  return /^([+-]?(\d|\.|nan|inf)|[+-]$)/.test(t.keyword());
}

/**
 * One number. An invalid number is an error and counts as 0; if there is nothing meant as a number, the result is
 * undefined and the token is left for what follows.
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

/** A fixed number of numbers; missing ones are 0. */
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

/** As many numbers as there are; all are counted, but at most `kept` are stored. */
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

/** A count as written, only a hint: the actual content is used. */
export interface Declared {
  /** Undefined if there is no usable one, which is an error. */
  readonly count: number | undefined;
  readonly place: Mark;
}

/** The number that was just read, if any, as the number of `what`, which must be whole. */
export function declaredCount(t: Tokens, what: string, count: number | undefined): Declared {
  const place = t.mark();
  if (count === undefined || count % 1 === 0) return { count, place };
  t.error('count-fractional', `Expected a whole number of ${what}, found ${t.found()}.`);
  return { count: undefined, place };
}

/** `N {`; names on its line are skipped. */
export function* countAndBrace(t: Tokens, what: string, keywords: Keywords): GrammarPart<Declared> {
  yield* headExtras(t, what, undefined, keywords);
  const declared = declaredCount(t, what, yield* number(t, `the number of ${what}`, keywords));
  yield* headExtras(t, what, undefined, keywords);
  yield* openBrace(t, `the number of ${what}`);
  return declared;
}

/**
 * `[INDEX] "{"` of a block that has neither a count nor a name. Programs number and name their blocks all the same:
 * blocks count in the order of the file, whatever their numbers.
 *
 * @param index among the blocks of this keyword, from 0
 */
export function* blockHead(t: Tokens, keyword: string, index: number, keywords: Keywords): GrammarPart<void> {
  yield* headExtras(t, keyword, index, keywords);
  yield* openBrace(t, keyword);
}

/** `[NAME] "{"`, with or without an index before or after the name; '' without a name. */
export function* namedHead(t: Tokens, keyword: string, index: number, keywords: Keywords): GrammarPart<string> {
  if ((yield* t.next()) !== 'word') {
    t.again();
    yield* openBrace(t, keyword);
    return '';
  }
  let name = t.text();
  let number = t.value();
  const place = t.mark();
  yield* t.next();
  // A number alone is the name.
  if (Number.isFinite(number) && isOfHead(t, keywords)) {
    tellIndex(t, keyword, index, number, place);
    name = t.text();
    number = t.value();
  } else t.again();
  t.forget(place);
  yield* headExtras(t, keyword, index, keywords);
  yield* openBrace(t, `the name ${shortName(name)}`);
  return name;
}

/** Whether the current token is a word between the keyword of a block and its brace. */
function isOfHead(t: Tokens, keywords: Keywords): boolean {
  return t.kind === 'word' && !t.startsLine && !keywords.has(t.keyword());
}

/**
 * Tokens that the line of a block's keyword has before the brace though nothing is expected there: an index, and names,
 * which are skipped with one warning for all such blocks. A second number is what is in the block, and its brace is
 * missing.
 *
 * @param index undefined if the block has a count, so that no number is an index
 */
function* headExtras(t: Tokens, keyword: string, index: number | undefined, keywords: Keywords): GrammarPart<void> {
  let isNumbered = index === undefined;
  for (;;) {
    yield* t.next();
    if (!isOfHead(t, keywords)) break;
    const value = t.value();
    if (isNumbered && (value - value === 0 || looksNumeric(t))) break;
    if (index !== undefined && value - value === 0) {
      isNumbered = true;
      tellIndex(t, keyword, index, value);
    } else {
      const message = () => `Expected "{" after ${keyword}, found ${t.found()}.`;
      t.warnOnce('name-unexpected', keyword, message, 'skipped');
    }
  }
  t.again();
}

/** Reports a block's number, which is the current token unless it has a mark. */
function tellIndex(t: Tokens, keyword: string, index: number, found: number, mark?: Mark): void {
  if (found === index) return;
  const place = (severity: Severity) => (mark ? t.placeOf(mark, severity) : t.place());
  if (found % 1 !== 0) {
    const message = `Expected a whole number or "{" after ${keyword}, found ${found}.`;
    t.report.error('index-fractional', message, place('error'));
    return;
  }
  if (t.report.foldsInto('index-mismatch', keyword)) return;
  const message = `Expected ${index} as the number of this ${keyword}, counted from 0; found ${found}.`;
  t.report.warnFolded('index-mismatch', keyword, message, place('warning'), 'read in the order of the file');
}

/** A `{`; if missing, continues as if it were there. */
export function* openBrace(t: Tokens, after: string): GrammarPart<void> {
  if ((yield* t.next()) === '{') return;
  t.error('brace-missing', `Expected "{" after ${after}, found ${t.found()}.`);
  t.again();
}

/** After a block: compares the declared count with the actual one. */
export function checkCount(t: Tokens, what: string, { count, place }: Declared, found: number): void {
  if (count === undefined || count === found) {
    t.forget(place);
    return;
  }
  const message = `Expected ${count} ${what} as declared, found ${found}.`;
  t.report.warn('count-mismatch', message, t.placeOf(place, 'warning'), `used ${found}`);
}

/**
 * Skips a token that is not valid in `where`; equal ones share one warning. A keyword with a number right behind it is
 * no such token, but these two.
 *
 * @param blocks keywords of blocks that are valid there
 */
export function* skipStrange(t: Tokens, where: string, expected: string, blocks = NO_BLOCKS): GrammarPart<void> {
  const keyword = t.keyword().replace(/\d+$/, '');
  if (keyword !== t.keyword() && blocks.has(keyword)) {
    t.splitAt(keyword.length);
    return;
  }
  const message = () => `Expected ${expected} in ${where}, found ${t.found()}.`;
  if (t.kind === '{') {
    t.warn('brace-unexpected', message(), 'skipped to its "}"');
    yield* t.skipBlock();
    return;
  }
  const unknown = () => `Unknown keyword ${t.found()} in ${where}; expected ${expected}.`;
  if (Number.isNaN(t.value())) t.warnOnce('keyword-unknown', t.keyword() || t.found(), unknown, 'skipped');
  else t.warnOnce('number-unexpected', '', message, 'skipped');
  yield* t.skipUnknown();
}

const NO_BLOCKS: Keywords = new Set();

/** At an unmatched `}`. */
export function braceTooMany(t: Tokens): void {
  t.warn('brace-unexpected', 'Unmatched "}": every block is already closed.', 'ignored');
}

/** `what` is repeated: the later one is used. */
export function warnRepeated(t: Tokens, what: string): void {
  t.warn('repeated', `${what} appears a second time.`, 'the later one is used');
}

/**
 * New length for an array of `length` that needs room for `needed`, if `expected` are declared. The declared count is
 * trusted up to 16 times the current length, or 4 times if that is large. Without one it doubles.
 */
export function nextLength(length: number, needed: number, expected: number): number {
  const trusted = length < LARGE ? 16 * length : 4 * length;
  if (expected >= needed && expected <= trusted) return Math.ceil(expected);
  return Math.max(needed, expected > trusted ? 4 * length : 2 * length);
}

/** 8 MB of doubles. */
const LARGE = 1 << 20;
/** Initial length of a list at most, 32 kB: thousands of blocks must not each allocate for a whole file. */
const MAX_AT_FIRST = 1 << 12;

/** A growing list of numbers, read directly into place: `positions` and others. */
export class NumberList implements NumberSink {
  values: Float64Array;
  count = 0;
  readonly usesUp = false;

  /** `expected`: the declared count, if any; allocated at once only as far as the available bytes could fill it. */
  constructor(
    t: Tokens,
    private readonly expected: number | undefined,
  ) {
    const wanted = expected !== undefined && expected > 0 ? expected : 256;
    const first = Math.min(t.numbersAtHand(), wanted, MAX_AT_FIRST);
    this.values = new Float64Array(Math.max(16, Math.ceil(first)));
  }

  /** Grows the list, which keeps its numbers; see `nextLength`. */
  flush(): void {
    const grown = new Float64Array(nextLength(this.values.length, this.values.length + 1, this.expected ?? 0));
    grown.set(this.values);
    this.values = grown;
  }

  /** The numbers read, trimmed. */
  all(): Float64Array {
    return this.count === this.values.length ? this.values : this.values.slice(0, this.count);
  }
}

/** `N { x y z … }`: rows of `width` numbers. The current token is the keyword. */
export function* rows(t: Tokens, what: string, width: number, keywords: Keywords): GrammarPart<Float64Array> {
  const declared = yield* countAndBrace(t, what, keywords);
  const sink = new NumberList(t, declared.count === undefined ? undefined : declared.count * width);
  yield* t.numbers(sink, what, keywords);
  checkRows(t, what, width, declared, sink.count);
  return sink.all();
}

/** At the end of a block of rows. */
export function checkRows(t: Tokens, what: string, width: number, declared: Declared, found: number): void {
  if (t.kind !== '}') return;
  if (found % width !== 0) {
    const message = `Expected ${width} numbers per row of ${what}, found ${found % width} in the last row.`;
    t.error('row-incomplete', message);
  } else checkCount(t, what, declared, found / width);
}

/** Invalid indices of a block: reports the first and counts the rest. */
export class WrongIndices {
  private first: { code: string; message: string; place: Place } | undefined;
  private count = 0;

  /** `what`: "the index of a vertex"; `bound`: their number, Infinity if unknown. */
  constructor(
    private readonly what: string,
    private readonly bound: () => string,
  ) {}

  /** In a sink's `flush`: number `slot` is no index. (A closure for the place would slow the loop down.) */
  addSlot(index: number, t: Tokens, slot: number): void {
    if (this.count++ === 0) this.note(index, t.placeOfSlot(slot));
  }

  /** Counts an index that is out of range or fractional, at a known place; the first is kept for `tell`. */
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

  /** Reports what was found, with `more` that were only counted. */
  tell(t: Tokens, more = 0): void {
    const { first } = this;
    if (first) t.report.error(first.code, `${first.message}${andMore(this.count - 1 + more)}.`, first.place);
  }
}

function andMore(count: number): string {
  return count > 0 ? ` (and ${count} more like it)` : '';
}

/** 2^32: larger indices can't be stored, and no file has as many vertices. */
export const MAX_COUNT = 4294967296;
