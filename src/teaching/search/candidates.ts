/** Mistakes of the catalogue as programs that make them, one or two at a time. */
import type { Mistake, Variant } from '../catalogue/mistake.ts';
import { type Program, RIGHT_PROGRAM } from '../program/program.ts';

/** One way to make a mistake. */
export interface Candidate {
  readonly mistake: Mistake;
  readonly variant: Variant;
  readonly program: Program;
  /** The rules that it changes: `joints order`. */
  readonly rules: ReadonlySet<string>;
}

/** The right program with one mistake. */
export function candidateOf(mistake: Mistake, variant: Variant): Candidate {
  const program = variant.apply(RIGHT_PROGRAM);
  const rules = new Set<string>();
  for (const group of ['joints', 'skin', 'curves'] as const) {
    const [now, right] = [program[group], RIGHT_PROGRAM[group]];
    if (now === right) continue;
    const before = new Map(Object.entries(right));
    for (const [rule, value] of Object.entries(now)) if (before.get(rule) !== value) rules.add(`${group} ${rule}`);
  }
  return { mistake, variant, program, rules };
}

/** A program with both mistakes; two where their order matters, none where one replaces the other. */
export function bothOf(a: Candidate, b: Candidate): readonly Program[] {
  const shared = [...a.rules].filter((rule) => b.rules.has(rule));
  // Curves are kept by identity, so the program of the one that changes them is the first.
  const [first, second] = b.program.curves !== RIGHT_PROGRAM.curves ? [b, a] : [a, b];
  const program = second.variant.apply(first.program);
  if (shared.length === 0) return [program];
  return shared.every((rule) => rule === 'joints world') ? [program, first.variant.apply(second.program)] : [];
}
