/**
 * Converts samples to few keys with every joint in place: *convert to keys*.
 *
 * 1. For joints that rotate about three axes, angles are converted to forms that don't jump (`rotations.ts`), since
 * nobody could edit a curve between 179° and −179°; other angles are unrolled by whole turns.
 * 2. Each channel gets its own tolerance: an angle by how far it can move its joint's descendants, a length by the
 * allowed distance,
 *
 *        angle    ½ · min(angle allowed, distance allowed / reach)      reach: to the farthest joint or End Site below
 *        length   ½ · distance allowed
 *
 *    and is fitted with the fewest cubics within it that the greedy algorithm finds (`fit-frames.ts`).
 * 3. Errors add up along a chain of joints. So all joints and End Sites are evaluated by forward kinematics, with the
 * samples and with the keys, at every frame (`pose-error.ts`). Joints with a descendant beyond the tolerance get a
 * tolerance reduced in proportion, and are fitted again, until none is beyond.
 *
 * The result is measured, never estimated: the largest error over all frames and joints is within the tolerance. That
 * holds at frames. In between, samples rotate along the shortest arc and keys angle by angle: with 1° allowed, some
 * captures stay within 1.3° and 2.7° halfway between frames, but where angles swing between frames near gimbal lock
 * (cmu-01_01) a joint deviates by up to 40°. (A bound computed in advance, the tolerance divided by the length of the
 * chain, would hold without measuring, but has to assume that all errors along a chain add up in the same direction.)
 *
 * A generator that yields every few milliseconds, so that a page can run it between frames and cancel it.
 */

import { type Steps, within } from '../../evaluate/steps.ts';
import type { Character } from '../../model/document.ts';
import { type CharacterDof, characterDofs } from '../../model/skeleton/dofs.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { columnOf, type Samples } from '../../model/takes/samples.ts';
import type { KeyedChannel, Take } from '../../model/takes/take.ts';
import { CommandError } from '../command-error.ts';
import { takingColumns } from './columns.ts';
import { fittingFrames } from './fit-frames.ts';
import { requireSamples } from './frames.ts';
import { measuringPoses, type PoseErrors } from './pose-error.ts';
import { jointRotations, unroll, unrollTriples } from './rotations.ts';

/** How far a pose may differ after conversion. */
export interface Tolerance {
  /** Maximum distance of a joint or End Site from its previous position, in the file's lengths; greater than 0. */
  readonly position: number;
  /** Maximum angle between a joint's world rotation and its previous one, radians; greater than 0. */
  readonly angle: number;
}

/** Fraction of the skeleton's size that is hardly visible at a joint. */
const POSITION_PART = 0.005;
/** Radians: 1°. */
const ANGLE = Math.PI / 180;

/** Tolerance that is hardly visible. */
export function usualTolerance(skeleton: Skeleton | undefined): Tolerance {
  return { position: POSITION_PART * (skeleton ? sizeOf(skeleton) : 1), angle: ANGLE };
}

/** Longest side of the bounding box of the joints at rest. */
function sizeOf({ joints }: Skeleton): number {
  const at: number[][] = [];
  for (const { parent, offset } of joints) at.push(offset.map((v, k) => v + (parent < 0 ? 0 : at[parent][k])));
  const sides = [0, 1, 2].map((k) => Math.max(...at.map((p) => p[k])) - Math.min(...at.map((p) => p[k])));
  return Math.max(...sides) || 1;
}

/** The largest error of a conversion, and where it is. */
export interface Worst {
  readonly error: number;
  /** Index of the joint. */
  readonly joint: number;
  /** Seconds of the take. */
  readonly atSeconds: number;
}

/** A take whose samples became keys, and how exact it is. */
export interface Converted {
  readonly take: Take;
  /** Channels that have keys now. */
  readonly channels: readonly number[];
  readonly samplesBefore: number;
  readonly keysAfter: number;
  /** Measured over all frames, joints and End Sites; file's lengths. */
  readonly worstPosition: Worst;
  /** Radians. */
  readonly worstAngle: Worst;
}

