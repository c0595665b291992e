/**
 * Index of the last element of `sorted[first … end − 1]` that is not greater than `x`; `first` if all are greater, or
 * `x` is NaN. Of equal elements the last. `end` must be greater than `first`.
 *
 * Branch-free: each step makes one comparison and halves the range whatever its result.
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
 * Index of the first element of the ascending `sorted[first … end − 1]` that is not less than `x`; `end` if all are
 * less. Minus `first`, it is the number of elements below `x`.
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
