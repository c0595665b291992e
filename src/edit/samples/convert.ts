/**
 * Keys instead of samples, few of them, and every joint where it was: *convert to keys*.
 *
 * 1. Joints that turn about three axes have their angles brought into forms that don't jump (`rotations.ts`), for a curve
 *    between 179° and −179° is not one that anybody could edit; other angles are unrolled by whole turns.
 * 2. Each channel gets a tolerance of its own: an angle by how far it can move what hangs on its joint, a length what a
 *    joint may be off itself,
 *
 *        angle    ½ · min(angle allowed, distance allowed / reach)      reach: to the joint or End Site furthest below
 *        length   ½ · distance allowed
 *
 *    and is fitted with the fewest cubics that the walk finds which are within it (`fit-frames.ts`).
 * 3. Errors add up along a chain of joints. So all joints and End Sites are put in place by forward kinematics, with the
 *    samples and with the keys, at every frame (`pose-error.ts`). Joints that have something below them that is further
 *    off than allowed get less, by as much as it is off, and are fitted again; until nothing is.
 *
 * What comes out is measured, never estimated: the largest error over all frames and joints is at most what was allowed.
 * That holds at the frames. Between two of them samples turn along the shortest arc and keys angle by angle: within an
 * allowance of 1°, halfway between frames some captures stay within 1.3° and 2.7°, but where angles swing from one frame
 * to the next near gimbal lock (cmu-01_01) a joint is off by up to 40° there.
 * (A bound worked out beforehand, the allowance divided by the length of the chain, would be kept without measuring, but
 * has to assume that the errors of all joints of a chain point the same way.)
 *
 * It is a generator, which pauses every few milliseconds: a page does it between frames and can stop it.
 */

import { type Steps, within } from '../../evaluate/steps.ts';
import type { ChannelClip, KeyedChannel } from '../../model/clip.ts';
import type { Character } from '../../model/document.ts';
import { type CharacterDof, characterDofs } from '../../model/dofs.ts';
import { columnOf, type Samples } from '../../model/samples.ts';
import type { Skeleton } from '../../model/skeleton.ts';
import { CommandError } from '../store.ts';
import { takingColumns } from './columns.ts';
import { fittingFrames } from './fit-frames.ts';
import { requireSamples } from './frames.ts';
import { measuringPoses, type PoseErrors } from './pose-error.ts';
import { jointRotations, unroll, unrollTriples } from './rotations.ts';

export interface Tolerance {
  /** How far a joint or End Site may be from where it was, in the file's lengths; above 0. */
  readonly position: number;
  /** How far a joint's world rotation may be from what it was, radians; above 0. */
  readonly angle: number;
}

export interface Worst {
  readonly error: number;
  /** Index of the joint. */
  readonly joint: number;
  /** Of the clip. */
  readonly atSeconds: number;
}

export interface Converted {
  readonly clip: ChannelClip;
  /** Channels that have keys now. */
  readonly channels: readonly number[];
  readonly samplesBefore: number;
  readonly keysAfter: number;
  /** Measured over all frames, joints and End Sites; file's lengths. */
  readonly worstPosition: Worst;
  /** Radians. */
  readonly worstAngle: Worst;
}

/** Of morph weights, and of scales and the like: they are no lengths of the skeleton. */
const PLAIN_TOLERANCE = 0.005;
/** What part of the work comes before the first fit. */
const PREPARING = 0.05;
/** Frames from one pause to the next where a frame costs little. */
const STEP_FRAMES = 1 << 15;
/** What of the allowance a channel gets at first. */
const FIRST_SHARE = 0.5;
/** After so many rounds it goes faster, and after so many it is plain that doubles are not as fine as what is asked. */
const PATIENT_ROUNDS = 8;
const MAX_ROUNDS = 30;

/** One channel on its way. */
interface Fitting {
  readonly channel: number;
  /** -1 for a morph. */
  readonly joint: number;
  readonly values: Float64Array;
  tolerance: number;
  made: KeyedChannel | undefined;
}

/**
 * @param given channels; those that don't follow the samples are passed over. Refuses where none is left.
 * @returns pauses with the part that is done, from 0 to 1
 */
export function* converting(
  character: Character,
  clip: ChannelClip,
  given: readonly number[],
  allowed: Tolerance,
): Steps<Converted> {
  const samples = requireSamples(clip);
  const { skeleton, morphs } = character;
  const channels = given.filter((channel) => clip.channels[channel]?.kind === 'samples');
  if (channels.length === 0) throw new CommandError('None of these curves is sampled, so there is nothing to convert.');
  const dofs = characterDofs(skeleton, morphs);
  const reach = skeleton ? reachOf(skeleton) : [];
  const prepared = yield* within(preparing(samples, skeleton, dofs, channels), 0, PREPARING);
  const fittings = prepared.map(
    ({ channel, values }): Fitting => ({
      channel,
      joint: dofs[channel]?.joint ?? -1,
      values,
      tolerance: firstTolerance(dofs[channel], reach, allowed),
      made: undefined,
    }),
  );
  const times = Float64Array.from(
    { length: samples.frameCount },
    (_, f) => samples.startSeconds + f * samples.frameSeconds,
  );
  for (let round = 0; ; round++) {
    // Nobody knows how many rounds there will be; each takes about half of what is left.
    const progress = (part: number) => PREPARING + (1 - PREPARING) * (1 - 0.5 ** round * (1 - part / 2));
    const todo = fittings.filter((f) => !f.made);
    for (const [done, fitting] of todo.entries()) {
      const fit = fittingFrames(times, fitting.values, fitting.tolerance);
      let step = fit.next();
      for (; !step.done; step = fit.next()) yield progress((0.7 * done) / todo.length);
      fitting.made = step.value;
    }
    const made = withFitted(clip, fittings);
    const measuring = measuringPoses(character, clip, made, samples);
    let step = measuring.next();
    for (; !step.done; step = measuring.next()) yield progress(0.7 + 0.3 * step.value);
    if (!tighten(fittings, skeleton, step.value, allowed, round)) return result(made, samples, fittings, step.value);
    if (round === MAX_ROUNDS)
      throw new CommandError('That tolerance is too tight for the precision of numbers. Increase it a little.');
  }
}

