/**
 * A median over three, five or seven frames: takes out spikes of up to one, two or three of them, and leaves everything
 * that goes one way for longer the very numbers it was, corners and steps too.
 *
 *     values       out(f) = the middle one of in(f − r) … in(f + r), in order of size
 *     rotations    the one of q(f − r) … q(f + r) with the least sum of angles to the others: the vector median
 *                  (Astola, Haavisto, Neuvo, *Vector median filters*, 1990); about one axis it is the median of the angle
 *
 * So a joint is in a spike's frame as it is in one beside it, never in between. (The rotation nearest to the mean of its
 * neighbours would be drawn towards the spike, which is in that mean; and medians of three angles each by itself make
 * rotations that the joint never had.) Toward its ends the window gets narrower: the first and last frame stay.
 */

export const MEDIAN_FRAMES: readonly number[] = [3, 5, 7];

/** @param reach frames to either side. @returns of each frame the one whose value takes its place */
export function medianFrame(values: Float64Array, frame: number, reach: number): number {
  const r = Math.min(reach, frame, values.length - 1 - frame);
  // The one with as many below it as above; that of the frame itself, where several are the same.
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
 * The same for rotations.
 * @param q x y z w a frame, of length 1; as good as their opposites
 */
export function medianRotation(q: Float64Array, frame: number, reach: number): number {
  const r = Math.min(reach, frame, q.length / 4 - 1 - frame);
  let best = frame;
  let least = Number.POSITIVE_INFINITY;
  for (let n = 0; n <= 2 * r; n++) {
    const f = frame + outwards(n);
    let sum = 0;
    for (let g = frame - r; g <= frame + r; g++) sum += angleBetween(q, 4 * f, 4 * g);
    // Not by what rounding makes of the same sum: then it stays the frame's own.
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

/** 0 … π. By the distance of the quaternions, which is exact where they are close; the cosine isn't. */
function angleBetween(q: Float64Array, a: number, b: number): number {
  let minus = 0;
  let plus = 0;
  for (let n = 0; n < 4; n++) {
    minus += (q[a + n] - q[b + n]) ** 2;
    plus += (q[a + n] + q[b + n]) ** 2;
  }
  return 4 * Math.asin(Math.min(1, Math.sqrt(Math.min(minus, plus)) / 2));
}
