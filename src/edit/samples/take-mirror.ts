/**
 * Mirrors a take: left and right exchange their motion, and the path is reflected across a plane of the character's
 * space.
 *
 * For most skeletons a channel is the counterpart's with a sign (`pose/reflection.ts`): columns and keys are swapped
 * as they are, in the units of the file, so that mirroring twice gives every number back. Joints with axes that no sign
 * fits are fitted frame by frame (`pose/mirror.ts`); keys of such joints can't be mirrored.
 *
 * One plane serves the whole take, the one that the first frame faces along.
 */
import { compileTake } from '../../evaluate/compiled-take.ts';
import { evaluateTake } from '../../evaluate/curves.ts';
import { type CompiledSkeleton, compileSkeleton } from '../../evaluate/kinematics.ts';
import { STEP_VALUES, type Steps } from '../../evaluate/steps.ts';
import type { Character } from '../../model/document.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import type { Space } from '../../model/space.ts';
import { columnOf, type Samples } from '../../model/takes/samples.ts';
import { type Channel, restChannel, type Take, type Tangents } from '../../model/takes/take.ts';
import { FIXED_TANGENT } from '../../model/takes/tangent-kinds.ts';
import { CommandError } from '../command-error.ts';
import { sameValue } from '../delta.ts';
import { swappedPose, wholeReflection } from '../pose/mirror.ts';
import type { Reflection } from '../pose/reflection.ts';
import { signed } from '../pose/reflection-signs.ts';
import { partnersByName } from '../pose/sides.ts';
import { jointRotations, unrollTriples } from './rotations.ts';

/** The parts of its character that a take needs to be mirrored. `pose` is for DOFs without a channel. */
export type Mirrored = Pick<Character, 'morphs' | 'pose'> & { readonly skeleton: Skeleton };

/** Frames between two yields if each joint is fitted. */
const STEP_FRAMES = 16;

/**
 * Mirrored twice, a take is itself, exactly where signs are enough. One that is symmetric doesn't change: the same
 * object. Throws a `CommandError` if keys can't be mirrored.
 *
 * @param up axis of the character's space
 */
export function* mirroringTake(character: Mirrored, take: Take, up: Space['up'] = 'y'): Steps<Take> {
  const { skeleton, morphs } = character;
  const compiled = compileSkeleton(skeleton);
  const jointDofs = compiled.firstDof[compiled.jointCount];
  const padded = paddedTake(character, take, jointDofs + morphs.length);
  const reflection = wholeReflection(skeleton, firstPose(padded, jointDofs), up);
  const exchange = exchangeOf(compiled, reflection, morphs);
  const whole = exchange.isWhole;
  if (!whole) refuseKeys(padded, jointDofs, skeleton, compiled, exchange);
  const channels = padded.channels.map((channel, c) => {
    const next = exchanged(padded.channels, c, exchange);
    return sameValue(next, channel) ? channel : next;
  });
  const { samples } = padded;
  const made: Samples | undefined = samples && {
    ...samples,
    values: whole
      ? yield* exchangingColumns(samples, exchange)
      : yield* fittingFrames(skeleton, padded, samples, reflection, exchange, jointDofs),
  };
  const next: Take = {
    ...padded,
    channels,
    ...(made && { samples: sameValue(made, samples) ? samples : made }),
  };
  return sameValue(next, padded) ? take : next;
}

/** A take with a channel for each DOF: the others rest in the pose. */
function paddedTake({ pose }: Mirrored, take: Take, count: number): Take {
  if (take.channels.length >= count) return take;
  const added = Array.from({ length: count - take.channels.length }, (_, i) =>
    restChannel(pose[take.channels.length + i] ?? 0),
  );
  return { ...take, channels: [...take.channels, ...added] };
}

/** The DOFs of the joints in the first frame, or where the take starts. */
function firstPose(take: Take, count: number): Float64Array {
  const out = new Float64Array(count);
  evaluateTake(compileTake(take), take.samples?.startSeconds ?? take.range[0], out, count);
  if (take.samples) putRow(take, take.samples, 0, out);
  return out;
}

