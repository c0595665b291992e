/** The problems of a file by line, for its margin. */
import type { Diagnostic, Severity } from '../../../model/diagnostic.ts';

const RISING: readonly Severity[] = ['info', 'warning', 'error'];

/** The worst one of each line. */
export function worstFirst(diagnostics: readonly Diagnostic[]): ReadonlyMap<number, Diagnostic> {
  const byLine = new Map<number, Diagnostic>();
  for (const found of diagnostics) {
    const known = byLine.get(found.line);
    if (!known || RISING.indexOf(found.severity) > RISING.indexOf(known.severity)) byLine.set(found.line, found);
  }
  return byLine;
}
