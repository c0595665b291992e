/** Comments, texts and names of a TypeScript source, without parsing it: enough to hold its words to rules. */

export interface SourceWords {
  /** Without their delimiters; a run of `//` lines is one comment. */
  readonly comments: readonly SourceWord[];
  /** Of string and template literals; each expression of a template is `…`. Import paths and property names too. */
  readonly texts: readonly SourceWord[];
  /** Identifiers and keywords, each occurrence. */
  readonly names: readonly SourceWord[];
}

export interface SourceWord {
  readonly text: string;
  /** From 1. */
  readonly line: number;
}

/** A slash after one of these divides; after any other token it begins a regular expression. */
const ENDS_VALUE = /[\w$)\]}'"`]$/;
const BEFORE_REGEX = /\b(return|typeof|case|in|of|do|else|void|delete|throw|new|await|yield)$/;
const PIECE =
  /(\/\/[^\n]*)|(\/\*[\s\S]*?\*\/)|('(?:\\[\s\S]|[^'\\\n])*'|"(?:\\[\s\S]|[^"\\\n])*")|([A-Za-z_$][\w$]*)|(\d[\w.]*)|([`{}/])|(\s+)|([\s\S])/y;
const REGEX = /\/(?:\\.|\[(?:\\.|[^\]\\\n])*\]|[^/\\\n[])+\/[a-z]*/y;

export function wordsOf(source: string): SourceWords {
  const comments: SourceWord[] = [];
  const texts: SourceWord[] = [];
  const names: SourceWord[] = [];
  /** Templates that are open: where each one's text began, its text so far, and the braces open in its expression. */
  const open: { line: number; text: string; depth: number }[] = [];
  let at = 0;
  let line = 1;
  let before = '';
  let lastComment = -2;
  const pass = (text: string) => {
    for (const c of text) if (c === '\n') line++;
    at += text.length;
  };
  /** The rest of a template's text, up to its end or the next expression. */
  const template = (): void => {
    const one = open[open.length - 1];
    for (; at < source.length; ) {
      const c = source[at];
      if (c === '`') {
        pass(c);
        open.pop();
        texts.push({ text: unescaped(one.text), line: one.line });
        before = '`';
        return;
      }
      if (c === '$' && source[at + 1] === '{') {
        pass('${');
        one.text += '…';
        one.depth = 0;
        before = '';
        return;
      }
      const piece = c === '\\' ? source.slice(at, at + 2) : c;
      one.text += piece;
      pass(piece);
    }
  };
  while (at < source.length) {
    PIECE.lastIndex = at;
    const [piece, lineComment, block, text, name, number, sign, space] = PIECE.exec(source) ?? [''];
    const start = line;
    if (sign === '/' && (!ENDS_VALUE.test(before) || BEFORE_REGEX.test(before))) {
      REGEX.lastIndex = at;
      const regex = REGEX.exec(source)?.[0] ?? '/';
      pass(regex);
      before = ')';
      continue;
    }
    pass(piece);
    if (space !== undefined) continue;
    if (lineComment !== undefined) {
      const last = comments.at(-1);
      const said = piece.slice(2).trim();
      if (last && lastComment === start - 1) {
        comments[comments.length - 1] = { ...last, text: `${last.text} ${said}` };
      } else comments.push({ text: said, line: start });
      lastComment = start;
    } else if (block !== undefined) {
      comments.push({
        text: piece
          .slice(2, -2)
          .replace(/^[*\s]+|\n\s*\*?/g, ' ')
          .trim(),
        line: start,
      });
    } else if (text !== undefined) {
      texts.push({ text: unescaped(piece.slice(1, -1)), line: start });
      before = "'";
    } else if (name !== undefined) {
      names.push({ text: piece, line: start });
      before = piece;
    } else if (number !== undefined) before = '0';
    else if (sign === '`') {
      open.push({ line: start, text: '', depth: 0 });
      template();
    } else {
      const one = open.at(-1);
      if (one && sign === '{') one.depth++;
      if (one && sign === '}' && one.depth-- === 0) template();
      else before = piece;
    }
  }
  return { comments, texts, names };
}

function unescaped(text: string): string {
  return text.replace(/\\u\{?([0-9a-fA-F]+)\}?|\\([\s\S])/g, (_, code?: string, c?: string) =>
    code === undefined ? (c === 'n' ? '\n' : (c ?? '')) : String.fromCodePoint(Number.parseInt(code, 16)),
  );
}
