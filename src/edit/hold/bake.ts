/**
 * Bakes held frames into the take: as few keys as possible in keyed channels, frames in sampled ones.
 *
 * Keys are first created on every frame, and then thinned (`channels/simplify.ts`) with a tolerance per DOF, by how far
 * it can move its descendants. Joints and pins are measured at all frames and halfway between, with all keys and with
 * few; the tolerance of those that deviate too much is reduced until none does. Like *Convert to keys*.
 */
import { compileSkeleton } from '../../evaluate/kinematics.ts';
import type { Steps } from '../../evaluate/steps.ts';
import type { Character } from '../../model/document.ts';
import type { Pin } from '../../model/ik.ts';
import { characterDofs } from '../../model/skeleton/dofs.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { columnOf } from '../../model/takes/samples.ts';
import type { Take } from '../../model/takes/take.ts';
import { simplifyChannel } from '../channels/simplify.ts';
import { replacingColumns } from '../samples/columns.ts';
import { firstFrameFrom } from '../samples/frames.ts';
import type { HeldFrames } from './frames.ts';
import { armOf, distances, withHalves } from './measure.ts';
import { replaceStretch } from './replace-curve.ts';
import type { HoldWindow } from './window.ts';

/** Initial fraction of the tolerance for a channel. */
const FIRST_SHARE = 0.5;
/** After this many rounds the reduction is faster, and after this many doubles are too coarse for the tolerance. */
const PATIENT_ROUNDS = 6;
const MAX_ROUNDS = 20;

/** The take with a key on every frame replacing the DOFs' values there; sampled takes have their own frames. */
export function* bakingFrames(
  take: Take,
  { times, weights, corners }: HoldWindow,
  { held, width }: HeldFrames,
  changed: readonly number[],
): Steps<Take> {
  const channels = [...take.channels];
  const columns = new Map<number, Float64Array>();
  for (const dof of changed) {
    const values = times.map((_, f) => held[f * width + dof]);
    if (channels[dof]?.kind === 'samples') columns.set(columnOf(take.samples, dof), values);
    else {
      const [startsOnCurve, endsOnCurve] = [weights[0] === 0, weights[weights.length - 1] === 0];
      channels[dof] = replaceStretch(channels[dof], { times, values, corners, startsOnCurve, endsOnCurve }, take.range);
    }
  }
  const { samples } = take;
  if (!samples || columns.size === 0) return { ...take, channels };
  // Frames outside the hold are not changed at all.
  const [from, to] = [weights[0] === 0 ? 1 : 0, times.length - (weights[weights.length - 1] === 0 ? 1 : 0)];
  for (const [column, values] of columns) columns.set(column, values.subarray(from, to));
  const first = firstFrameFrom(samples, times[from]);
  return { ...take, channels, samples: yield* replacingColumns(samples, columns, first) };
}

/** Removes keys in the window while all joints and pins stay within `tolerance`, in lengths. */
export function* thinning(
  character: Character,
  skeleton: Skeleton,
  pins: readonly Pin[],
  dense: Take,
  { times }: HoldWindow,
  changed: readonly number[],
  tolerance: number,
): Steps<Take> {
  const range = [times[0], times[times.length - 1]] as const;
  const reach = reachBelow(skeleton, pins);
  const dofs = characterDofs(skeleton, []);
  const keyed = changed.filter((dof) => dense.channels[dof].kind === 'keys');
  const allowed = new Map(
    keyed.map((dof) => [dof, firstTolerance(dofs[dof].unit === 'length', reach[dofs[dof].joint], tolerance)]),
  );
  if (allowed.size === 0) return dense;
  const seen = withHalves(times);
  const channels = [...dense.channels];
  let todo = [...allowed.keys()];
  for (let round = 0; ; round++) {
    for (const dof of todo) {
      const own = dense.channels[dof];
      if (own.kind === 'keys') channels[dof] = simplifyChannel(own, allowed.get(dof) ?? tolerance, range).channel;
      yield 1 - 0.5 ** round;
    }
    const thin = { ...dense, channels: [...channels] };
    const excess = belowIncluded(skeleton, distances(character, skeleton, pins, [dense, thin], seen));
    todo = [];
    for (const [dof, own] of allowed) {
      const off = excess[dofs[dof].joint] / tolerance;
      if (!(off > 1)) continue;
      allowed.set(dof, own * (round < PATIENT_ROUNDS ? Math.max(0.3, 0.9 / off) : 0.1));
      todo.push(dof);
    }
    if (todo.length === 0) return thin;
    if (round === MAX_ROUNDS) return dense;
  }
}

function firstTolerance(isLength: boolean, reach: number, tolerance: number): number {
  return FIRST_SHARE * (isLength ? tolerance : tolerance / Math.max(reach, 1e-9 * tolerance));
}

/** By joint, the farthest that any descendant joint or pin can be: the total bone length to it. */
function reachBelow(skeleton: Skeleton, pins: readonly Pin[]): Float64Array {
  const { joints } = skeleton;
  const reach = new Float64Array(joints.length);
  const arm = armOf(skeleton);
  for (const { joint, point, holdsOrientation } of pins) {
    reach[joint] = Math.max(reach[joint], Math.hypot(...point) + (holdsOrientation ? arm : 0));
  }
  for (let j = joints.length - 1; j > 0; j--) {
    const { parent, offset } = joints[j];
    reach[parent] = Math.max(reach[parent], reach[j] + Math.hypot(...offset));
  }
  return reach;
}

/** By joint, the maximum over itself and its descendants, in place. */
function belowIncluded(skeleton: Skeleton, values: Float64Array): Float64Array {
  const { parent } = compileSkeleton(skeleton);
  for (let j = values.length - 1; j > 0; j--) values[parent[j]] = Math.max(values[parent[j]], values[j]);
  return values;
}
