/**
 * Missing and superfluous braces, by the indentation.
 *
 *     balljoint hip {            a line that opens a block is indented less than the lines in it,
 *         offset 0 1 0           and as much as the } that closes it
 *         balljoint knee {
 *             offset 0 1 0
 *     }                          indented as line 1, so the } of line 3 is missing before it
 */
import { type Edit, insertBehind, quoted, remove, replace } from './edit.ts';
import type { TextLines, TextToken } from './text-lines.ts';

/** Files mix tabs and blanks: the width that contradicts least is taken. */
const TAB_WIDTHS = [8, 4, 2] as const;
/** With more contradictions, the indentation does not follow the blocks. */
const MOST = 8;

interface Open {
  readonly line: number;
  readonly indent: number;
  /** Indentation of the lines in it, once one is known. */
  inner: number;
}

/** Edits that make the blocks agree with the indentation, from the top. */
export function bracesByIndent(lines: TextLines): readonly Edit[] {
  let best: readonly Edit[] | undefined;
  for (const width of TAB_WIDTHS) {
    const found = contradictions(lines, width);
    if (found.length <= MOST && found.length < (best?.length ?? MOST + 1)) best = found;
  }
  return best ?? [];
}

function contradictions(lines: TextLines, tabWidth: number): readonly Edit[] {
  const open: Open[] = [];
  const edits: Edit[] = [];
  /** The last `}` that closed a block, and the block. */
  let closed: { line: number; token: TextToken; block: Open } | undefined;
  let before = 0;
  for (const line of lines.filled) {
    if (edits.length > MOST) return edits;
    const row = lines.row(line);
    if (row.first === 'n' && !row.hasBrace && row.count > 1) {
      closed = undefined;
      before = line;
      continue;
    }
    const tokens = lines.tokens(line);
    const indent = lines.indent(line, tabWidth);
    const isClosing = tokens[0].class === '}';
    const isBrace = tokens[0].class === '{';
    let top = open.at(-1);
    // Blocks that should have been closed before this line.
    while (top && before > 0 && (isClosing || isBrace ? indent < top.indent : indent <= top.indent)) {
      // A word that is alone where the brace should be may be in its place.
      if (tokens.length === 1 && !isClosing && !isBrace && indent === top.indent) {
        edits.push(inPlace(lines, top, line, tokens[0]));
      }
      edits.push(missing(lines, top, before, line));
      open.pop();
      top = open.at(-1);
      if (edits.length > MOST) return edits;
    }
    if (closed && !isClosing && indent > closed.block.indent && indent === closed.block.inner) {
      // As if the block were still open.
      const { block, token, line: at } = closed;
      edits.push(superfluous(at, token));
      open.push(block);
    } else if (isClosing && indent > (top?.indent ?? -1)) {
      if (closed && closed.block.indent === indent) {
        edits.push(superfluous(closed.line, closed.token));
        open.push(closed.block);
      } else {
        edits.push(superfluous(line, tokens[0]));
        before = line;
        continue;
      }
    }
    top = open.at(-1);
    if (top && !isClosing && top.inner < 0) top.inner = indent;
    closed = undefined;
    // A brace alone on a line belongs to the line before it.
    for (const token of tokens) {
      if (token.class === '{') open.push({ line: isBrace ? before || line : line, indent, inner: -1 });
      else if (token.class === '}') {
        const block = open.pop();
        closed = block && { line, token, block };
      } else closed = undefined;
    }
    before = line;
  }
  const last = lines.filled.at(-1);
  if (last !== undefined) for (const block of open.reverse()) edits.push(missing(lines, block, last, 0));
  return edits;
}

function missing(lines: TextLines, { line: opened }: Open, before: number, next: number): Edit {
  const tokens = lines.tokens(before);
  const last = tokens[tokens.length - 1];
  const where = next > 0 ? `before line ${next}` : 'before the end of the file';
  const message = `Expected "}" ${where}, to close the block of line ${opened}, as the indentation shows.`;
  return insertBehind(before, last, '}', { code: 'brace-missing', message });
}

function inPlace(lines: TextLines, { line: opened }: Open, line: number, token: TextToken): Edit {
  const message = `Expected "}" to close the block of line ${opened}, as the indentation shows, found ${quoted(lines, token)}.`;
  return replace(line, token, '}', { code: 'brace-missing', message });
}

function superfluous(line: number, token: TextToken): Edit {
  const message = 'This "}" is one too many, as the indentation shows.';
  return remove(line, token, { code: 'brace-unexpected', message });
}
