/**
 * Converts samples to keys: a key with linear tangents on every frame, so that the curve passes through every sample
 * and is straight in between. Needed for `.anim`, which has no samples.
 *
 * Angles are made continuous first (`channels/euler-filter.ts`): a joint at 179° in one frame and −179° in the next
 * must not spin in between. The rotation at every frame is unchanged. Between frames samples rotate a joint along the
 * shortest arc, keys each angle separately; at mocap rates the difference is invisible.
 */
import { turnedDofs, turningDofs } from '../../evaluate/rotations/euler-dofs.ts';
import { firstDofs } from '../../model/skeleton/dofs.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { columnOf, type Samples } from '../../model/takes/samples.ts';
import type { Channel, KeyedChannel, Take, Tangents } from '../../model/takes/take.ts';
import { LINEAR } from '../../model/takes/tangent-kinds.ts';
import { filterRotations, unrollAngle } from '../channels/euler-filter.ts';
import { simplifyChannel } from '../channels/simplify.ts';

/** Options of converting samples to keys. */
export interface SampleKeyOptions {
  /**
   * Keys are removed as long as every curve stays within this tolerance; radians or length units. 0: none are removed.
   */
  readonly tolerance?: number;
}

/**
 * A take with keys only: sampled channels are converted, all others keep their identity. The take itself if it has no
 * samples.
 * @param skeleton whose DOFs the channels drive: tells which of them are angles
 */
export function keyedTake(take: Take, skeleton: Skeleton | undefined, options: SampleKeyOptions = {}): Take {
  const { samples, ...rest } = take;
  if (!samples) return take;
  const shared = sharedColumns(samples);
  const made = new Map<number, KeyedChannel>();
  take.channels.forEach((channel, c) => {
    if (channel.kind === 'samples') made.set(c, keyed(channel, samples, c, shared));
  });
  if (skeleton) unwind(made, skeleton);
  const tolerance = options.tolerance ?? 0;
  if (tolerance > 0) for (const [c, channel] of made) made.set(c, simplifyChannel(channel, tolerance).channel);
  return { ...rest, channels: take.channels.map((channel, c) => made.get(c) ?? channel) };
}

/** Columns that the channels of one take share; none of it ever changes. */
function sharedColumns({ frameCount, frameSeconds, startSeconds }: Samples) {
  const times = new Float64Array(frameCount);
  for (let f = 0; f < frameCount; f++) times[f] = startSeconds + f * frameSeconds;
  const linear: Tangents = {
    kinds: new Uint8Array(frameCount).fill(LINEAR),
    slopes: new Float64Array(frameCount),
  };
  return { times, tangentsIn: linear, tangentsOut: linear };
}

function keyed(
  { extrapolateIn, extrapolateOut }: Channel,
  samples: Samples,
  channel: number,
  shared: ReturnType<typeof sharedColumns>,
): KeyedChannel {
  const { frameCount, scales, values: rows } = samples;
  const column = columnOf(samples, channel);
  const values = new Float64Array(frameCount);
  for (let f = 0; f < frameCount; f++) values[f] = rows[f * scales.length + column] * scales[column];
  return { kind: 'keys', extrapolateIn, extrapolateOut, values, ...shared };
}

/** Removes jumps of angles, in place. */
function unwind(channels: Map<number, KeyedChannel>, skeleton: Skeleton): void {
  const starts = firstDofs(skeleton);
  skeleton.joints.forEach(({ motion }, j) => {
    const first = starts[j];
    const euler = turnedDofs(motion);
    const together = euler ? [euler.x, euler.y, euler.z].map((dof) => first + dof) : [];
    const [x, y, z] = together.map((c) => channels.get(c));
    if (euler && x && y && z) {
      filterRotations([x, y, z], euler.order).forEach((channel, i) => {
        channels.set(together[i], channel);
      });
      return;
    }
    turningDofs(motion).forEach((turns, d) => {
      const angle = turns && channels.get(first + d);
      if (angle) channels.set(first + d, unrollAngle(angle));
    });
  });
}
