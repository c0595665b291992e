/**
 * What is done to a file: to its bytes, tokens, numbers, lines and blocks. Texts are held as one character for each
 * byte, so that bytes that are no UTF-8 come through.
 */

import type { Seed } from './corpus.ts';
import { EXTREME_INTEGERS, EXTREME_NUMBERS, LONG_LENGTHS, WORDS } from './hostile.ts';

/** Chances from 0 to 1 (excluding), of one input. */
export type Random = () => number;

type Mutation = (text: string, random: Random, others: readonly Seed[]) => string;

/** Inputs are small, but for one in hundreds: what grows with the square shows in these. */
const SMALL = 3000;
const LARGE = 200_000;
const LARGE_SHARE = 1 / 400;

export const below = (random: Random, count: number) => Math.floor(random() * count);
export const pick = <T>(random: Random, list: readonly T[]): T => list[below(random, list.length)];

/** One to four mutations of a file. @param others of the same subject, for splices */
export function mutated(seed: Seed, others: readonly Seed[], random: Random): Uint8Array<ArrayBuffer> {
  const isText = !seed.bytes.subarray(0, 2000).includes(0);
  const list = isText ? (random() < 0.9 ? TEXT_MUTATIONS : BYTE_MUTATIONS) : BINARY_MUTATIONS;
  let text = Buffer.from(seed.bytes).toString('latin1');
  for (let count = 1 + below(random, 4); count > 0; count--) text = pick(random, list)(text, random, others);
  return new Uint8Array(Buffer.from(text.slice(0, Math.max(LARGE, seed.bytes.length)), 'latin1'));
}

/** As the bytes of UTF-8. */
const utf8 = (text: string) => Buffer.from(text, 'utf8').toString('latin1');

function replaced(text: string, from: number, to: number, by: string): string {
  return text.slice(0, from) + by + text.slice(to);
}

interface Span {
  readonly from: number;
  readonly to: number;
}

/** A token near a random place: all of them would take long to find. */
function tokenAt(text: string, random: Random, what = /[{}[\],:"]|[^\s{}[\],:"]+/g): Span | undefined {
  what.lastIndex = below(random, text.length + 1);
  let found = what.exec(text);
  if (!found) {
    what.lastIndex = 0;
    found = what.exec(text);
  }
  // From the middle of a token its rest is found: its beginning is looked for.
  if (!found) return undefined;
  let from = found.index;
  while (from > 0 && /[^\s{}[\],:"]/.test(text[from - 1]) && /[^\s{}[\],:"]/.test(text[from])) from--;
  return { from, to: found.index + found[0].length };
}

