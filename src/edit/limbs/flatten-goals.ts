/**
 * A take with goals of limbs or attachments as a take without, which moves the same: the DOFs of its limbs, or of the
 * root, get keys at whole frames, fewer where a smooth curve through them is within the tolerance at every frame;
 * samples get the solved values.
 */
import { followingRoot } from '../../evaluate/attached.ts';
import { inTakes } from '../../evaluate/in-takes.ts';
import { poseFrom, poseSource } from '../../evaluate/pose.ts';
import { frameRateOf } from '../../evaluate/samples/frame-rate.ts';
import type { Character } from '../../model/document.ts';
import { characterDofs, firstDofs } from '../../model/skeleton/dofs.ts';
import { quaternionDofs } from '../../model/skeleton/joint-types.ts';
import { restExtent } from '../../model/skeleton/rest-extent.ts';
import { columnOf, type Samples } from '../../model/takes/samples.ts';
import { type Channel, type Take, USUAL_FRAMES_PER_SECOND } from '../../model/takes/take.ts';
import { FLATTEN_TOLERANCE, type FlattenOptions } from '../layers/flatten-options.ts';
import { fittingFrames } from '../samples/fit-frames.ts';
import { jointRotations, unroll, unrollTriples } from '../samples/rotations.ts';

/** Part of a frame that the end of a range may be beyond the last whole frame and count as it. */
const SAME_FRAME = 1e-6;

interface SolveOptions extends FlattenOptions {
  /** The root follows as before: only limbs are solved. */
  readonly keepsAttachments?: boolean;
}

/** The take without goals and attachments; the same object if it has neither. */
export function solvedTake(character: Character, take: Take, options: SolveOptions = {}): Take {
  const { goals, attached, ...plain } = take;
  const { skeleton } = character;
  if (!(goals ?? attached) || !skeleton) return take;
  const rest = attached && options.keepsAttachments ? { ...plain, attached } : plain;
  const dofs = movedDofs(character, options.keepsAttachments ? { ...plain, goals } : take);
  if (dofs.length === 0) return rest;
  const rate = options.framesPerSecond ?? frameRateOf(take) ?? USUAL_FRAMES_PER_SECOND;
  const times = wholeFrames(take.range, rate);
  const columns = solvedAt(character, take, times, dofs);
  continueAngles(columns, character);
  const size = restExtent(skeleton) || 1;
  const all = characterDofs(skeleton, []);
  const { tolerance = FLATTEN_TOLERANCE } = options;
  const channels: Channel[] = [...take.channels];
  for (const [dof, values] of columns) {
    if (channels[dof]?.kind === 'samples') continue;
    const allowed = tolerance * (all[dof]?.unit === 'length' ? Math.min(1, size) : 1);
    channels[dof] = keysThrough(times, values, allowed);
  }
  const samples = take.samples && solvedSamples(character, take, take.samples, dofs);
  return { ...rest, channels, ...(samples && { samples }) };
}

/** All DOFs of the limbs that have a goal, and of an attached root, ascending. */
function movedDofs({ limbs, skeleton }: Character, { goals, attached, channels }: Take): readonly number[] {
  const named = new Set(goals?.list.map(({ limb }) => limb));
  const joints = new Set((limbs?.list ?? []).filter(({ name }) => named.has(name)).flatMap((limb) => limb.joints));
  const all = characterDofs(skeleton, []);
  const { travel = [], turned } = (attached && skeleton && followingRoot(skeleton)) ?? {};
  const ofRoot = new Set([...travel, ...(turned?.dofs ?? [])]);
  return [...channels.keys()].filter((dof) => ofRoot.has(dof) || joints.has(all[dof]?.joint ?? -1));
}

function wholeFrames([start, end]: Take['range'], framesPerSecond: number): Float64Array {
  const frames = (end - start) * framesPerSecond;
  const last = Math.floor(frames + SAME_FRAME);
  // A range may end within a frame, and its motion is kept to the end.
  const isWithin = frames - last > SAME_FRAME;
  const times = Float64Array.from({ length: last + 1 + (isWithin ? 1 : 0) }, (_, k) => start + k / framesPerSecond);
  if (isWithin) times[last + 1] = end;
  return times;
}