/** Writes a frame's values over those of the channels that follow the samples. */
function putRow({ channels }: Take, samples: Samples, frame: number, out: Float64Array): void {
  const { values, scales, firstChannel } = samples;
  for (let k = 0; k < scales.length && firstChannel + k < out.length; k++) {
    if (channels[firstChannel + k].kind === 'samples')
      out[firstChannel + k] = values[frame * scales.length + k] * scales[k];
  }
}

/** Which channel each one gets its motion from, and how its values change. Per channel. */
interface Exchange {
  readonly source: Int32Array;
  readonly signs: Int8Array;
  /** The values from which those of the source and of the result are counted. */
  readonly from: Float64Array;
  readonly to: Float64Array;
  /** Whether signs are enough for all joints. */
  readonly isWhole: boolean;
  /** Joints for which they are not. */
  readonly fitted: readonly number[];
}

function exchangeOf(compiled: CompiledSkeleton, reflection: Reflection, morphs: Character['morphs']): Exchange {
  const { jointCount, firstDof, parent, hasRootTranslation } = compiled;
  const { partner, signs, reference, matrix } = reflection;
  const count = firstDof[jointCount] + morphs.length;
  const made = {
    source: Int32Array.from({ length: count }, (_, c) => c),
    signs: new Int8Array(count).fill(1),
    from: new Float64Array(count),
    to: new Float64Array(count),
  };
  const fitted: number[] = [];
  const put = (c: number, source: number, sign: number) => {
    made.source[c] = source;
    made.signs[c] = sign;
    made.from[c] = reference[source] ?? 0;
    made.to[c] = reference[c] ?? 0;
  };
  const isAlong = [0, 1, 2].every((c) => [0, 1, 2].every((r) => r === c || matrix[3 * c + r] === 0));
  if (hasRootTranslation) for (let k = 0; k < 3; k++) put(k, k, matrix[4 * k] < 0 ? -1 : 1);
  if (hasRootTranslation && !isAlong) fitted.push(0);
  for (let t = 0; t < jointCount; t++) {
    const s = partner[t];
    const [first, end] = [firstDof[t], firstDof[t + 1]];
    if (s < 0 || end === first) continue;
    const above = parent[t];
    const isInStep = above < 0 || partner[above] === parent[s];
    if (signs[first] === 0 || !isInStep) fitted.push(t);
    else for (let d = 0; d < end - first; d++) put(first + d, firstDof[s] + d, signs[first + d]);
  }
  partnersByName(morphs.map(({ name }) => name)).forEach((other, m) => {
    if (other >= 0) put(firstDof[jointCount] + m, firstDof[jointCount] + other, 1);
  });
  return { ...made, isWhole: fitted.length === 0, fitted };
}

function refuseKeys(
  { name, channels }: Take,
  jointDofs: number,
  { joints }: Skeleton,
  { firstDof }: CompiledSkeleton,
  { fitted }: Exchange,
): void {
  if (channels.slice(0, jointDofs).every(({ kind }) => kind !== 'keys')) return;
  const isKeyed = (j: number) => channels.slice(firstDof[j], firstDof[j + 1]).some(({ kind }) => kind === 'keys');
  const joint = joints[fitted.find(isKeyed) ?? fitted[0]];
  throw new CommandError(
    `${name} has keys, and the axes of ${joint.name} are not those of the other side: its keys can't be mirrored. Save it as .bvh, and mirror that.`,
  );
}

/** A value of the source as one of the result, in model units. */
function changed({ signs, from, to }: Exchange, channel: number, value: number): number {
  return signed(signs[channel], from[channel], to[channel], value);
}

function exchanged(channels: readonly Channel[], c: number, exchange: Exchange): Channel {
  const source = channels[exchange.source[c] ?? c];
  if (source.kind === 'samples' || c >= exchange.source.length) return source;
  if (source.kind === 'rest') {
    const value = changed(exchange, c, source.value);
    return value === source.value ? source : { ...source, value };
  }
  const values = source.values.map((v) => changed(exchange, c, v));
  if (exchange.signs[c] > 0 && values.every((v, k) => v === source.values[k])) return source;
  return {
    ...source,
    values,
    tangentsIn: signedTangents(source.tangentsIn, exchange.signs[c]),
    tangentsOut: signedTangents(source.tangentsOut, exchange.signs[c]),
  };
}

function signedTangents(tangents: Tangents, sign: number): Tangents {
  if (sign > 0) return tangents;
  const { kinds, slopes } = tangents;
  return { kinds, slopes: slopes.map((slope, k) => (kinds[k] === FIXED_TANGENT ? 0 - slope : slope)) };
}

