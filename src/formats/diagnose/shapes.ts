/**
 * Lines that look unlike all others but for one token.
 *
 *     offset 0 1 0          →  offset n n n        22 times
 *     offset 0 1            →  offset n n          once: a number is missing
 *     balljoint knee        →  balljoint w         once, and `balljoint w {` 22 times: a brace is missing
 *
 * A shape is the first word as it is, and the classes of the other tokens.
 */
import { type Edit, insertBefore, insertBehind, quoted, remove, replace } from './edit.ts';
import type { TextLines, TextToken } from './text-lines.ts';

/** Longer lines are rows, or names. */
const LONGEST = 40;
/** A usual shape has so many lines, and so many times those of an unusual one. */
const USUAL = 2;
const TIMES = 2;
const MAX_USUAL = 60;

interface Shape {
  readonly key: string;
  /** The first word in lower case, '' for a number or a brace; then classes. */
  readonly parts: readonly string[];
  count: number;
  /** One of its lines. */
  readonly line: number;
}

/** Edits that make a line of an unusual shape usual, from the top, at most `most`. */
export function irregularShapes(lines: TextLines, most: number): readonly Edit[] {
  const shapes = new Map<string, Shape>();
  for (const line of lines.filled) {
    if (lines.row(line).count > LONGEST) continue;
    const parts = partsOf(lines, lines.tokens(line));
    const key = parts.join(' ');
    const known = shapes.get(key);
    if (known) known.count++;
    else shapes.set(key, { key, parts, count: 1, line });
  }
  const all = [...shapes.values()];
  const usual = all.filter(({ count }) => count >= USUAL).sort((a, b) => b.count - a.count);
  const edits: Edit[] = [];
  for (const shape of all) {
    if (shape.count > 1) continue;
    for (const model of usual.slice(0, MAX_USUAL)) {
      if (edits.length >= most) return edits;
      if (model.count < TIMES * shape.count) break;
      const edit = towards(lines, shape, model);
      if (edit) edits.push(edit);
    }
  }
  return edits;
}

function partsOf(lines: TextLines, tokens: readonly TextToken[]): string[] {
  return tokens.map((token, i) => (i === 0 && token.class === 'w' ? lines.text(token).toLowerCase() : token.class));
}

/** The edit of one token that gives the line this shape. */
function towards(lines: TextLines, { line, parts }: Shape, usual: Shape): Edit | undefined {
  const model = usual.parts;
  const by = model.length - parts.length;
  if (Math.abs(by) > 1) return undefined;
  const tokens = lines.tokens(line);
  const fits = (m: number, i: number) => {
    const token = tokens[i];
    if (token === undefined || model[m] === undefined) return false;
    return m === 0 ? isFirst(lines, token, model[0]) : model[m] === token.class;
  };
  let same = 0;
  while (fits(same, same)) same++;
  const rest = (m: number, i: number) => {
    while (m < model.length) if (!fits(m++, i++)) return false;
    return true;
  };
  const expected = `Expected ${nameOf(model[same])}`;
  const where = ', as on similar lines';
  if (by === 1 && rest(same + 1, same)) {
    const code = missing(model[same]);
    const put = wordFor(lines, usual, same);
    const next = tokens[same];
    if (same === 0) {
      return insertBefore(line, next, put, { code, message: `${expected} before ${quoted(lines, next)}${where}.` });
    }
    const before = tokens[same - 1];
    return insertBehind(line, before, put, { code, message: `${expected} after ${quoted(lines, before)}${where}.` });
  }
  const token = tokens[same];
  if (token && by === -1 && rest(same, same + 1)) {
    return remove(line, token, {
      code: unexpected(token),
      message: `Expected no ${quoted(lines, token)} here${where}.`,
    });
  }
  if (token && by === 0 && rest(same + 1, same + 1)) {
    const message = `${expected}${where}, found ${quoted(lines, token)}.`;
    return replace(line, token, wordFor(lines, usual, same), { code: missing(model[same]), message });
  }
  return undefined;
}

/** Whether a token is the first part of a shape. */
function isFirst(lines: TextLines, token: TextToken, part: string): boolean {
  return token.class === part || (token.class === 'w' && lines.text(token).toLowerCase() === part);
}

/** Codes as the readers have them. */
function missing(part: string): string {
  if (part === '{' || part === '}') return 'brace-missing';
  return part === 'n' ? 'number-expected' : 'name-expected';
}

function unexpected(token: TextToken): string {
  if (token.class === '{' || token.class === '}') return 'brace-unexpected';
  return token.class === 'n' ? 'number-unexpected' : 'keyword-unexpected';
}

/** As on one of the usual lines. */
function wordFor(lines: TextLines, { line }: Shape, index: number): string {
  return lines.text(lines.tokens(line)[index]);
}

function nameOf(part: string | undefined): string {
  if (part === 'n') return 'a number';
  return part === 'w' || part === undefined ? 'a word' : `"${part}"`;
}

/** Whether another line has the shape of this one. */
export function isUsual(lines: TextLines, line: number): boolean {
  const { first, count } = lines.row(line);
  const shapeOf = (each: number) => partsOf(lines, lines.tokens(each)).join(' ');
  const shape = shapeOf(line);
  const isLike = (each: number) => lines.row(each).count === count && lines.row(each).first === first;
  return lines.filled.some((each) => each !== line && isLike(each) && shapeOf(each) === shape);
}
