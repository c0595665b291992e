/**
 * Damage to real files by one token, and what is said about it: how often the first diagnostic names the very line, and
 * how many more follow from it.
 */
import type { Diagnostic } from '../../src/model/diagnostic.ts';

/** A file with one token deleted, inserted or replaced. */
export interface Damaged {
  readonly text: string;
  /** Lines that may be named: the damaged one; if it vanished, from the line before to the one that is there now. */
  readonly first: number;
  readonly last: number;
  /** For messages of tests. */
  readonly what: string;
}

export const OPERATIONS = ['delete', 'insert', 'replace'] as const;
export type Operation = (typeof OPERATIONS)[number];

/** Numbers in [0, 1), the same for the same seed (mulberry32). */
export function randomOf(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

interface Token {
  readonly start: number;
  readonly stop: number;
}

/** A file, ready to be damaged many times. */
export class Intact {
  private readonly tokens: readonly Token[];
  /** Offsets of lines. */
  private readonly starts: readonly number[];
  /** Words of the file that are no numbers: its keywords, and a few names. */
  private readonly words: readonly string[];

  constructor(readonly text: string) {
    this.tokens = [...text.matchAll(/[{}]|[^\s{}]+/g)].map(({ index, 0: word }) => ({
      start: index,
      stop: index + word.length,
    }));
    this.starts = [0, ...[...text.matchAll(/\r*\n|\r/g)].map(({ index, 0: end }) => index + end.length)];
    const words = new Set(this.tokens.map((t) => this.wordOf(t)).filter((w) => !isNumber(w) && !/[{}]/.test(w)));
    this.words = [...words];
  }

  damage(operation: Operation, random: () => number): Damaged {
    const pick = <T>(list: readonly T[]): T => list[Math.floor(random() * list.length)];
    const token = pick(this.tokens);
    const word = this.wordOf(token);
    if (operation === 'delete') return this.without(token);
    if (operation === 'insert') {
      const put = pick(['0.5', '3', 'foo', '1.2x', '{', '}', pick(this.words)]);
      const isBehind = random() < 0.5;
      const at = isBehind ? token.stop : token.start;
      return this.put(
        at,
        at,
        isBehind ? ` ${put}` : `${put} `,
        `insert ${put} ${isBehind ? 'behind' : 'before'} ${word}`,
      );
    }
    const put = isNumber(word)
      ? pick(['foo', `${word}x`, word.includes('.') ? word.replace('.', ',') : `${word},5`, 'nan', '{', '}'])
      : /[{}]/.test(word)
        ? pick([word === '{' ? '}' : '{', '7', 'foo'])
        : pick([misspelt(word, random), misspelt(word, random), '7', '{', '}', pick(this.words)]);
    return this.put(token.start, token.stop, put, `${word} replaced by ${put}`);
  }

  private without({ start, stop }: Token): Damaged {
    const line = this.lineOf(start);
    const from = this.starts[line - 1];
    const to = this.starts[line] ?? this.text.length;
    const what = `${this.text.slice(start, stop)} deleted`;
    if (`${this.text.slice(from, start)}${this.text.slice(stop, to)}`.trim() !== '')
      return this.put(start, stop, '', what);
    const text = this.text.slice(0, from) + this.text.slice(to);
    // Up to the neighbours that are not empty.
    const lines = text.split(/\r*\n|\r/);
    let first = line - 1;
    while (first > 1 && lines[first - 1].trim() === '') first--;
    let last = line;
    while (last < lines.length && lines[last - 1].trim() === '') last++;
    return { text, first, last, what: `${what} with its line ${line}` };
  }

  private put(start: number, stop: number, put: string, what: string): Damaged {
    const line = this.lineOf(start);
    const text = this.text.slice(0, start) + put + this.text.slice(stop);
    return { text, first: line, last: line, what: `${what} on line ${line}` };
  }

  private lineOf(at: number): number {
    let low = 0;
    let high = this.starts.length;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (this.starts[middle] <= at) low = middle;
      else high = middle;
    }
    return low + 1;
  }

  private wordOf({ start, stop }: Token): string {
    return this.text.slice(start, stop);
  }
}

function isNumber(word: string): boolean {
  return word !== '' && Number.isFinite(Number(word));
}

function misspelt(word: string, random: () => number): string {
  const at = Math.floor(random() * word.length);
  return `${word.slice(0, at)}q${word.slice(at + 1)}`;
}

/** Diagnostics that a damaged file brings beside those of the intact one, without remarks. */
export function newProblems(before: readonly Diagnostic[], after: readonly Diagnostic[]): readonly Diagnostic[] {
  const known = before.map(({ code, line, column }) => `${code} ${line}:${column}`);
  return after.filter(({ severity, code, line, column }) => {
    if (severity === 'info') return false;
    const at = known.indexOf(`${code} ${line}:${column}`);
    if (at >= 0) known.splice(at, 1);
    return at < 0;
  });
}
