/**
 * Index of the last of `sorted[first … end − 1]` that is not greater than `x`; `first` where all are greater, or `x` is
 * NaN. Of equal entries the last. `end` must be greater than `first`.
 *
 * One comparison a step, whose two outcomes do the same work: half the entries are left, whatever it says.
 */
export function lastNotAbove(sorted: Float64Array, first: number, end: number, x: number): number {
  let low = first;
  let left = end - first;
  while (left > 1) {
    const half = left >>> 1;
    if (sorted[low + half] <= x) low += half;
    left -= half;
  }
  return low;
}

/**
 * Index of the first of the ascending `sorted[first … end − 1]` that is not less than `x`; `end` where all are less. As
 * many of them are below `x`, counted from `first`.
 */
export function firstNotBelow(sorted: ArrayLike<number>, x: number, first = 0, end = sorted.length): number {
  let low = first;
  let high = end;
  while (low < high) {
    const middle = (low + high) >>> 1;
    if (sorted[middle] < x) low = middle + 1;
    else high = middle;
  }
  return low;
}
