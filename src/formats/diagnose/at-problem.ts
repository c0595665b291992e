/**
 * Edits of one token at a problem: the token deleted, another in its place, one inserted before it (Burke and Fisher
 * 1987, "A practical method for LR and LL syntactic error diagnosis and recovery").
 *
 * What is missing at the end of a line is noticed at the first token of the next one. An insertion before that is one
 * behind the line before.
 */
import type { Diagnostic } from '../../model/diagnostic.ts';
import { type Edit, insertBefore, insertBehind, quoted, remove, replace } from './edit.ts';
import type { TextLayout } from './layouts.ts';
import type { TextLines } from './text-lines.ts';

/** One of these is what most grammars miss; `x` is a name. */
const TOKENS = ['0', '{', '}', 'x'] as const;
/** Problems that say that their token is not what it should be. */
const MALFORMED = /^not-a-number$|^number-too-large$|-unknown$/;

export interface EditsAtProblem {
  readonly sameLine: readonly Edit[];
  /** Behind the line before. */
  readonly lineBefore: readonly Edit[];
  /** Whether the problem is a token that is missing, and another one was found at the start of a line. */
  readonly looksMissing: boolean;
  /** Whether the problem is its token itself. */
  readonly isMalformed: boolean;
}

const MISSING = /^(number|file|name)-expected$|^brace-missing$|^(extrapolation|order|mode|channel)-unknown$/;

export function editsAtProblem(lines: TextLines, problem: Diagnostic, { keywords }: TextLayout): EditsAtProblem {
  const found = lines.tokenAt(problem.line, problem.column);
  const { code, message } = problem;
  const what = { code, message };
  const { tokens, index } = found ?? { tokens: lines.tokens(lines.filled.at(-1) ?? 0), index: -1 };
  const line = found ? problem.line : (lines.filled.at(-1) ?? 0);
  const sameLine: Edit[] = [];
  const lineBefore: Edit[] = [];
  const isMalformed = MALFORMED.test(code);
  if (line === 0) return { sameLine, lineBefore, looksMissing: false, isMalformed };
  if (found) {
    const token = tokens[index];
    sameLine.push(remove(line, token, what));
    for (const put of TOKENS) sameLine.push(replace(line, token, put, what));
    const puts = index > 0 ? TOKENS : keywords;
    for (const put of puts) sameLine.push(insertBefore(line, token, put, what));
    if (index === 0) for (const put of keywords) sameLine.push(replace(line, token, put, what));
    sameLine.push(insertBehind(line, tokens[tokens.length - 1], '0', what));
    if (index > 0) sameLine.push(remove(line, tokens[index - 1], what));
    if (index + 1 < tokens.length) sameLine.push(remove(line, tokens[index + 1], what));
  }
  // At the end of the file, something is missing behind its last token.
  const before = found ? lines.lineBefore(line) : line;
  const last = before > 0 ? lines.tokens(before).at(-1) : undefined;
  // A word like the last one: where one is missing from a list of them.
  const puts = last?.class === 'w' ? [...TOKENS, lines.text(last)] : TOKENS;
  if (last) for (const put of puts) lineBefore.push(insertBehind(before, last, put, what));
  // Some problems point at a keyword whose values are wrong.
  const isFound = !found || message.includes(`found ${quoted(lines, tokens[index])}`);
  return { sameLine, lineBefore, looksMissing: index <= 0 && isFound && MISSING.test(code), isMalformed };
}
