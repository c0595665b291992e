/** Small changes of a file's text that might fix it, and what each would mean. */
import type { TextLines, TextToken } from './text-lines.ts';

/** Replaces bytes [from, to) of a line by `put`, which has no line end: lines keep their numbers. */
export interface Edit {
  readonly from: number;
  readonly to: number;
  readonly put: string;
  readonly line: number;
  /** Offset of the token to point at. */
  readonly at: number;
  /** The problem, if no reader says so on the same line. */
  readonly code: string;
  readonly message: string;
}

/** The bytes with all edits applied; these don't overlap. */
export function edited(bytes: Uint8Array, edits: readonly Edit[]): Uint8Array {
  const encoder = new TextEncoder();
  const parts: Uint8Array[] = [];
  let from = 0;
  for (const edit of [...edits].sort((a, b) => a.from - b.from)) {
    parts.push(bytes.subarray(from, edit.from), encoder.encode(edit.put));
    from = edit.to;
  }
  parts.push(bytes.subarray(from));
  const all = new Uint8Array(parts.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}

type Problem = Pick<Edit, 'code' | 'message'>;

/** Deletes a token of a line. */
export function remove(line: number, token: TextToken, problem: Problem): Edit {
  return { from: token.start, to: token.stop, put: '', line, at: token.start, ...problem };
}

/** A blank on either side keeps a brace that was glued to a word apart. */
export function replace(line: number, token: TextToken, put: string, problem: Problem): Edit {
  return { from: token.start, to: token.stop, put: ` ${put} `, line, at: token.start, ...problem };
}

/** Inserts `put` after a token, with a blank on either side. */
export function insertBehind(line: number, token: TextToken, put: string, problem: Problem): Edit {
  return { from: token.stop, to: token.stop, put: ` ${put} `, line, at: token.start, ...problem };
}

/** Inserts `put` and a blank before a token. */
export function insertBefore(line: number, token: TextToken, put: string, problem: Problem): Edit {
  return { from: token.start, to: token.start, put: `${put} `, line, at: token.start, ...problem };
}

/** A token for a message, shortened. */
export function quoted(lines: TextLines, token: TextToken): string {
  const text = lines.text(token);
  return `"${text.length > 40 ? `${text.slice(0, 40)}…` : text}"`;
}
