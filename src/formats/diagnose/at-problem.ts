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
import type { TextLines, TextToken } from './text-lines.ts';

/** One of these is what most grammars miss; `x` is a name. */
const TOKENS = ['0', '{', '}', 'x'] as const;
/** Problems that say that their token is not what it should be. */
const MALFORMED = /^not-a-number$|^number-too-large$|-unknown$/;

/** One-token edits at a problem and at the end of the line before it, with what they depend on. */
export interface EditsAtProblem {
  readonly sameLine: readonly Edit[];
  /** Behind the line before. */
  readonly lineBefore: readonly Edit[];
  /** Whether the problem is a token that is missing, and another one was found at the start of a line. */
  readonly looksMissing: boolean;
  /** Whether the problem is its token itself. */
  readonly isMalformed: boolean;
}

/** Problems with a token that was expected: it may be missing on the line before. */
const MISSING = /^(number|file|name)-expected$|^brace-missing$|^(extrapolation|order|mode|channel)-unknown$/;

/**
 * The edits that might fix the file where a reader reported a problem.
 * @param lines all of the file's
 * @param problem an error with a line and a column
 */
export function editsAtProblem(lines: TextLines, problem: Diagnostic, { keywords }: TextLayout): EditsAtProblem {
  const { code, message } = problem;
  const found = lines.tokenAt(problem.line, problem.column);
  const sameLine = found ? editsAt(problem, found.tokens, found.index, keywords) : [];
  // At the end of the file, something is missing behind its last token.
  const before = found ? lines.lineBefore(problem.line) : (lines.filled.at(-1) ?? 0);
  const last = before > 0 ? lines.tokens(before).at(-1) : undefined;
  // A word like the last one: where one is missing from a list of them.
  const puts = last?.class === 'w' ? [...TOKENS, lines.text(last)] : TOKENS;
  const lineBefore = last ? puts.map((put) => insertBehind(before, last, put, { code, message })) : [];
  // Some problems point at a keyword whose values are wrong.
  const isNoticed = !found || (found.index === 0 && message.includes(`found ${quoted(lines, found.tokens[0])}`));
  return { sameLine, lineBefore, looksMissing: isNoticed && MISSING.test(code), isMalformed: MALFORMED.test(code) };
}

function editsAt(
  { line, code, message }: Diagnostic,
  tokens: readonly TextToken[],
  index: number,
  keywords: readonly string[],
): readonly Edit[] {
  const what = { code, message };
  const token = tokens[index];
  const edits = [remove(line, token, what), ...TOKENS.map((put) => replace(line, token, put, what))];
  if (index > 0) edits.push(...TOKENS.map((put) => insertBefore(line, token, put, what)));
  else for (const put of keywords) edits.push(insertBefore(line, token, put, what), replace(line, token, put, what));
  edits.push(insertBehind(line, tokens[tokens.length - 1], '0', what));
  for (const beside of [tokens[index - 1], tokens[index + 1]]) if (beside) edits.push(remove(line, beside, what));
  return edits;
}
