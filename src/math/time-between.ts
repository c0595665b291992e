/**
 * A time between two, `part` from 0 to 1. Both ends are exact, and the length of the range, which may be beyond all
 * numbers, isn't needed.
 */
export function timeBetween(start: number, end: number, part: number): number {
  return part === 1 ? end : start * (1 - part) + end * part;
}
