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
  const blocks = new Blocks(lines, tabWidth);
  for (const line of lines.filled) {
    const { first, count, hasBrace } = lines.row(line);
    // Rows are indented as their writer liked.
    if (first === 'n' && !hasBrace && count > 1) blocks.pass(line);
    else blocks.line(line);
    if (blocks.areTooMany) break;
  }
  blocks.end();
  return blocks.edits;
}

/** The blocks that are open, line by line. */
class Blocks {
  readonly edits: Edit[] = [];
  private readonly open: Open[] = [];
  /** The last token of the line before, if it is a `}`, and the block that it closed. */
  private closed: { readonly line: number; readonly token: TextToken; readonly block: Open } | undefined;
  /** The line before that has tokens; 0 for none. */
  private before = 0;

  constructor(
    private readonly lines: TextLines,
    private readonly tabWidth: number,
  ) {}

  /** Found so far: more are not worth finding, as each goes through its line. */
  get areTooMany(): boolean {
    return this.edits.length > MOST;
  }

  pass(line: number): void {
    this.closed = undefined;
    this.before = line;
  }

  line(line: number): void {
    const tokens = this.lines.tokens(line);
    const indent = this.lines.indent(line, this.tabWidth);
    this.closeTo(line, tokens, indent);
    const isExtra = tokens[0].class === '}' ? this.isExtra(line, tokens[0], indent) : this.reopen(indent);
    if (!isExtra) this.take(line, tokens, indent);
    this.before = line;
  }

  /** At the end of the file. */
  end(): void {
    const { lines, open, edits } = this;
    const last = lines.filled.at(-1);
    if (last === undefined) return;
    while (!this.areTooMany) {
      const block = open.pop();
      if (!block) return;
      edits.push(missing(lines, block, last, 0));
    }
  }

  /** Blocks that should have been closed before this line. */
  private closeTo(line: number, tokens: readonly TextToken[], indent: number): void {
    const { lines, open, edits, before } = this;
    const isWord = tokens[0].class === 'w' || tokens[0].class === 'n';
    for (let top = open.at(-1); top && before > 0 && !this.areTooMany; top = open.at(-1)) {
      if (isWord ? indent > top.indent : indent >= top.indent) return;
      // A word that is alone where the brace should be may be in its place.
      if (isWord && tokens.length === 1 && indent === top.indent) edits.push(inPlace(lines, top, line, tokens[0]));
      edits.push(missing(lines, top, before, line));
      open.pop();
    }
  }

  /** If the line is indented as those in the block that was closed last, it still belongs to it. */
  private reopen(indent: number): false {
    const { closed } = this;
    if (closed && indent > closed.block.indent && indent === closed.block.inner) this.undo(closed);
    return false;
  }

  /** Whether the `}` closes nothing that is indented like it. */
  private isExtra(line: number, token: TextToken, indent: number): boolean {
    const { closed } = this;
    if (indent <= (this.open.at(-1)?.indent ?? -1)) return false;
    if (closed?.block.indent === indent && !this.isInPlace(closed)) {
      this.undo(closed);
      return false;
    }
    this.edits.push(superfluous(line, token));
    return true;
  }

  /** Whether a `}` is where the indentation has it: the next one is too many then. */
  private isInPlace({ line, token, block }: NonNullable<Blocks['closed']>): boolean {
    return this.lines.head(line).start === token.start && this.lines.indent(line, this.tabWidth) === block.indent;
  }

  private undo({ line, token, block }: NonNullable<Blocks['closed']>): void {
    this.edits.push(superfluous(line, token));
    this.open.push(block);
  }

  private take(line: number, tokens: readonly TextToken[], indent: number): void {
    const top = this.open.at(-1);
    const [{ class: first }] = tokens;
    if (top && first !== '}' && top.inner < 0) top.inner = indent;
    this.closed = undefined;
    // A brace alone on a line belongs to the line before it.
    const opener = first === '{' ? this.before || line : line;
    for (const token of tokens) {
      if (token.class === '{') this.open.push({ line: opener, indent, inner: -1 });
      const block = token.class === '}' ? this.open.pop() : undefined;
      this.closed = block && { line, token, block };
    }
  }
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
