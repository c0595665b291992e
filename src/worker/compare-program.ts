/** The `compare` job: another program's numbers in, where they are wrong and why out. */
import { type Steps, within } from '../evaluate/steps.ts';
import { compare } from '../teaching/compare/compare.ts';
import { DEFAULT_TOLERANCE } from '../teaching/compare/errors.ts';
import { assumeTime } from '../teaching/dump/assumed-times.ts';
import { fitDumps, type NamedDump } from '../teaching/dump/fit-dump.ts';
import type { CompareInput, CompareOutput, Progress } from './protocol.ts';

/** Progress messages of a whole search. */
const PROGRESS_STEPS = 100;
/** Part of the work, if times are to be decided. */
const DECIDING = 0.5;

export function compareDumps(input: CompareInput, onProgress: (progress: Progress) => void): CompareOutput {
  const steps = compareSteps(input);
  let told = -1;
  let step = steps.next();
  for (; !step.done; step = steps.next()) {
    const done = Math.floor(PROGRESS_STEPS * step.value);
    if (done > told) onProgress({ label: 'Comparing', done, of: PROGRESS_STEPS });
    told = Math.max(told, done);
  }
  return step.value;
}

function* compareSteps({
  character,
  dumps,
  undecided = [],
  tolerance = DEFAULT_TOLERANCE,
}: CompareInput): Steps<CompareOutput> {
  const timed: NamedDump[] = [];
  for (const dump of dumps) {
    const isDecided = dump.assumed?.time === undefined || !undecided.includes(dump.fileName);
    const from = (DECIDING * timed.length) / dumps.length;
    const to = from + DECIDING / dumps.length;
    const times = [dump.assumed?.time, undefined];
    timed.push(isDecided ? dump : yield* within(assumeTime(character, dump, times, tolerance), from, to));
  }
  const inFilePose = timed.filter((dump, i) => dump !== dumps[i] && dump.assumed?.time === undefined);
  const names = inFilePose.map(({ fileName }) => fileName);
  const { targets, diagnostics } = fitDumps(character, timed, undefined);
  if (!targets) return { diagnostics, inFilePose: names };
  const begun = timed.some((dump, i) => dump !== dumps[i]) ? DECIDING : 0;
  const comparison = yield* within(compare(character, targets, tolerance), begun, 1);
  return { comparison, targets, inFilePose: names, diagnostics };
}
