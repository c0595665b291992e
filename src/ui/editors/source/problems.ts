/** The problems of a file by line, for its margin. */
import type { Diagnostic, Severity } from '../../../model/diagnostic.ts';
import { type LineHunk, lineNow } from '../../../model/text-changes.ts';

const RISING: readonly Severity[] = ['info', 'warning', 'error'];

/** The worst one of each line. */
function worstFirst(diagnostics: readonly Diagnostic[]): ReadonlyMap<number, Diagnostic> {
  const byLine = new Map<number, Diagnostic>();
  for (const found of diagnostics) {
    const known = byLine.get(found.line);
    if (!known || RISING.indexOf(found.severity) > RISING.indexOf(known.severity)) byLine.set(found.line, found);
  }
  return byLine;
}

/**
 * Those of a file, at their lines in a text with changes; what was changed has none.
 *
 * @param name of the file, as they name it; undefined: no file
 * @param hunks of the text
 */
export function problemsIn(
  diagnostics: readonly Diagnostic[],
  name: string | undefined,
  hunks: readonly LineHunk[],
): ReadonlyMap<number, Diagnostic> {
  const inFile = diagnostics.filter(({ file, line }) => file === name && line > 0);
  const shown = inFile.flatMap((found) => {
    const line = lineNow(hunks, found.line);
    return line === undefined ? [] : [{ ...found, line }];
  });
  return worstFirst(shown);
}