/** The values of all frames, columns swapped. */
function* exchangingColumns(samples: Samples, exchange: Exchange): Steps<Float64Array> {
  const { values, scales, frameCount } = samples;
  const width = scales.length;
  const made = values.slice();
  const columns = movedColumns(samples, exchange);
  const rows = Math.max(1, Math.floor(STEP_VALUES / Math.max(1, width)));
  for (let first = 0; first < frameCount; first += rows) {
    const end = Math.min(frameCount, first + rows);
    for (const column of columns) moveColumn(samples, column, exchange, made, first, end);
    yield end / frameCount;
  }
  return made;
}

interface MovedColumn {
  readonly column: number;
  readonly channel: number;
  readonly source: number;
}

function movedColumns(samples: Samples, { source, signs, from, to }: Exchange): MovedColumn[] {
  const found: MovedColumn[] = [];
  samples.scales.forEach((_, column) => {
    const channel = samples.firstChannel + column;
    if (channel >= source.length) return;
    const other = columnOf(samples, source[channel]);
    if (other < 0) throw new CommandError('Only one side of this take is sampled, so the sides can’t be swapped.');
    const stays = other === column && signs[channel] > 0 && from[channel] === to[channel];
    if (!stays) found.push({ column, channel, source: other });
  });
  return found;
}

function moveColumn(
  { values, scales }: Samples,
  { column, channel, source }: MovedColumn,
  exchange: Exchange,
  made: Float64Array,
  first: number,
  end: number,
): void {
  const width = scales.length;
  const [scale, theirs] = [scales[column], scales[source]];
  const sign = exchange.signs[channel];
  const isPlain = scale === theirs && exchange.from[channel] === sign * exchange.to[channel];
  for (let f = first; f < end; f++) {
    const value = values[f * width + source];
    // Subtracted from 0, so that 0 doesn't become −0.
    made[f * width + column] = !isPlain
      ? changed(exchange, channel, value * theirs) / scale
      : sign > 0
        ? value
        : 0 - value;
  }
}

/** The values of all frames if some joints have to be fitted; those that are only swapped keep their exact numbers. */
function* fittingFrames(
  skeleton: Skeleton,
  take: Take,
  samples: Samples,
  reflection: Reflection,
  exchange: Exchange,
  jointDofs: number,
): Steps<Float64Array> {
  const { scales, frameCount, firstChannel } = samples;
  const width = scales.length;
  const columns = movedColumns(samples, exchange);
  const made = samples.values.slice();
  const dofs = firstPose(take, jointDofs);
  const end = Math.min(width, jointDofs - firstChannel);
  for (let f = 0; f < frameCount; f++) {
    putRow(take, samples, f, dofs);
    const pose = swappedPose(skeleton, reflection, dofs);
    for (const column of columns) moveColumn(samples, column, exchange, made, f, f + 1);
    for (let k = Math.max(0, -firstChannel); k < end; k++) {
      const value = pose[firstChannel + k];
      if (made[f * width + k] * scales[k] !== value) made[f * width + k] = value / scales[k];
    }
    if (f % STEP_FRAMES === STEP_FRAMES - 1) yield f / frameCount;
  }
  for (const { joint, channels } of jointRotations(skeleton)) {
    if (exchange.fitted.includes(joint)) unrollColumns({ ...samples, values: made }, channels);
  }
  return made;
}

/** A fit gives any of the angles that are one rotation: each frame gets those nearest to the previous one. */
function unrollColumns(samples: Samples, channels: readonly [number, number, number]): void {
  const { values, scales, frameCount } = samples;
  const columns = channels.map((channel) => columnOf(samples, channel));
  if (columns.some((column) => column < 0)) return;
  const width = scales.length;
  const angles = columns.map((column) =>
    Float64Array.from({ length: frameCount }, (_, f) => values[f * width + column] * scales[column]),
  );
  const [a, b, c] = angles;
  unrollTriples([a, b, c]);
  columns.forEach((column, n) => {
    for (let f = 0; f < frameCount; f++) {
      const at = f * width + column;
      if (values[at] * scales[column] !== angles[n][f]) values[at] = angles[n][f] / scales[column];
    }
  });
}
