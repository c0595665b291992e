/**
 * Smoothing, and taking out spikes: filters over the frames around each, the same to both sides.
 *
 *     gaussian     jitter goes, and what is quick gets less (`gaussian.ts`)
 *     median       what stands out for a frame or a few goes, and all else stays as it is (`median.ts`)
 *
 * A movement to and fro with period P keeps of a Gaussian exp(−2(πσ/P)²) of its height: with σ = 0.05 s 95 % of one a
 * second, 29 % of five a second, less than 1 % of ten.
 *
 * Joints with three angles are filtered as rotations: their quaternions are, each on the side of the one before it, and
 * brought back to length and to angles. Angles by themselves would smear where they jump from 179° to −179° or swing
 * about near gimbal lock, while the joint hardly moves. Single angles are unrolled first.
 *
 * Within a range, the filter sets in and ends little by little (`seam.ts`): values and rotations lie between what was and
 * what the filter makes of it. It sees the frames outside. There, angles are those nearest to what was, so that no turn
 * is added where the range ends; over a whole take those nearest to the frame before.
 *
 * (Savitzky–Golay keeps peaks higher for the same window but lets some jitter through with its sign turned; a Gaussian's
 * one number is one that people have a feeling for.)
 */

import { type Steps, within } from '../../evaluate/steps.ts';
import { turnedNear } from '../../math/euler.ts';
import type { ChannelClip } from '../../model/clip.ts';
import type { CharacterDof } from '../../model/dofs.ts';
import { columnOf } from '../../model/samples.ts';
import { replacingColumns, takingColumns } from './columns.ts';
import { framesBetween, requireSamples } from './frames.ts';
import { convolving, gaussian } from './gaussian.ts';
import { medianFrame, medianRotation } from './median.ts';
import { anglesOf, type JointRotation, nearestForm, putQuaternions, unroll } from './rotations.ts';
import { type FrameRange, frameRange, isWhole, weightAt } from './seam.ts';

export type SampleFilter =
  /** σ in seconds, above 0. */
  | { readonly kind: 'gaussian'; readonly sigmaSeconds: number }
  /** One of `MEDIAN_FRAMES`. */
  | { readonly kind: 'median'; readonly frames: number };

/** From where to where the work is filtering: columns are taken out before it, and put back after it. */
const FILTERING = [0.05, 0.9] as const;
/** Frames from one pause to the next where a frame costs a few sines. */
const STEP_FRAMES = 1 << 14;

type Triple = readonly [Float64Array, Float64Array, Float64Array];

/** What is filtered, of columns that begin and end with the frames that the filter sees. */
interface Job {
  /** Of those columns. */
  readonly range: FrameRange;
  /** How far the filter sees to either side. */
  readonly reach: number;
  /** Of the Gaussian; a median has none. */
  readonly weights: Float64Array | undefined;
}

/**
 * @param rotations of the character's skeleton
 * @param channels only these; others, and those with keys, stay
 * @param seconds of the clip; all frames where absent
 */
export function* smoothing(
  clip: ChannelClip,
  dofs: readonly CharacterDof[],
  rotations: readonly JointRotation[],
  channels: readonly number[],
  filter: SampleFilter,
  seconds?: readonly [number, number],
): Steps<ChannelClip> {
  const samples = requireSamples(clip);
  const { frameCount } = samples;
  const { first, end } = frameRange(samples, seconds);
  const weights =
    filter.kind === 'gaussian' ? gaussian(filter.sigmaSeconds / samples.frameSeconds, frameCount) : undefined;
  const reach = filter.kind === 'median' ? (filter.frames - 1) / 2 : (weights?.length ?? 1) - 1;
  const from = Math.max(0, first - reach);
  const seen = framesBetween(samples, from, Math.min(frameCount, end + reach));
  const job: Job = { range: { first: first - from, end: end - from, frameCount: frameCount - from }, reach, weights };

  const chosen = new Set(channels.filter((channel) => clip.channels[channel]?.kind === 'samples'));
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
  return { ...clip, samples: yield* within(replacingColumns(samples, made, first), FILTERING[1], 1) };
}

/** Lengths, weights, and angles that turn by themselves; in place. */
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

/** The angles of quaternions given part by part, in place of those that are there, from frame `from` up to `to`. */
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
    // The filter's result is near the frame's own, on its side.
    for (let n = 0; n < 4; n++) mixed[n] = q[4 * f + n] + weight * (parts[n][f] - q[4 * f + n]);
    // The first is nearest to its own angles, the others to those before them.
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
 * The rotations of other frames in place of spikes, each in the form that is nearest to the frame before.
 * @param own the angles as they were
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
    // The first frame's window is itself alone: there is one before each that changes.
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
