/**
 * Smoothing: a Gaussian over the frames around each, the same to both sides, so that nothing comes later than it did.
 *
 *     out(f) = Σₙ w(n) · in(f + n)      w(n) ∝ exp(−(n·frameSeconds)² / 2σ²), up to 3σ to either side
 *
 * A movement to and fro with period P keeps exp(−2(πσ/P)²) of its height: with σ = 0.05 s 95 % of one a second, 29 % of
 * five a second, less than 1 % of ten. Beyond its ends the curve goes on as its mirror image about the end point, so that
 * ends stay where they are.
 *
 * Joints with three angles are smoothed as rotations: their quaternions are, each on the side of the one before it,
 * and brought back to length and to the angles nearest to those before. Angles by themselves would smear where they
 * jump from 179° to −179° or swing about near gimbal lock, while the joint hardly moves. Single angles are unrolled.
 *
 * (Savitzky–Golay keeps peaks higher for the same window but lets some jitter through with its sign turned; a Gaussian's
 * one number is one that people have a feeling for.)
 */
import { type ChannelClip, isSampled } from '../../model/clip.ts';
import type { CharacterDof } from '../../model/dofs.ts';
import { columnOf } from '../../model/samples.ts';
import { columnValues, withColumns } from './columns.ts';
import { requireSamples } from './frames.ts';
import { anglesOf, type JointRotation, quaternionsOf, unroll } from './rotations.ts';

/** @param rotations of the character's skeleton. @param channels only these; others, and those with keys, stay */
export function smoothed(
  clip: ChannelClip,
  dofs: readonly CharacterDof[],
  rotations: readonly JointRotation[],
  channels: readonly number[],
  sigmaSeconds: number,
): ChannelClip {
  const samples = requireSamples(clip);
  const weights = gaussian(sigmaSeconds / samples.frameSeconds, samples.frameCount);
  const chosen = new Set(channels.filter((channel) => isSampled(clip, channel)));
  const made = new Map<number, Float64Array>();
  const valuesOf = (channel: number) => columnValues(samples, columnOf(samples, channel));
  for (const { channels: triple, axes } of rotations) {
    if (!triple.every((channel) => chosen.has(channel))) continue;
    const [a, b, c] = triple.map(valuesOf);
    smoothRotations(a, b, c, axes, weights);
    [a, b, c].forEach((values, n) => {
      made.set(columnOf(samples, triple[n]), values);
      chosen.delete(triple[n]);
    });
  }
  for (const channel of chosen) {
    const values = valuesOf(channel);
    if (dofs[channel]?.unit === 'angle') unroll(values);
    made.set(columnOf(samples, channel), convolved(values, 1, 0, weights));
  }
  return { ...clip, samples: withColumns(samples, made) };
}

function smoothRotations(
  a: Float64Array,
  b: Float64Array,
  c: Float64Array,
  axes: JointRotation['axes'],
  weights: Float64Array,
): void {
  const q = quaternionsOf([a, b, c], axes);
  const parts = [0, 1, 2, 3].map((n) => convolved(q, 4, n, weights));
  const one = new Float64Array(4);
  for (let f = 0; f < a.length; f++) {
    for (let n = 0; n < 4; n++) one[n] = parts[n][f];
    // The first is nearest to its own angles, the others to those before them.
    const p = Math.max(0, f - 1);
    const [na, nb, nc] = anglesOf(one, 0, axes, a[p], b[p], c[p]);
    a[f] = na;
    b[f] = nb;
    c[f] = nc;
  }
}

/** Weights of the frames n = 0, 1 … to either side; together they come to 1. */
function gaussian(sigmaFrames: number, frameCount: number): Float64Array {
  const reach = Math.min(frameCount - 1, Math.ceil(3 * sigmaFrames));
  const weights = Float64Array.from({ length: reach + 1 }, (_, n) => Math.exp(-(n * n) / (2 * sigmaFrames ** 2)));
  let sum = weights[0];
  for (let n = 1; n <= reach; n++) sum += 2 * weights[n];
  return weights.map((w) => w / sum);
}

/** Every `step`-th of the values from `first` on, convolved. */
function convolved(values: Float64Array, step: number, first: number, weights: Float64Array): Float64Array {
  const count = values.length / step;
  const reach = weights.length - 1;
  // Both ends continued by their mirror images about the end points.
  const long = new Float64Array(count + 2 * reach);
  const at = (f: number) => values[first + f * step];
  for (let f = 0; f < count; f++) long[reach + f] = at(f);
  for (let n = 1; n <= reach; n++) {
    long[reach - n] = 2 * at(0) - at(n);
    long[reach + count - 1 + n] = 2 * at(count - 1) - at(count - 1 - n);
  }
  const out = new Float64Array(count);
  for (let f = 0; f < count; f++) {
    const middle = f + reach;
    let sum = weights[0] * long[middle];
    for (let n = 1; n <= reach; n++) sum += weights[n] * (long[middle - n] + long[middle + n]);
    out[f] = sum;
  }
  return out;
}