const numberAt = (text: string, random: Random) => tokenAt(text, random, /[-+.]?\d[^\s{}[\],:"]*/g);

function lineAt(text: string, random: Random): Span {
  const at = below(random, text.length + 1);
  const end = text.indexOf('\n', at);
  return { from: text.lastIndexOf('\n', at - 1) + 1, to: end < 0 ? text.length : end + 1 };
}

/** From a brace or bracket to its partner. */
function blockAt(text: string, random: Random): Span | undefined {
  let from = below(random, text.length + 1);
  while (from < text.length && text[from] !== '{' && text[from] !== '[') from++;
  const open = text[from];
  const close = open === '{' ? '}' : ']';
  let depth = 0;
  for (let i = from; i < text.length; i++) {
    if (text[i] === open) depth++;
    else if (text[i] === close && --depth === 0) return { from, to: i + 1 };
  }
  return undefined;
}

function rangeIn(text: string, random: Random): Span {
  const from = below(random, text.length + 1);
  const longest = random() < 0.5 ? 8 : text.length - from;
  return { from, to: Math.min(text.length, from + 1 + below(random, longest)) };
}

/** Copies of a span behind it. */
function repeated(text: string, { from, to }: Span, random: Random): string {
  const own = text.slice(from, to);
  const isLarge = random() < LARGE_SHARE;
  const most = Math.max(0, (isLarge ? LARGE : SMALL) - text.length) / Math.max(1, own.length);
  const count = isLarge ? Math.floor(most) : Math.min(most, 2 ** below(random, 12));
  return replaced(text, to, to, own.repeat(Math.ceil(count)));
}

/** Both spans change places; the same text if they overlap. */
function swapped(text: string, a: Span, b: Span): string {
  const [first, second] = a.from <= b.from ? [a, b] : [b, a];
  if (first.to > second.from) return text;
  const [one, two] = [text.slice(first.from, first.to), text.slice(second.from, second.to)];
  return text.slice(0, first.from) + two + text.slice(first.to, second.from) + one + text.slice(second.to);
}

/** Does something to what `find` finds; the same text if there is none. */
function at(
  find: (text: string, random: Random) => Span | undefined,
  change: (text: string, span: Span, random: Random) => string,
): Mutation {
  return (text, random) => {
    const span = find(text, random);
    return span ? change(text, span, random) : text;
  };
}

const otherWord: Mutation = (text, random) => {
  const span = tokenAt(text, random);
  return span ? text.slice(span.from, span.to) : '';
};

const splice: Mutation = (text, random, others) => {
  const other = Buffer.from(pick(random, others).bytes).toString('latin1');
  if (random() < 0.5)
    return text.slice(0, below(random, text.length + 1)) + other.slice(below(random, other.length + 1));
  const { from, to } = rangeIn(other, random);
  const place = below(random, text.length + 1);
  return replaced(text, place, place, other.slice(from, to));
};

const truncate: Mutation = (text, random) => text.slice(0, below(random, text.length + 1));

const BYTE_MUTATIONS: readonly Mutation[] = [
  truncate,
  splice,
  at(rangeIn, (text, { from, to }) => replaced(text, from, to, '')),
  at(rangeIn, (text, span, random) => repeated(text, span, random)),
  (text, random) => swapped(text, rangeIn(text, random), rangeIn(text, random)),
  ...Array.from(
    { length: 4 },
    (): Mutation => (text, random) => {
      const place = below(random, text.length + 1);
      const length = 1 + below(random, random() < 0.8 ? 2 : 16);
      const bytes = String.fromCharCode(...Array.from({ length }, () => below(random, 256)));
      return replaced(text, place, random() < 0.7 ? place + length : place, bytes);
    },
  ),
];

/** Aligned words of binary files: counts, offsets, floats. */
const binaryWord: Mutation = (text, random) => {
  const place = 4 * below(random, Math.ceil((text.length + 1) / 4)) + (random() < 0.2 ? below(random, 4) : 0);
  const bytes = Buffer.alloc(random() < 0.2 ? 8 : 4);
  if (bytes.length === 8) bytes.writeDoubleLE(pick(random, [Number.NaN, Infinity, 1e308, -0, 2 ** 53]));
  else if (random() < 0.3) bytes.writeFloatLE(pick(random, [Number.NaN, -Infinity, 3e38, 1e-40, -0, 1]));
  else if (random() < 0.5) bytes.writeUInt32LE(pick(random, EXTREME_INTEGERS));
  else bytes.writeUInt32LE(below(random, 2 * text.length + 8));
  return replaced(text, place, place + bytes.length, bytes.toString('latin1'));
};

const BINARY_MUTATIONS: readonly Mutation[] = [
  ...BYTE_MUTATIONS,
  ...BYTE_MUTATIONS.slice(-3),
  ...Array.from({ length: 5 }, () => binaryWord),
  at(numberAt, (text, { from, to }, random) => {
    // As long as before, so that offsets behind it still hold.
    const other = pick(random, EXTREME_NUMBERS).slice(0, to - from);
    return replaced(text, from, to, other.padEnd(to - from, '0'));
  }),
];

const number: Mutation = at(numberAt, (text, { from, to }, random) =>
  replaced(text, from, to, pick(random, EXTREME_NUMBERS)),
);

/** A digit, so that counts and indices are off by little. */
const digit: Mutation = (text, random) => {
  const span = numberAt(text, random);
  if (!span) return text;
  const place = span.from + below(random, span.to - span.from);
  return replaced(text, place, place + 1, String(below(random, 10)));
};

const TEXT_MUTATIONS: readonly Mutation[] = [
  truncate,
  splice,
  number,
  number,
  number,
  digit,
  digit,
  at(tokenAt, (text, { from, to }) => replaced(text, from, to, '')),
  at(tokenAt, (text, { from, to }, random) => replaced(text, from, to, utf8(pick(random, WORDS)))),
  at(tokenAt, (text, { from, to }, random) => replaced(text, from, to, otherWord(text, random, []))),
  at(tokenAt, (text, { to }, random) => replaced(text, to, to, utf8(` ${pick(random, WORDS)}`))),
  at(tokenAt, (text, span, random) => repeated(text, span, random)),
  at(tokenAt, (text, { to }, random) =>
    replaced(text, to, to, utf8(pick(random, ['x', 'ü', '骨', '"']).repeat(pick(random, LONG_LENGTHS)))),
  ),
  (text, random) =>
    swapped(text, tokenAt(text, random) ?? { from: 0, to: 0 }, tokenAt(text, random) ?? { from: 0, to: 0 }),
  at(lineAt, (text, { from, to }) => replaced(text, from, to, '')),
  at(lineAt, (text, span, random) => repeated(text, span, random)),
  (text, random) => swapped(text, lineAt(text, random), lineAt(text, random)),
  at(blockAt, (text, { from, to }) => replaced(text, from, to, '')),
  at(blockAt, (text, span, random) => repeated(text, span, random)),
  (text, random) =>
    swapped(text, blockAt(text, random) ?? { from: 0, to: 0 }, blockAt(text, random) ?? { from: 0, to: 0 }),
  (text, random) => {
    const block = blockAt(text, random);
    const place = below(random, text.length + 1);
    return block ? replaced(text, place, place, text.slice(block.from, block.to)) : text;
  },
  (text, random) => text.replaceAll(/\r*\n|\r/g, pick(random, ['\r\n', '\r', '\n', '\r\r\n', ' ', '\u2028'])),
  (text, random) => utf8(pick(random, ['\uFEFF', '\uFEFF\uFEFF', ' ', '\n\n', '\0', '#'])) + text,
  (text, random) => {
    if (random() < 0.7) return text;
    const wide = Buffer.from(`\uFEFF${Buffer.from(text, 'latin1').toString('utf8')}`, 'utf16le');
    return (random() < 0.5 ? wide : wide.subarray(0, wide.length & ~1).swap16()).toString('latin1');
  },
  ...BYTE_MUTATIONS.slice(-2),
];
