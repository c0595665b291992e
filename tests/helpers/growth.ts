/** How the time of something grows with its size: a ratio of CPU times, the same on a slow or busy machine. */
import { expect } from 'vitest';

/** Four times as much takes four times as long, or sixteen times where it takes the square of it. */
const MAX_GROWTH = 8;
/** Shorter times say more about the clock and the collection of garbage than about what is measured. */
const MIN_MS = 10;
const ATTEMPTS = 5;

/** Fails if `run` takes far longer than four times as long for 4 n as for n, however often it is tried. */
export function expectLinearTime(run: (n: number) => void, n: number, what = 'time of 4 n by that of n'): void {
  let [short, long] = [Infinity, Infinity];
  for (let attempt = 0; attempt < ATTEMPTS; attempt++) {
    short = Math.min(short, Math.max(MIN_MS, milliseconds(run, n)));
    long = Math.min(long, milliseconds(run, 4 * n));
    if (long < MAX_GROWTH * short) return;
  }
  expect(long / short, what).toBeLessThan(MAX_GROWTH);
}

/** Of this process, its other threads included. */
function milliseconds(run: (n: number) => void, n: number): number {
  const before = process.cpuUsage();
  run(n);
  const { user, system } = process.cpuUsage(before);
  return (user + system) / 1000;
}
