/** Index of the first number that is not finite; -1 if all are. */
export function firstNotFinite(values: ArrayLike<number>): number {
  // Finite minus itself is 0; of infinities and NaN it is NaN.
  for (let i = 0; i < values.length; i++) if (values[i] - values[i] !== 0) return i;
  return -1;
}
