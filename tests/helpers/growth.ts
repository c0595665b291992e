/** How CPU time grows with size: a ratio, so the same on slow or busy machines. */
import { expect } from 'vitest';

/** Four times the size takes four times the time, or sixteen times if it is quadratic. */
const MAX_GROWTH = 8;
/** Shorter times measure the clock and garbage collection instead. */
const MIN_MS = 10;
const ATTEMPTS = 4;

/**
 * Fails if `run` takes far more than four times as long for 4 n as for n. It then retries with twice the size: clock
 * and garbage weigh less, while quadratic growth remains.
 */
export function expectLinearTime(run: (n: number) => void, n: number, what = 'time of 4 n by that of n'): void {
  let growth = Infinity;
  for (let attempt = 0; attempt < ATTEMPTS && growth >= MAX_GROWTH; attempt++) {
    const size = n * 2 ** attempt;
    const long = milliseconds(run, 4 * size);
    // Whatever the shorter time is, it counts as no less than this.
    if (long < MAX_GROWTH * MIN_MS) return;
    const short = Math.max(MIN_MS, milliseconds(run, size));
    growth = long / short;
    // The first run may have been compiled on the way.
    if (growth >= MAX_GROWTH) growth = milliseconds(run, 4 * size) / short;
  }
  expect(growth, what).toBeLessThan(MAX_GROWTH);
}

/** CPU time of this process, including its other threads. */
function milliseconds(run: (n: number) => void, n: number): number {
  const before = process.cpuUsage();
  run(n);
  const { user, system } = process.cpuUsage(before);
  return (user + system) / 1000;
}
