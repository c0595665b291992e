/**
 * Diagnostics as text:
 *
 *     wasp.skel:12:9 error number-expected: Expected a number, found "1,5".
 *         offset 0 1,5 0
 *                ^
 */
import type { Diagnostic } from '../model/diagnostic.ts';
import type { CommandIo } from './io.ts';
import { printable, printableLine } from './printable.ts';

export function report(diagnostics: readonly Diagnostic[], io: Pick<CommandIo, 'err'>): void {
  for (const diagnostic of diagnostics) io.err(`${describe(diagnostic)}\n`);
}

/** Without a trailing newline. */
export function describe({ file, line, column, severity, code, message, assumed, excerpt }: Diagnostic): string {
  const place = [file, line, column].slice(0, line > 0 ? (column > 0 ? 3 : 2) : 1).join(':');
  let text = printableLine(
    `${place && `${place} `}${severity} ${code}: ${message}${assumed === undefined ? '' : ` (${assumed})`}`,
  );
  if (excerpt) {
    // Tabs are kept, so that the caret is below its character whatever their width.
    const indent = excerpt.text.slice(0, excerpt.caret).replace(/[^\t]/g, ' ');
    text += `\n    ${excerpt.text}\n    ${indent}^`;
  }
  return printable(text);
}

/** Prints a result: one line of JSON. */
export function printJson(value: unknown, io: CommandIo): Promise<void> {
  return io.out(`${JSON.stringify(value)}\n`);
}