/** Their values in model units, an entry a frame, with angles that don't jump. */
function* preparing(
  samples: Samples,
  skeleton: Skeleton | undefined,
  dofs: readonly CharacterDof[],
  channels: readonly number[],
): Steps<readonly { readonly channel: number; readonly values: Float64Array }[]> {
  const columns = channels.map((channel) => columnOf(samples, channel));
  const taken = yield* within(takingColumns(samples, columns), 0, 0.5);
  const values = new Map(channels.map((channel, n) => [channel, taken.get(columns[n]) ?? new Float64Array(0)]));
  const progress = () => 0.5 + (0.5 * done.size) / channels.length;
  const done = new Set<number>();
  for (const { channels: triple } of skeleton ? jointRotations(skeleton) : []) {
    const [a, b, c] = triple.map((channel) => values.get(channel));
    if (!a || !b || !c) continue;
    for (let from = 0; from < a.length; from += STEP_FRAMES) {
      unrollTriples([a, b, c], from, Math.min(a.length, from + STEP_FRAMES));
      yield progress();
    }
    for (const channel of triple) done.add(channel);
  }
  for (const [channel, own] of values) {
    if (done.has(channel) || dofs[channel]?.unit !== 'angle') continue;
    unroll(own);
    yield progress();
  }
  return channels.map((channel) => ({ channel, values: values.get(channel) ?? new Float64Array(0) }));
}

/** By joint, how far away the furthest joint or End Site below can get: the lengths of the bones to it. */
function reachOf(skeleton: Skeleton): Float64Array {
  const reach = new Float64Array(skeleton.joints.length);
  for (let j = skeleton.joints.length - 1; j >= 0; j--) {
    const { parent, offset, endSites = [] } = skeleton.joints[j];
    for (const site of endSites) reach[j] = Math.max(reach[j], Math.hypot(...site));
    if (parent >= 0) reach[parent] = Math.max(reach[parent], reach[j] + Math.hypot(...offset));
  }
  return reach;
}

function firstTolerance(
  dof: CharacterDof | undefined,
  reach: ArrayLike<number>,
  { position, angle }: Tolerance,
): number {
  if (!dof || dof.joint < 0 || (dof.unit !== 'angle' && dof.unit !== 'length')) return PLAIN_TOLERANCE;
  if (dof.unit === 'length') return FIRST_SHARE * position;
  // A joint without anything below it moves nothing by turning.
  return FIRST_SHARE * Math.min(angle, position / Math.max(reach[dof.joint], 1e-9 * position));
}

/** Less for the joints that have something below them that is too far off. @returns whether there was any */
function tighten(
  fittings: readonly Fitting[],
  skeleton: Skeleton | undefined,
  { distances, angles }: PoseErrors,
  allowed: Tolerance,
  round: number,
): boolean {
  // How many times what is allowed the worst of a joint's subtree is off.
  const excess = distances.map((distance, j) => Math.max(distance / allowed.position, angles[j] / allowed.angle));
  for (let j = excess.length - 1; j > 0; j--) {
    const parent = skeleton?.joints[j].parent ?? -1;
    if (parent >= 0) excess[parent] = Math.max(excess[parent], excess[j]);
  }
  let isAny = false;
  for (const fitting of fittings) {
    const off = fitting.joint < 0 ? 0 : excess[fitting.joint];
    if (!(off > 1)) continue;
    isAny = true;
    fitting.tolerance *= round < PATIENT_ROUNDS ? Math.max(0.3, 0.9 / off) : 0.1;
    fitting.made = undefined;
  }
  return isAny;
}

function withFitted(clip: ChannelClip, fittings: readonly Fitting[]): ChannelClip {
  const channels = [...clip.channels];
  for (const { channel, made } of fittings) if (made) channels[channel] = made;
  const { samples: _done, ...rest } = clip;
  // What nothing follows any more has done its work.
  const isLeft = channels.some(({ kind }) => kind === 'samples');
  return isLeft ? { ...clip, channels } : { ...rest, channels };
}

function result(clip: ChannelClip, samples: Samples, fittings: readonly Fitting[], errors: PoseErrors): Converted {
  const worst = (of: Float64Array, frames: Int32Array): Worst => {
    let joint = 0;
    for (let j = 1; j < of.length; j++) if (of[j] > of[joint]) joint = j;
    return {
      error: of[joint] ?? 0,
      joint,
      atSeconds: samples.startSeconds + (frames[joint] ?? 0) * samples.frameSeconds,
    };
  };
  return {
    clip,
    channels: fittings.map((f) => f.channel),
    samplesBefore: fittings.length * samples.frameCount,
    keysAfter: fittings.reduce((sum, f) => sum + (f.made?.times.length ?? 0), 0),
    worstPosition: worst(errors.distances, errors.distanceFrames),
    worstAngle: worst(errors.angles, errors.angleFrames),
  };
}
