/**
 * The Euler filter for a take: the same rotations, at every key and in every frame, with angles that don't jump.
 *
 * Frames are treated as evenly spaced keys and filtered like keys (`channels/rotations.ts`): joint by joint, within
 * enforced limits. Sampled channels stay sampled: only the numbers in their columns change, by whole turns or to the
 * other triple of the same rotation. Between frames nothing changes, since samples interpolate rotations; the curves
 * do, and so do keys and files made from them.
 */

import { type Steps, within } from '../../evaluate/steps.ts';
import type { Character } from '../../model/document.ts';
import { characterDofs } from '../../model/skeleton/dofs.ts';
import { columnOf, type Samples } from '../../model/takes/samples.ts';
import type { Channel, KeyedChannel, Take } from '../../model/takes/take.ts';
import { keysChanged } from '../channels/euler-filter.ts';
import { filterCharacter } from '../channels/rotations.ts';
import { replacingColumns, takingColumns } from './columns.ts';

/** A take after the Euler filter. */
export interface FilteredTake {
  /** The same channels and samples if nothing changed. */
  readonly take: Take;
  /** Channels that changed. */
  readonly changed: readonly number[];
  /** Keys whose values changed; frames of samples are not counted. */
  readonly keysChanged: number;
  /** Sentences on what was not done, and why. */
  readonly notes: readonly string[];
}

/**
 * Applies the Euler filter to channels of a take, joint by joint.
 * @param given channels of the take, keyed or sampled. Yields after each joint
 */
export function* filteringAngles(character: Character, take: Take, given: readonly number[]): Steps<FilteredTake> {
  const { samples } = take;
  const sampled = given.filter((channel) => take.channels[channel]?.kind === 'samples');
  const before = [...take.channels];
  if (samples && sampled.length > 0) {
    const columns = sampled.map((channel) => columnOf(samples, channel));
    const taken = yield* within(takingColumns(samples, columns), 0, 0.2);
    const times = frameTimes(samples);
    sampled.forEach((channel, n) => {
      before[channel] = framesAsKeys(take.channels[channel], times, taken.get(columns[n]) ?? new Float64Array(0));
    });
  }
  let after: readonly Channel[] = before;
  const notes: string[] = [];
  const groups = byJoint(character, given);
  for (const [done, group] of groups.entries()) {
    const filtered = filterCharacter(character, after, group);
    after = filtered.channels;
    notes.push(...filtered.notes);
    yield 0.2 + (0.6 * (done + 1)) / groups.length;
  }
  const changed = given.filter((channel) => after[channel] !== before[channel]);
  if (changed.length === 0) return { take, changed, keysChanged: 0, notes };
  const columns = new Map<number, Float64Array>();
  const channels = [...take.channels];
  for (const index of changed) {
    const channel = after[index];
    if (take.channels[index]?.kind !== 'samples') channels[index] = channel;
    else if (channel.kind === 'keys') columns.set(columnOf(samples, index), channel.values);
  }
  const result = { changed, keysChanged: keysChanged(take.channels, channels), notes };
  if (!samples) return { take: { ...take, channels }, ...result };
  const made = yield* within(replacingColumns(samples, columns), 0.8, 1);
  return { take: { ...take, channels, samples: made }, ...result };
}

function frameTimes({ frameCount, startSeconds, frameSeconds }: Samples): Float64Array {
  return Float64Array.from({ length: frameCount }, (_, f) => startSeconds + f * frameSeconds);
}

/** A key per frame, without tangents, of which the filter only changes numeric ones. */
function framesAsKeys(
  { extrapolateIn, extrapolateOut }: Channel,
  times: Float64Array,
  values: Float64Array,
): KeyedChannel {
  const none = { kinds: new Uint8Array(0), slopes: new Float64Array(0) };
  return { kind: 'keys', extrapolateIn, extrapolateOut, times, values, tangentsIn: none, tangentsOut: none };
}

/** The channels grouped by joint, in the order of each joint's first; those without a joint alone. */
function byJoint({ skeleton, morphs }: Character, given: readonly number[]): readonly (readonly number[])[] {
  const dofs = characterDofs(skeleton, morphs);
  const groups = new Map<number | string, number[]>();
  for (const channel of given) {
    const joint = dofs[channel]?.joint ?? -1;
    const key = joint < 0 ? `channel ${channel}` : joint;
    const group = groups.get(key);
    if (group) group.push(channel);
    else groups.set(key, [channel]);
  }
  return [...groups.values()];
}
