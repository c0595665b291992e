/** Numbers that can't be read mostly have one reason, such as a program that writes NaN: one message for all of them. */
import type { Diagnostic } from '../../model/diagnostic.ts';

/** So few are told one by one. */
const FEW = 3;
/** Lines that are named; of others, only the number is told. */
const NAMED = 5;

/** Errors of the same kind at the same place of the grammar, if there are more than a few, become the first of them, with the other lines named. */
export function foldUnreadable(diagnostics: readonly Diagnostic[]): readonly Diagnostic[] {
  const groups = new Map<string, Diagnostic[]>();
  for (const d of diagnostics) {
    if (!isUnreadable(d)) continue;
    const expected = `${d.file}\n${d.severity}\n${d.message.slice(0, d.message.indexOf(', found '))}`;
    const group = groups.get(expected);
    if (group) group.push(d);
    else groups.set(expected, [d]);
  }
  const folded = new Map<Diagnostic, Diagnostic | undefined>();
  for (const [first, ...others] of groups.values()) {
    if (others.length < FEW) continue;
    for (const other of others) folded.set(other, undefined);
    folded.set(first, { ...first, message: `${first.message} ${alsoOn(others)}` });
  }
  return diagnostics.flatMap((d) => (folded.has(d) ? (folded.get(d) ?? []) : d));
}

function isUnreadable({ code, message, line }: Diagnostic): boolean {
  return code === 'not-a-number' && line > 0 && message.includes(', found ');
}

function alsoOn(others: readonly Diagnostic[]): string {
  const lines = [...new Set(others.map(({ line }) => line))].map((line) => line.toLocaleString('en'));
  if (lines.length === 1) return `There are more on line ${lines[0]}.`;
  const left = lines.length - NAMED;
  if (left <= 1) return `There are more on lines ${lines.slice(0, -1).join(', ')} and ${lines.at(-1)}.`;
  return `There are more on lines ${lines.slice(0, NAMED).join(', ')} and ${left.toLocaleString('en')} more.`;
}
