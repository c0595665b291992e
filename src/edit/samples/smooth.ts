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
import { replacingColumns, takingColumns } from './columns.ts';
import { requireSamples } from './frames.ts';
import { anglesOf, type JointRotation, putQuaternions, unroll } from './rotations.ts';
import { type Steps, within } from './steps.ts';

/** From where to where the work is filtering: columns are taken out before it, and put back after it. */
const FILTERING = [0.05, 0.9] as const;
/** Frames from one pause to the next where a frame costs a few sines. */
const STEP_FRAMES = 1 << 14;
/** The same for the filter, whose frames cost as much as it is wide: additions. */
const STEP_TERMS = 1 << 21;

/** @param rotations of the character's skeleton. @param channels only these; others, and those with keys, stay */
export function* smoothing(
  clip: ChannelClip,
  dofs: readonly CharacterDof[],
  rotations: readonly JointRotation[],
  channels: readonly number[],
  sigmaSeconds: number,
): Steps<ChannelClip> {
  const samples = requireSamples(clip);
  const weights = gaussian(sigmaSeconds / samples.frameSeconds, samples.frameCount);
  const chosen = new Set(channels.filter((channel) => isSampled(clip, channel)));
  const count = Math.max(1, chosen.size);
  const made = new Map<number, Float64Array>();
  const columns = [...chosen].map((channel) => columnOf(samples, channel));
  const taken = yield* within(takingColumns(samples, columns), 0, FILTERING[0]);
  const valuesOf = (channel: number) => taken.get(columnOf(samples, channel)) ?? new Float64Array(0);
  const progress = () => FILTERING[0] + ((FILTERING[1] - FILTERING[0]) * made.size) / count;
  for (const { channels: triple, axes } of rotations) {
    if (!triple.every((channel) => chosen.has(channel))) continue;
    const [a, b, c] = triple.map(valuesOf);
    yield progress();
    for (const _ of smoothRotations(a, b, c, axes, weights)) yield progress();
    [a, b, c].forEach((values, n) => {
      made.set(columnOf(samples, triple[n]), values);
      chosen.delete(triple[n]);
    });
  }
  for (const channel of chosen) {
    const values = valuesOf(channel);
    if (dofs[channel]?.unit === 'angle') unroll(values);
    yield progress();
    const smooth = new Float64Array(values.length);
    for (const _ of convolving(values, 1, 0, weights, smooth)) yield progress();
    made.set(columnOf(samples, channel), smooth);
  }
  return { ...clip, samples: yield* within(replacingColumns(samples, made), FILTERING[1], 1) };
}

/** In place. */
function* smoothRotations(
  a: Float64Array,
  b: Float64Array,
  c: Float64Array,
  axes: JointRotation['axes'],
  weights: Float64Array,
): Generator<void> {
  const q = new Float64Array(4 * a.length);
  for (let from = 0; from < a.length; from += STEP_FRAMES) {
    putQuaternions([a, b, c], axes, q, from, Math.min(a.length, from + STEP_FRAMES));
    yield;
  }
  const parts = [0, 1, 2, 3].map(() => new Float64Array(a.length));
  for (const [n, part] of parts.entries()) yield* convolving(q, 4, n, weights, part);
  for (let from = 0; from < a.length; from += STEP_FRAMES) {
    putAngles(parts, axes, [a, b, c], from, Math.min(a.length, from + STEP_FRAMES));
    yield;
  }
}

/** The angles of quaternions given part by part, in place of those that are there, from frame `from` up to `to`. */
function putAngles(
  [x, y, z, w]: readonly Float64Array[],
  axes: JointRotation['axes'],
  [a, b, c]: readonly [Float64Array, Float64Array, Float64Array],
  from: number,
  to: number,
): void {
  const q = new Float64Array(4);
  for (let f = from; f < to; f++) {
    q[0] = x[f];
    q[1] = y[f];
    q[2] = z[f];
    q[3] = w[f];
    // The first is nearest to its own angles, the others to those before them.
    const p = Math.max(0, f - 1);
    const form = anglesOf(q, 0, axes, a[p], b[p], c[p]);
    a[f] = form[0];
    b[f] = form[1];
    c[f] = form[2];
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

/** Every `step`-th of the values from `first` on, convolved into `out`. */
function* convolving(
  values: Float64Array,
  step: number,
  first: number,
  weights: Float64Array,
  out: Float64Array,
): Generator<void> {
  const count = out.length;
  const reach = weights.length - 1;
  // Both ends continued by their mirror images about the end points.
  const long = new Float64Array(count + 2 * reach);
  const at = (f: number) => values[first + f * step];
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