/** The values of DOFs at times of the take, as the limbs are solved. */
function solvedAt(
  character: Character,
  take: Take,
  times: ArrayLike<number>,
  dofs: readonly number[],
): ReadonlyMap<number, Float64Array> {
  const { driver: _driver, ...own } = inTakes(character);
  const source = poseSource({ ...own, takes: [take], shownTake: 0, timeOffsetSeconds: 0 });
  const pose = new Float64Array(source.count);
  const columns = new Map(dofs.map((dof) => [dof, new Float64Array(times.length)]));
  for (let f = 0; f < times.length; f++) {
    poseFrom(source, times[f], pose);
    for (const [dof, values] of columns) values[f] = pose[dof];
  }
  return columns;
}

/**
 * Angles that don't jump by whole turns, or to the other triple of the same rotation, where the limits allow it: beyond
 * them they would be another pose.
 */
function continueAngles(columns: ReadonlyMap<number, Float64Array>, { skeleton, clampsToLimits }: Character): void {
  if (!skeleton) return;
  const all = characterDofs(skeleton, []);
  const isAllowed = (dof: number, values: Float64Array) =>
    !clampsToLimits || values.every((value) => value >= all[dof].limit.min && value <= all[dof].limit.max);
  const done = new Set<number>();
  for (const [j, { motion }] of skeleton.joints.entries()) {
    const columnsOf = quaternionDofs(motion).flatMap((dof) => columns.get(firstDofs(skeleton)[j] + dof) ?? []);
    if (columnsOf.length === 4) continueQuaternion(columnsOf);
  }
  for (const { channels } of jointRotations(skeleton)) {
    const given = channels.flatMap((dof) => columns.get(dof) ?? []);
    if (given.length < channels.length) continue;
    for (const dof of channels) done.add(dof);
    const [a, b, c] = given.map((values) => values.slice());
    unrollTriples([a, b, c]);
    const isWithin = [a, b, c].every((values, k) => isAllowed(channels[k], values));
    if (isWithin) for (const [k, values] of given.entries()) values.set([a, b, c][k]);
  }
  for (const [dof, values] of columns) {
    if (done.has(dof) || all[dof]?.unit !== 'angle') continue;
    const turned = values.slice();
    unroll(turned);
    if (isAllowed(dof, turned)) values.set(turned);
  }
}

/** Of both signs, which are the same rotation, the one nearer to the frame before. */
function continueQuaternion(columns: readonly Float64Array[]): void {
  for (let f = 1; f < columns[0].length; f++) {
    const along = columns.reduce((sum, column) => sum + column[f] * column[f - 1], 0);
    if (along < 0) for (const column of columns) column[f] = -column[f];
  }
}

function keysThrough(times: Float64Array, values: Float64Array, tolerance: number): Channel {
  const fit = fittingFrames(times, values, tolerance);
  let step = fit.next();
  while (!step.done) step = fit.next();
  return step.value;
}

function solvedSamples(character: Character, take: Take, samples: Samples, dofs: readonly number[]): Samples {
  const { frameCount, frameSeconds, startSeconds, scales } = samples;
  const sampled = dofs.filter((dof) => take.channels[dof].kind === 'samples' && columnOf(samples, dof) >= 0);
  if (sampled.length === 0) return samples;
  const times = Float64Array.from({ length: frameCount }, (_, f) => startSeconds + f * frameSeconds);
  const columns = solvedAt(character, take, times, sampled);
  const values = samples.values.slice();
  for (const [dof, solved] of columns) {
    const column = columnOf(samples, dof);
    for (let f = 0; f < frameCount; f++) values[f * scales.length + column] = solved[f] / scales[column];
  }
  return { ...samples, values };
}
