/**
 * A median over three, five or seven frames: removes spikes of up to one, two or three frames, and keeps all monotonic
 * stretches exactly, including corners and steps.
 *
 *     values       out(f) = the median of in(f − r) … in(f + r)
 *     rotations    the one of q(f − r) … q(f + r) with the least sum of angles to the others: the vector median
 *                  (Astola, Haavisto, Neuvo, *Vector median filters*, 1990); about one axis it is the median of the angle
 *
 * So in a spike's frame a joint takes a neighbour's rotation, never one in between. (The rotation nearest to the
 * neighbours' mean would be drawn towards the spike, and separate medians of three angles give rotations that the joint
 * never had.) The window narrows towards the ends: the first and last frame are kept.
 */

/** Windows that a median can have, in frames. */
export const MEDIAN_FRAMES: readonly number[] = [3, 5, 7];

/**
 * The frame with the median of the values around a frame.
 * @param reach frames to either side. @returns for each frame the one whose value replaces it
 */
export function medianFrame(values: Float64Array, frame: number, reach: number): number {
  const r = Math.min(reach, frame, values.length - 1 - frame);
  // The value with as many below as above it; the frame's own if it is among equals.
  for (let n = 0; n <= 2 * r; n++) {
    const f = frame + outwards(n);
    let below = 0;
    let above = 0;
    for (let g = frame - r; g <= frame + r; g++) {
      if (values[g] < values[f]) below++;
      else if (values[g] > values[f]) above++;
    }
    if (below <= r && above <= r) return f;
  }
  return frame;
}

/**
 * The frame with the vector median of the rotations around a frame.
 * @param q x y z w per frame, normalised; signs don't matter
 */
export function medianRotation(q: Float64Array, frame: number, reach: number): number {
  const r = Math.min(reach, frame, q.length / 4 - 1 - frame);
  let best = frame;
  let least = Number.POSITIVE_INFINITY;
  for (let n = 0; n <= 2 * r; n++) {
    const f = frame + outwards(n);
    let sum = 0;
    for (let g = frame - r; g <= frame + r; g++) sum += angleBetween(q, 4 * f, 4 * g);
    // Ignores rounding differences, so that equal sums keep the frame's own.
    if (sum < least - 1e-9) {
      least = sum;
      best = f;
    }
  }
  return best;
}

/** 0, −1, 1, −2, 2 … */
function outwards(n: number): number {
  return n % 2 === 0 ? n / 2 : -(n + 1) / 2;
}

/** 0 … π. From the distance of the quaternions, which is exact for close ones, unlike the cosine. */
function angleBetween(q: Float64Array, a: number, b: number): number {
  let minus = 0;
  let plus = 0;
  for (let n = 0; n < 4; n++) {
    minus += (q[a + n] - q[b + n]) ** 2;
    plus += (q[a + n] + q[b + n]) ** 2;
  }
  return 4 * Math.asin(Math.min(1, Math.sqrt(Math.min(minus, plus)) / 2));
}
