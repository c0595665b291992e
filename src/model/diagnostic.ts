import { cutMessage } from './names/cut-text.ts';

/** A message to the user about a file: what was found, what was expected, where, and what was assumed. */
export interface Diagnostic {
  readonly severity: Severity;
  /** Stable and lower-case, such as `number-expected`; tests, scripts and teachers rely on it. */
  readonly code: string;
  /** A sentence: what was expected and what was found. Words and names of any length in it are cut. */
  readonly message: string;
  /** The file's name as given, without folders. */
  readonly file: string;
  /** From 1; 0 if the problem has no position in the file (an empty file, a missing part). */
  readonly line: number;
  /** From 1, in characters; 0 as for `line`. */
  readonly column: number;
  /** The value that was used instead, if loading continued: "used 3". */
  readonly assumed?: string;
  /**
   * Name of a file that was not given, without folders: this is over once the character that has `file` has that one,
   * too.
   */
  readonly missing?: string;
  /** The offending line, cut to 200 characters. */
  readonly excerpt?: Excerpt;
}

/**
 * - `error`: the file is not loaded and the document is unchanged.
 * - `warning`: the file is loaded, with an assumption.
 * - `info`: worth knowing.
 */
export type Severity = 'error' | 'warning' | 'info';

/** Number kept for each severity and file; others are only counted. */
export const MAX_KEPT = 100;

/** About those of a severity that were not kept: nothing if there are none. @param found how many there were in all */
export function moreThanKept(severity: Severity, found: number, file: string): readonly Diagnostic[] {
  if (found <= MAX_KEPT) return [];
  const what = severity === 'info' ? 'remarks' : `${severity}s`;
  return [withoutPlace(severity, `more-${what}`, `And ${found - MAX_KEPT} more ${what}.`, file)];
}

/** A line of a file as it is shown under a message, with the place of the problem. */
export interface Excerpt {
  readonly text: string;
  /** Position of the caret in `text`, from 0. */
  readonly caret: number;
}

/** A diagnostic about a whole file, or about one that could not be read. */
export function withoutPlace(
  severity: Severity,
  code: string,
  message: string,
  file: string,
  assumed?: string,
): Diagnostic {
  const used = assumed !== undefined && { assumed: cutMessage(assumed) };
  return { severity, code, message: cutMessage(message), file, line: 0, column: 0, ...used };
}

/** Whether at least one of the diagnostics is an error, so that the file is not loaded. */
export function hasErrors(diagnostics: readonly Diagnostic[]): boolean {
  return diagnostics.some((d) => d.severity === 'error');
}
