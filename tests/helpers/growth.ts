/** How the time of something grows with its size: a ratio of CPU times, the same on a slow or busy machine. */
import { expect } from 'vitest';

/** Four times as much takes four times as long, or sixteen times where it takes the square of it. */
const MAX_GROWTH = 8;
/** Shorter times say more about the clock and the collection of garbage than about what is measured. */
const MIN_MS = 10;
const ATTEMPTS = 4;

/**
 * Fails if `run` takes far longer than four times as long for 4 n as for n. Where it seems to, it is tried with twice as
 * much: what the clock and the garbage add is less of it then, and what grows with the square still does.
 */
export function expectLinearTime(run: (n: number) => void, n: number, what = 'time of 4 n by that of n'): void {
  let growth = Infinity;
  for (let attempt = 0; attempt < ATTEMPTS && growth >= MAX_GROWTH; attempt++) {
    const size = n * 2 ** attempt;
    const short = Math.max(MIN_MS, milliseconds(run, size));
    growth = milliseconds(run, 4 * size) / short;
  }
  expect(growth, what).toBeLessThan(MAX_GROWTH);
}

/** Of this process, its other threads included. */
function milliseconds(run: (n: number) => void, n: number): number {
  const before = process.cpuUsage();
  run(n);
  const { user, system } = process.cpuUsage(before);
  return (user + system) / 1000;
}
