/**
 * Where the error of a file really is.
 *
 * A reader that takes no notice of line ends and indentation tells of an error where it can't continue, which may be
 * far from it: without one number of line 51, the last row of the block is short. So once a file has problems, its
 * lines are looked at, as a person would: which row is shorter than its neighbours, which line is unlike all similar
 * ones, where braces contradict the indentation, which token at the problem could be missing or too many.
 *
 * Each guess is an edit that might fix the file, and is put to the test: the edited file is read again. The guess
 * after which the fewest problems are left is taken. These don't follow from the error; all others do, and are left
 * out. If no guess explains anything, the problems stay as they were told.
 */

import { type Diagnostic, hasErrors, MAX_KEPT } from '../../model/diagnostic.ts';
import { cutMessage } from '../../model/names/cut-text.ts';
import { type Reader, readWhole } from '../reader.ts';
import { edited } from './edit.ts';
import { type Guess, guesses } from './guesses.ts';
import { otherKind } from './kinds.ts';
import type { TextKind, TextLayout } from './layouts.ts';
import { TextLines } from './text-lines.ts';

/** Errors found one after the other. */
const MAX_ERRORS = 8;
/** Bytes read again in all, and for files that were loaded. */
const BUDGET = 256e6;
const BUDGET_IF_LOADED = 32e6;
/** Readings of the whole file; and where it has more problems than are kept, each of which takes its time again. */
const MAX_READINGS = 32;
const MAX_IF_MANY = 8;
/** Small files may be read more often than that. */
const ALWAYS = 8e6;
/** Larger files keep the problems as told. */
const LARGEST = 128e6;
const LARGEST_IF_LOADED = 16e6;

/** Problems that name their own place, and that nothing follows from. */
const PLAIN = new Set([
  ...['weights-sum', 'attachments-missing', 'limits-crossed', 'limits-not-taken', 'keys-unsorted', 'keys-at-one-time'],
  ...['range-reversed', 'range-missing', 'frame-time', 'index-repeated', 'index-mismatch', 'name-unexpected'],
]);

/** Told of files whose reader goes by lines: their problems are where they are told. */
const BY_LINES = 'parent-rows';

/** Problems with what numbers mean: one that is only put in for a missing one may be of any meaning. */
const OF_MEANING = new Set([
  ...PLAIN,
  ...['index-fractional', 'index-out-of-range', 'binding-singular', 'axis-zero', 'length-negative', 'pose-too-long'],
]);

/** Whether a file of this size has problems that may be elsewhere than they are told. */
export function isWorthDiagnosing(told: readonly Diagnostic[], byteLength: number): boolean {
  if (hasErrors(told)) return byteLength > 0 && byteLength <= LARGEST;
  return byteLength <= LARGEST_IF_LOADED && told.some((d) => d.severity === 'warning' && !PLAIN.has(d.code));
}

/** A guess that was put to the test. */
interface Trial {
  readonly guess: Guess;
  /** As edited. */
  readonly text: Uint8Array;
  /** Diagnostics of that text. */
  readonly after: readonly Diagnostic[];
  /** Problems that it leaves; fewer are better. */
  readonly cost: number;
}

/**
 * The problems of a file, each at its place, without what follows from others.
 *
 * @param told by the first reading
 * @param reader makes a new reader for the same file
 */
export function diagnose(
  bytes: Uint8Array,
  told: readonly Diagnostic[],
  layout: TextLayout,
  reader: () => Reader<unknown>,
): readonly Diagnostic[] {
  if (told.some(({ code }) => code === BY_LINES)) return told;
  const isLoaded = !hasErrors(told);
  let lines = new TextLines(bytes);
  const other = ofOtherKind(lines, layout.kind, told, isLoaded);
  if (other) return [other];
  const { length } = bytes;
  const readings = told.length > MAX_KEPT ? MAX_IF_MANY * length : Math.max(ALWAYS, MAX_READINGS * length);
  let budget = Math.min(isLoaded ? BUDGET_IF_LOADED : BUDGET, readings);
  const read = (text: Uint8Array) => {
    budget -= text.length;
    return readWhole(reader(), text).diagnostics;
  };
  const found: Diagnostic[] = [];
  /** Lines that are dealt with. */
  const done = new Set<number>();
  let text = bytes;
  let rest = told;
  for (let round = 0; round < MAX_ERRORS; round++) {
    const problems = problemsOf(rest, done);
    if (problems.length === 0) break;
    if (round > 0) lines = new TextLines(text);
    let best: Trial | undefined;
    for (const guess of guesses(lines, problems, layout)) {
      if (budget <= 0 || best?.cost === 0) break;
      const trial = tried(guess, text, rest, done, isLoaded, read);
      if (trial && (!best || trial.cost < best.cost)) best = trial;
    }
    if (!best || best.guess.edits.length === 0) break;
    for (const line of best.guess.lines) {
      found.push(ofLine(lines, line, rest, best.guess, isLoaded));
      done.add(line);
    }
    text = best.text;
    rest = best.after;
  }
  if (found.length === 0) return firstOfLines(told);
  const isElsewhere = (d: Diagnostic) => !done.has(d.line);
  const others = rest.filter(isElsewhere).filter((d) => d.severity !== 'info');
  // What was loaded is told as it was, and of what wasn't only what has a place.
  const ofRest = () => rest.filter((d) => d.line > 0 && isElsewhere(d));
  const infos = (isLoaded ? told : ofRest()).filter((d) => d.severity === 'info');
  const all = [...found, ...others, ...infos];
  if (!isLoaded && !hasErrors(all)) all[0] = asError(all[0]);
  return firstOfLines(all.sort(byPlace));
}

