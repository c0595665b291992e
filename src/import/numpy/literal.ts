/**
 * The header of a `.npy`: a literal of Python, which is matched, never evaluated.
 *
 *     dictionary  { 'key': value, … }      value   'text' or "text", True, False, a number, None
 *     tuple, list ( value, … ) [ value, … ]
 */

import { UserError } from '../../model/user-error.ts';

/** A literal's value; numbers keep their digits, so that large ones stay exact. */
export type Literal = string | boolean | null | { readonly digits: string } | readonly Literal[];

/** Nesting that no header needs; more is refused, since it would use up the stack. */
const DEEPEST = 16;
const TOKEN = /\s*(?:('(?:[^'\\]|\\.)*'|"(?:[^"\\]|\\.)*")|(-?\d+)L?|(True|False|None)|([{}()[\],:]))/y;

/** The members of a dictionary; undefined if a text is none, or if anything follows it. */
export function dictionaryOf(text: string): ReadonlyMap<string, Literal> | undefined {
  try {
    return new Reader(text).dictionary();
  } catch (error) {
    if (error instanceof NotLiteral) return undefined;
    throw error;
  }
}

class NotLiteral extends UserError {}

class Reader {
  private at = 0;
  private token: readonly string[] = [];

  constructor(private readonly text: string) {
    this.next();
  }

  dictionary(): ReadonlyMap<string, Literal> {
    const members = new Map<string, Literal>();
    this.take('{');
    while (!this.is('}')) {
      const key = this.value(0);
      if (typeof key !== 'string') throw new NotLiteral('Expected a literal.');
      this.take(':');
      members.set(key, this.value(0));
      if (!this.is('}')) this.take(',');
    }
    this.take('}');
    if (this.text.slice(this.at).trim() !== '') throw new NotLiteral('Expected a literal.');
    return members;
  }

  private value(depth: number): Literal {
    const [, quoted, digits, word, sign] = this.token;
    if (sign === '(' || sign === '[') return this.items(sign === '(' ? ')' : ']', depth + 1);
    this.next();
    if (quoted !== undefined) return quoted.slice(1, -1);
    if (digits !== undefined) return { digits };
    if (word !== undefined) return word === 'None' ? null : word === 'True';
    throw new NotLiteral('Expected a literal.');
  }

  private items(end: string, depth: number): readonly Literal[] {
    if (depth > DEEPEST) throw new NotLiteral('Expected a literal.');
    const items: Literal[] = [];
    this.next();
    while (!this.is(end)) {
      items.push(this.value(depth));
      if (!this.is(end)) this.take(',');
    }
    this.take(end);
    return items;
  }

  private is(sign: string): boolean {
    return this.token[4] === sign;
  }

  private take(sign: string): void {
    if (!this.is(sign)) throw new NotLiteral('Expected a literal.');
    this.next();
  }

  private next(): void {
    TOKEN.lastIndex = this.at;
    const found = TOKEN.exec(this.text);
    // Nothing is left after the last sign.
    this.token = found ?? [];
    if (found) this.at = TOKEN.lastIndex;
  }
}
