/** Keeps what gave way, with the arguments that did it. */
import type { Attempt } from '../attack.ts';
import { type End, faultsOf } from './process.ts';

/** Counts a try of the command. @param faults besides those of how it ended */
export function tell(attempt: Attempt, args: readonly string[], ended: End, faults: readonly string[]): void {
  attempt.tried();
  const all = [...faultsOf(ended), ...faults];
  if (all.length === 0) return;
  const content = JSON.stringify({ args, faults: all, err: ended.err.slice(0, 3000) }, null, 2);
  attempt.gaveWay(`${all.slice(0, 4).join('; ')}: marrow ${args.join(' ').slice(0, 300)}`, {
    extension: 'json',
    content,
  });
}
