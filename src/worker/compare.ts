/** The `compare` job: another program's numbers in, where they are wrong and why out. */
import { compare } from '../lesson/compare.ts';
import { fitDumps } from '../lesson/fit-dump.ts';
import type { CompareInput, CompareOutput, Progress } from './protocol.ts';

/** Progress messages of a whole search. */
const PROGRESS_STEPS = 100;

export function compareDumps(
  { character, dumps, tolerance }: CompareInput,
  onProgress: (progress: Progress) => void,
): CompareOutput {
  const { targets, diagnostics } = fitDumps(character, dumps, undefined);
  if (!targets) return { diagnostics };
  const steps = compare(character, targets, tolerance);
  let told = -1;
  let step = steps.next();
  for (; !step.done; step = steps.next()) {
    const done = Math.floor(PROGRESS_STEPS * step.value);
    if (done > told) onProgress({ label: 'Comparing', done, of: PROGRESS_STEPS });
    told = Math.max(told, done);
  }
  return { comparison: step.value, targets, diagnostics };
}