/** Undefined if the guess explains nothing, or makes it worse. */
function tried(
  guess: Guess,
  text: Uint8Array,
  rest: readonly Diagnostic[],
  done: ReadonlySet<number>,
  isLoaded: boolean,
  read: (text: Uint8Array) => readonly Diagnostic[],
): Trial | undefined {
  const isOn = (d: Diagnostic) => guess.lines.has(d.line);
  if ([...guess.lines].some((line) => done.has(line))) return undefined;
  const before = problemsOf(rest, done).filter((d) => !isOn(d)).length;
  if (guess.edits.length === 0) return { guess, text, after: rest, cost: before };
  if (before === 0) return undefined;
  const known = new Set(rest.map(keyOf));
  const mended = edited(text, guess.edits);
  const after = read(mended).filter((d) => !OF_MEANING.has(d.code) || known.has(keyOf(d)));
  const left = problemsOf(after, done).filter((d) => !isOn(d) || !OF_MEANING.has(d.code));
  const errors = left.filter(({ severity }) => severity === 'error');
  if (errors.some(isOn) || (isLoaded && errors.length > 0)) return undefined;
  // Reading now ends before it did: the edit hides the problems with the rest of the file.
  const first = Math.min(...rest.filter((d) => d.severity === 'error' && d.line > 0).map(({ line }) => line));
  if (errors.some((d) => d.line > 0 && d.line < first && !known.has(keyOf(d)))) return undefined;
  // Errors that were not there before: more likely, the edit hides part of the file.
  // Where all braces agreed, an edit that opens a block to the end of the file only hides what is in it.
  const isOfBraces = ({ code }: Diagnostic) => code === 'brace-missing' || code === 'brace-unexpected';
  if (errors.some(isOfBraces) && !rest.some(isOfBraces)) return undefined;
  const cost = left.length + errors.filter((d) => !known.has(keyOf(d))).length;
  return cost < before ? { guess, text: mended, after, cost } : undefined;
}

/** From the top of the file to the bottom, then those without a place. */
function byPlace(a: Diagnostic, b: Diagnostic): number {
  const line = (d: Diagnostic) => d.line || Number.MAX_SAFE_INTEGER;
  return line(a) - line(b) || a.column - b.column;
}

/** Keeps only the first error of several problems of a line: the others mostly follow from it. */
function firstOfLines(all: readonly Diagnostic[]): readonly Diagnostic[] {
  const errors = new Map<number, Diagnostic>();
  for (const d of all) if (d.severity === 'error' && d.line > 0 && !errors.has(d.line)) errors.set(d.line, d);
  return all.filter((d) => d.severity === 'info' || (errors.get(d.line) ?? d) === d);
}

function keyOf({ code, line }: Diagnostic): string {
  return `${code} ${line}`;
}

/** That a file is of another kind than its extension says: then nothing else about it is worth telling. */
function ofOtherKind(
  lines: TextLines,
  own: TextKind,
  [told]: readonly Diagnostic[],
  isLoaded: boolean,
): Diagnostic | undefined {
  const other = otherKind(lines, own);
  const [first] = lines.filled;
  if (!other || !told || first === undefined) return undefined;
  const message = `This looks like a .${other} file, not a .${own}. Change its extension to .${other} and open it again.`;
  const place = lines.at(lines.head(first).start);
  return {
    severity: isLoaded ? 'warning' : 'error',
    code: 'other-kind',
    message,
    file: told.file,
    ...place,
    ...(isLoaded && { assumed: `read as .${own}` }),
  };
}

/** Errors and warnings elsewhere than on the lines that are dealt with. */
function problemsOf(diagnostics: readonly Diagnostic[], done: ReadonlySet<number>): readonly Diagnostic[] {
  return diagnostics.filter((d) => d.severity !== 'info' && !done.has(d.line));
}

/** The problem on an edited line: as it was reported, or as guessed. */
function ofLine(
  lines: TextLines,
  line: number,
  told: readonly Diagnostic[],
  { edits }: Guess,
  isLoaded: boolean,
): Diagnostic {
  const own = told.filter((d) => d.line === line && d.severity !== 'info');
  const known = own.find(({ severity }) => severity === 'error') ?? own[0];
  if (known) return known;
  const edit = edits.find((e) => e.line === line) ?? edits[0];
  const [first] = told;
  // A reader that noticed on the next line knows better what is missing.
  const noticed = told.find((d) => d.code === edit.code && d.line === lines.lineAfter(line));
  const { assumed } = told.find((d) => d.severity === 'warning' && d.assumed !== undefined) ?? {};
  return {
    severity: isLoaded ? 'warning' : 'error',
    code: edit.code,
    message: cutMessage(noticed?.message ?? edit.message),
    file: first.file,
    ...lines.at(edit.at),
    ...(isLoaded && assumed !== undefined && { assumed }),
  };
}

function asError({ assumed: _, ...problem }: Diagnostic): Diagnostic {
  return { ...problem, severity: 'error' };
}