/** For morph weights, scales and others that are no lengths of the skeleton. */
const PLAIN_TOLERANCE = 0.005;
/** Share of the work before the first fit. */
const PREPARING = 0.05;
/** Frames between two yields if frames are cheap. */
const STEP_FRAMES = 1 << 15;
/** Initial fraction of the tolerance for a channel. */
const FIRST_SHARE = 0.5;
/**
 * After this many rounds the reduction is faster, and after this many doubles are clearly too coarse for the tolerance.
 */
const PATIENT_ROUNDS = 8;
const MAX_ROUNDS = 30;

/** A channel in progress. */
interface Fitting {
  readonly channel: number;
  /** -1 for a morph. */
  readonly joint: number;
  readonly values: Float64Array;
  tolerance: number;
  made: KeyedChannel | undefined;
}

/**
 * Converts sampled channels to few keys, within the tolerance at every frame.
 * @param given channels; others than sampled ones are skipped. Refuses if none is left.
 * @returns yields progress, from 0 to 1
 */
export function* converting(
  character: Character,
  take: Take,
  given: readonly number[],
  allowed: Tolerance,
): Steps<Converted> {
  const samples = requireSamples(take);
  const { skeleton, morphs } = character;
  const channels = given.filter((channel) => take.channels[channel]?.kind === 'samples');
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
    // The number of rounds is unknown; each takes about half of the remaining progress.
    const progress = (part: number) => PREPARING + (1 - PREPARING) * (1 - 0.5 ** round * (1 - part / 2));
    const todo = fittings.filter((f) => !f.made);
    for (const [done, fitting] of todo.entries()) {
      const fit = fittingFrames(times, fitting.values, fitting.tolerance);
      let step = fit.next();
      for (; !step.done; step = fit.next()) yield progress((0.7 * done) / todo.length);
      fitting.made = step.value;
    }
    const made = withFitted(take, fittings);
    const measuring = measuringPoses(character, take, made, samples);
    let step = measuring.next();
    for (; !step.done; step = measuring.next()) yield progress(0.7 + 0.3 * step.value);
    if (!tighten(fittings, skeleton, step.value, allowed, round)) return result(made, samples, fittings, step.value);
    if (round === MAX_ROUNDS)
      throw new CommandError('That tolerance is below the precision of the numbers. Increase it a little.');
  }
}

/** Their values in model units, an entry per frame, with angles that don't jump. */
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

/** By joint, the farthest that any descendant joint or End Site can be: the total bone length to it. */
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
  // A joint without descendants moves nothing by rotating.
  return FIRST_SHARE * Math.min(angle, position / Math.max(reach[dof.joint], 1e-9 * position));
}

/** Reduces the tolerance of joints with descendants that are too far off. @returns whether there were any */
function tighten(
  fittings: readonly Fitting[],
  skeleton: Skeleton | undefined,
  { distances, angles }: PoseErrors,
  allowed: Tolerance,
  round: number,
): boolean {
  // By how much the worst of a joint's subtree exceeds the tolerance, as a factor.
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

function withFitted(take: Take, fittings: readonly Fitting[]): Take {
  const channels = [...take.channels];
  for (const { channel, made } of fittings) if (made) channels[channel] = made;
  const { samples: _done, ...rest } = take;
  // Samples that no channel follows any more are dropped.
  const isLeft = channels.some(({ kind }) => kind === 'samples');
  return isLeft ? { ...take, channels } : { ...rest, channels };
}

function result(take: Take, samples: Samples, fittings: readonly Fitting[], errors: PoseErrors): Converted {
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
    take,
    channels: fittings.map((f) => f.channel),
    samplesBefore: fittings.length * samples.frameCount,
    keysAfter: fittings.reduce((sum, f) => sum + (f.made?.times.length ?? 0), 0),
    worstPosition: worst(errors.distances, errors.distanceFrames),
    worstAngle: worst(errors.angles, errors.angleFrames),
  };
}
