/** What a person is told about a file: what was found, what was expected, where, and what was assumed. */
export interface Diagnostic {
  readonly severity: Severity;
  /** Stable and lower-case, such as `number-expected`: tests, scripts and teachers key on it. */
  readonly code: string;
  /** A sentence: what was expected and what was found. */
  readonly message: string;
  /** The file's name as given, without folders. */
  readonly file: string;
  /** From 1; 0 when the problem has no place in the file (an empty file, a part that was not given). */
  readonly line: number;
  /** From 1, in characters; 0 as above. */
  readonly column: number;
  /** How loading went on, where it did: "used 3". */
  readonly assumed?: string;
  /** The offending line, cut to 200 characters. */
  readonly excerpt?: Excerpt;
}

/**
 * - `error`: the file is not loaded and the document stays as it was.
 * - `warning`: it is loaded, with something assumed.
 * - `info`: worth knowing.
 */
export type Severity = 'error' | 'warning' | 'info';

export interface Excerpt {
  readonly text: string;
  /** Where in `text` the caret stands, from 0. */
  readonly caret: number;
}

/** A diagnostic of a file as a whole, or of one that could not be read. */
export function withoutPlace(
  severity: Severity,
  code: string,
  message: string,
  file: string,
  assumed?: string,
): Diagnostic {
  return { severity, code, message, file, line: 0, column: 0, ...(assumed !== undefined && { assumed }) };
}

export function hasErrors(diagnostics: readonly Diagnostic[]): boolean {
  return diagnostics.some((d) => d.severity === 'error');
}
