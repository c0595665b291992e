/** Explanations of a file's errors, the likeliest first. */
import type { Diagnostic } from '../../model/diagnostic.ts';
import { editsAtProblem } from './at-problem.ts';
import { bracesByIndent } from './braces.ts';
import type { Edit } from './edit.ts';
import type { TextLayout } from './layouts.ts';
import { irregularRows } from './rows.ts';
import { irregularShapes, isUsual } from './shapes.ts';
import type { TextLines } from './text-lines.ts';

const MAX_ROWS = 20;
const MAX_SHAPES = 24;
/** Problems whose tokens are tried. */
const MAX_PROBLEMS = 3;

/** One explanation of an error: where the file may be wrong, and what would fix it. */
export interface Guess {
  /** Edits that might fix the file. None: the problem is where it was told. */
  readonly edits: readonly Edit[];
  /** The lines of the edits, or of the problem. */
  readonly lines: ReadonlySet<number>;
}

/**
 * Explanations of a file's errors, one after the other, the likeliest first.
 * @param problems of which the first one is explained, at least one
 */
export function* guesses(lines: TextLines, problems: readonly Diagnostic[], layout: TextLayout): Generator<Guess> {
  const [first] = problems;
  // On the line of the first problem before others.
  const onLineFirst = (edits: readonly Edit[]) =>
    [...edits].sort((a, b) => Number(b.line === first.line) - Number(a.line === first.line));
  const rows = irregularRows(lines, layout, MAX_ROWS);
  yield* onLineFirst(rows.flat()).map(oneEdit);
  if (rows.length > 1) yield { edits: rows.map(([edit]) => edit), lines: new Set(rows.map(([{ line }]) => line)) };
  yield* onLineFirst(irregularShapes(lines, MAX_SHAPES)).map(oneEdit);
  yield* bracesByIndent(lines).map(oneEdit);

  const told = problems.filter(({ line }) => line > 0).slice(0, MAX_PROBLEMS);
  const atProblems = told.map((problem) => editsAtProblem(lines, problem, layout));
  for (const { lineBefore, looksMissing } of atProblems) if (looksMissing) yield* lineBefore.map(oneEdit);
  // A line like others is hardly wrong, so the one before it more likely is.
  const isInnocent = atProblems[0]?.isMalformed === false && told[0] === first && isUsual(lines, first.line);
  const stay: Guess = { edits: [], lines: new Set([first.line]) };
  if (!isInnocent) {
    yield stay;
    for (const { sameLine } of atProblems) yield* sameLine.map(oneEdit);
  }
  for (const { lineBefore, looksMissing } of atProblems) if (!looksMissing) yield* lineBefore.map(oneEdit);
  if (isInnocent) {
    yield stay;
    for (const { sameLine } of atProblems) yield* sameLine.map(oneEdit);
  }
}

function oneEdit(edit: Edit): Guess {
  return { edits: [edit], lines: new Set([edit.line]) };
}
