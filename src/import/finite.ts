/** Index of the first number that is not finite; -1 if all are. */
export function firstNotFinite(values: ArrayLike<number>): number {
  let sum = 0;
  // Infinities and NaN times 0 are NaN, and so is any sum with one.
  for (let i = 0; i < values.length; i++) sum += values[i] * 0;
  if (sum === 0) return -1;
  for (let i = 0; i < values.length; i++) if (values[i] - values[i] !== 0) return i;
  return -1;
}
