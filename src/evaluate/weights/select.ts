/**
 * Hoare's selection: moves the items with the smallest keys of `items[first … last]` before index `middle`, the others
 * to it or after. Bisection in space needs no more order than that.
 * @param keys `keys[3 · item + axis]`
 */
export function selectMiddle(
  items: Uint32Array,
  keys: Float64Array,
  axis: number,
  first: number,
  last: number,
  middle: number,
): void {
  let low = first;
  let high = last;
  while (low < high) {
    const pivot = keys[3 * items[(low + high) >> 1] + axis];
    let i = low;
    let j = high;
    while (i <= j) {
      while (keys[3 * items[i] + axis] < pivot) i++;
      while (keys[3 * items[j] + axis] > pivot) j--;
      if (i > j) break;
      const swapped = items[i];
      items[i++] = items[j];
      items[j--] = swapped;
    }
    if (middle <= j) high = j;
    else if (middle >= i) low = i;
    else return;
  }
}

/** The axis along which some points extend farthest: 0, 1 or 2. @param keys x y z of each item */
export function longestAxis(items: Uint32Array, keys: Float64Array, first: number, last: number): number {
  let best = 0;
  let length = -1;
  for (let axis = 0; axis < 3; axis++) {
    let low = Infinity;
    let high = -Infinity;
    for (let i = first; i <= last; i++) {
      const key = keys[3 * items[i] + axis];
      if (key < low) low = key;
      if (key > high) high = key;
    }
    if (high - low > length) {
      length = high - low;
      best = axis;
    }
  }
  return best;
}
