/**
 * Where a value jumps, as from the last key of a cycle to its first or between two keys at one time, a time that is off
 * by rounding is on the other side. So a number there is right if it is that of either side: ours is the nearer one.
 */

/** Rounding of times that are computed in doubles and added up. */
const ROUNDING = 1e-9;
/** Digits of a float. */
const FLOAT_DIGITS = 7;
const FLOAT_EPSILON = 2 ** -23;

/** The times on either side of a time, as far as it may be off. A time of up to seven digits may be a float's. */
export function sidesOf(time: number): readonly [before: number, after: number] {
  const isFloat = Number(time.toPrecision(FLOAT_DIGITS)) === time;
  const rounding = isFloat ? Math.max(ROUNDING, FLOAT_EPSILON * Math.abs(time)) : ROUNDING;
  return [time - rounding, time + rounding];
}

/** Whether a time is another or may be on either side of it, the other being off by rounding, too. */
export function mayBeSame(time: number, other: number): boolean {
  return Math.abs(time - other) <= 2 * Math.max(ROUNDING, FLOAT_EPSILON * Math.abs(other));
}

/** The value at a time, or, where that differs from theirs, on the side that is nearest theirs. */
export function nearestSide(
  time: number,
  theirs: number,
  tolerance: number,
  valueAt: (time: number) => number,
): number {
  let nearest = valueAt(time);
  if (Math.abs(nearest - theirs) <= tolerance) return nearest;
  for (const side of sidesOf(time)) {
    const value = valueAt(side);
    if (Math.abs(value - theirs) < Math.abs(nearest - theirs)) nearest = value;
  }
  return nearest;
}
