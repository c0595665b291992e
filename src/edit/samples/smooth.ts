/**
 * Smoothing and removing spikes: symmetric filters over the surrounding frames.
 *
 *     gaussian     removes jitter and attenuates fast motion (`gaussian.ts`)
 *     median       removes outliers of one or a few frames, and keeps everything else (`median.ts`)
 *
 * An oscillation of period P keeps exp(−2(πσ/P)²) of its amplitude under a Gaussian: with σ = 0.05 s 95 % at one per
 * second, 29 % at five per second, less than 1 % at ten.
 *
 * Joints with three angles are filtered as rotations: their quaternions, with consistent signs, are filtered,
 * normalised and converted back to angles. Filtering angles separately would smear jumps from 179° to −179° and swings
 * near gimbal lock, while the joint hardly moves. Single angles are unrolled first.
 *
 * Within a range, the filter starts and ends gradually (`seam.ts`): values and rotations are blended between before and
 * after. It reads the frames outside. In a range, angles are those nearest to the previous ones, so that no turn is
 * added where it ends; over a whole take those nearest to the previous frame.
 *
 * (Savitzky–Golay keeps peaks higher for the same window but lets some jitter through with reversed sign; and the
 * single parameter of a Gaussian is intuitive.)
 */

import { type Steps, within } from '../../evaluate/steps.ts';
import { turnedNear } from '../../math/euler.ts';
import type { CharacterDof } from '../../model/skeleton/dofs.ts';
import { columnOf } from '../../model/takes/samples.ts';
import type { Take } from '../../model/takes/take.ts';
import { replacingColumns, takingColumns } from './columns.ts';
import { framesBetween, requireSamples } from './frames.ts';
import { convolving, gaussian } from './gaussian.ts';
import { medianFrame, medianRotation } from './median.ts';
import { anglesOf, type JointRotation, nearestForm, putQuaternions, unroll } from './rotations.ts';
import { type FrameRange, frameRange, isWhole, weightAt } from './seam.ts';

/** A filter of samples, told by `kind`. */
export type SampleFilter =
  /** σ in seconds; greater than 0. */
  | { readonly kind: 'gaussian'; readonly sigmaSeconds: number }
  /** One of `MEDIAN_FRAMES`. */
  | { readonly kind: 'median'; readonly frames: number };

/** Share of filtering in the progress: before it columns are extracted, after it replaced. */
const FILTERING = [0.05, 0.9] as const;
/** Frames between two yields if a frame takes a few sines. */
const STEP_FRAMES = 1 << 14;

type Triple = readonly [Float64Array, Float64Array, Float64Array];

/** A filter job, on columns cut to the frames that the filter reads. */
interface Job {
  /** Within those columns. */
  readonly range: FrameRange;
  /** Frames that the filter reads to either side. */
  readonly reach: number;
  /** Weights of the Gaussian; undefined for a median. */
  readonly weights: Float64Array | undefined;
}

/**
 * Filters the samples of a take; yields its progress.
 * @param rotations of the character's skeleton
 * @param channels only these; others, and keyed ones, are kept
 * @param seconds of the take; default: all frames
 */
export function* smoothing(
  take: Take,
  dofs: readonly CharacterDof[],
  rotations: readonly JointRotation[],
  channels: readonly number[],
  filter: SampleFilter,
  seconds?: readonly [number, number],
): Steps<Take> {
  const samples = requireSamples(take);
  const { frameCount } = samples;
  const { first, end } = frameRange(samples, seconds);
  const weights =
    filter.kind === 'gaussian' ? gaussian(filter.sigmaSeconds / samples.frameSeconds, frameCount) : undefined;
  const reach = filter.kind === 'median' ? (filter.frames - 1) / 2 : (weights?.length ?? 1) - 1;
  const from = Math.max(0, first - reach);
  const seen = framesBetween(samples, from, Math.min(frameCount, end + reach));
  const job: Job = { range: { first: first - from, end: end - from, frameCount: frameCount - from }, reach, weights };

  const chosen = new Set(channels.filter((channel) => take.channels[channel]?.kind === 'samples'));
  const count = Math.max(1, chosen.size);
  const made = new Map<number, Float64Array>();
  const columns = [...chosen].map((channel) => columnOf(samples, channel));
  const taken = yield* within(takingColumns(seen, columns), 0, FILTERING[0]);
  const valuesOf = (channel: number) => taken.get(columnOf(samples, channel)) ?? new Float64Array(0);
  const progress = () => FILTERING[0] + ((FILTERING[1] - FILTERING[0]) * made.size) / count;
  const keep = (channel: number, values: Float64Array) =>
    made.set(columnOf(samples, channel), values.subarray(job.range.first, job.range.end));
  for (const { channels: triple, axes } of rotations) {
    if (!triple.every((channel) => chosen.has(channel))) continue;
    const [a, b, c] = triple.map(valuesOf);
    yield progress();
    for (const _ of filteringRotations([a, b, c], axes, job)) yield progress();
    [a, b, c].forEach((values, n) => {
      keep(triple[n], values);
      chosen.delete(triple[n]);
    });
  }
  for (const channel of chosen) {
    const values = valuesOf(channel);
    yield progress();
    for (const _ of filteringValues(values, dofs[channel]?.unit === 'angle', job)) yield progress();
    keep(channel, values);
  }
  return { ...take, samples: yield* within(replacingColumns(samples, made, first), FILTERING[1], 1) };
}

