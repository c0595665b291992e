/**
 * A symmetric Gaussian over the surrounding frames, so that nothing is delayed.
 *
 *     out(f) = Σₙ w(n) · in(f + n)      w(n) ∝ exp(−n² / 2σ²), σ in frames, up to 3σ to either side
 *
 * Beyond its ends the curve is continued by its mirror image about the end point, so that ends stay in place.
 */

/** Additions between two yields: the cost per frame is the filter's width. */
const STEP_TERMS = 1 << 21;

/** Weights of the frames n = 0, 1 … to either side; they sum to 1. */
export function gaussian(sigmaFrames: number, frameCount: number): Float64Array {
  const reach = Math.min(frameCount - 1, Math.ceil(3 * sigmaFrames));
  // Divided before squaring, since the square of a tiny σ is 0.
  const weights = Float64Array.from({ length: reach + 1 }, (_, n) =>
    n === 0 ? 1 : Math.exp(-0.5 * (n / sigmaFrames) ** 2),
  );
  let sum = weights[0];
  for (let n = 1; n <= reach; n++) sum += 2 * weights[n];
  return weights.map((w) => w / sum);
}

/** Every `step`-th of the values from `first` on, convolved into `out`. Yields every few milliseconds. */
export function* convolving(
  values: Float64Array,
  step: number,
  first: number,
  weights: Float64Array,
  out: Float64Array,
): Generator<void> {
  const count = out.length;
  const reach = weights.length - 1;
  // Both ends are continued by their mirror images about the end points, and by constants where the filter is longer.
  const long = new Float64Array(count + 2 * reach);
  const at = (f: number) => values[first + Math.min(count - 1, Math.max(0, f)) * step];
  for (let f = 0; f < count; f++) long[reach + f] = at(f);
  for (let n = 1; n <= reach; n++) {
    long[reach - n] = 2 * at(0) - at(n);
    long[reach + count - 1 + n] = 2 * at(count - 1) - at(count - 1 - n);
  }
  const frames = Math.ceil(STEP_TERMS / weights.length);
  for (let from = 0; from < count; from += frames) {
    convolve(long, weights, out, from, Math.min(count, from + frames));
    yield;
  }
}

function convolve(long: Float64Array, weights: Float64Array, out: Float64Array, from: number, to: number): void {
  const reach = weights.length - 1;
  for (let f = from; f < to; f++) {
    const middle = f + reach;
    let sum = weights[0] * long[middle];
    for (let n = 1; n <= reach; n++) sum += weights[n] * (long[middle - n] + long[middle + n]);
    out[f] = sum;
  }
}