/** Lengths, weights and independent angles; in place. */
function* filteringValues(values: Float64Array, isAngle: boolean, { range, reach, weights }: Job): Generator<void> {
  const flat = values.slice();
  if (isAngle) unroll(flat);
  const smooth = weights && new Float64Array(values.length);
  if (smooth) yield* convolving(flat, 1, 0, weights, smooth);
  for (let f = range.first; f < range.end; f++) {
    if (f % STEP_FRAMES === STEP_FRAMES - 1) yield;
    const source = smooth ? f : medianFrame(flat, f, reach);
    if (!smooth && source === f) continue;
    const target = smooth ? smooth[f] : flat[source];
    const weight = weightAt(range, reach, f);
    const value = weight === 1 ? target : flat[f] + weight * (target - flat[f]);
    if (!isAngle || (smooth && isWhole(range))) values[f] = value;
    else values[f] = turnedNear(value, values[smooth ? f : f - 1]);
  }
}

/** The three angles of rotations, in place. */
function* filteringRotations(angles: Triple, axes: JointRotation['axes'], job: Job): Generator<void> {
  const { range, weights } = job;
  const count = angles[0].length;
  const q = new Float64Array(4 * count);
  for (let from = 0; from < count; from += STEP_FRAMES) {
    putQuaternions(angles, axes, q, from, Math.min(count, from + STEP_FRAMES));
    yield;
  }
  const parts = weights && [0, 1, 2, 3].map(() => new Float64Array(count));
  for (const [n, part] of (parts ?? []).entries()) yield* convolving(q, 4, n, weights ?? new Float64Array(1), part);
  const own = parts ? angles : [angles[0].slice(), angles[1].slice(), angles[2].slice()];
  for (let from = range.first; from < range.end; from += STEP_FRAMES) {
    const to = Math.min(range.end, from + STEP_FRAMES);
    if (parts) putSmooth(q, parts, axes, angles, job, from, to);
    else putMedians(q, own, axes, angles, job, from, to);
    yield;
  }
}

/** Replaces angles by those of quaternions, given by component, in frames `from` up to `to`. */
function putSmooth(
  q: Float64Array,
  parts: readonly Float64Array[],
  axes: JointRotation['axes'],
  angles: Triple,
  { range, reach }: Job,
  from: number,
  to: number,
): void {
  const [a, b, c] = angles;
  const mixed = new Float64Array(4);
  const whole = isWhole(range);
  for (let f = from; f < to; f++) {
    const weight = weightAt(range, reach, f);
    // The filter's result is close to the frame's own quaternion, with the same sign.
    for (let n = 0; n < 4; n++) mixed[n] = q[4 * f + n] + weight * (parts[n][f] - q[4 * f + n]);
    // The first is nearest to its own angles, the others to the previous ones.
    const p = whole ? Math.max(0, f - 1) : f;
    putForm(anglesOf(mixed, 0, axes, a[p], b[p], c[p]), angles, f);
  }
}

function putForm(form: Float64Array, [a, b, c]: Triple, frame: number): void {
  a[frame] = form[0];
  b[frame] = form[1];
  c[frame] = form[2];
}

/**
 * Replaces spikes by the rotations of other frames, each in the form nearest to the previous frame.
 * @param own the previous angles
 */
function putMedians(
  q: Float64Array,
  own: readonly Float64Array[],
  axes: JointRotation['axes'],
  angles: Triple,
  { range, reach }: Job,
  from: number,
  to: number,
): void {
  const [a, b, c] = angles;
  const mixed = new Float64Array(4);
  for (let f = from; f < to; f++) {
    const m = medianRotation(q, f, reach);
    // The first frame never changes, since its window is only itself; so there is always a previous one.
    if (m === f) continue;
    const weight = weightAt(range, reach, f);
    if (weight === 1) putForm(nearestForm(own[0][m], own[1][m], own[2][m], a[f - 1], b[f - 1], c[f - 1]), angles, f);
    else {
      let dot = 0;
      for (let n = 0; n < 4; n++) dot += q[4 * f + n] * q[4 * m + n];
      const side = dot < 0 ? -weight : weight;
      for (let n = 0; n < 4; n++) mixed[n] = (1 - weight) * q[4 * f + n] + side * q[4 * m + n];
      putForm(anglesOf(mixed, 0, axes, a[f - 1], b[f - 1], c[f - 1]), angles, f);
    }
  }
}
