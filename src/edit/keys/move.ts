/**
 * Moving keys in time and value, by how far they are moved altogether: a drag is always made from where it began.
 * Tangents go along as they are; a slope is value per second, which moving does not change.
 */
import type { KeyedChannel } from '../../model/clip.ts';
import { CommandError } from '../store.ts';
import { arrangeKeys, type Collision, type EditedChannel, timesFor } from './arrange.ts';

/**
 * Keys cross others freely; what happens where they land on one is said in `arrange.ts`. The very same channel where
 * nothing changes, the very same columns where they don't.
 * @param indices ascending, each once
 * @param seconds added to their times
 * @param value added to their values
 */
export function withKeysMoved(
  channel: KeyedChannel,
  indices: readonly number[],
  seconds: number,
  value: number,
  collision: Collision = 'replace',
): EditedChannel {
  const raised = value === 0 ? channel : withValues(channel, indices, (v) => v + value);
  if (seconds === 0) return { channel: raised, indices };
  const times = timesFor(indices, (k) => channel.times[k] + seconds);
  return arrangeKeys(raised, indices, times, collision);
}

/** The channel with some values changed; the very same where none is. */
export function withValues(
  channel: KeyedChannel,
  indices: readonly number[],
  change: (value: number) => number,
): KeyedChannel {
  const values = channel.values.slice();
  let changed = false;
  for (const k of indices) {
    const value = change(values[k]);
    if (!Number.isFinite(value)) throw new CommandError('That value is too large.');
    changed ||= value !== values[k];
    values[k] = value;
  }
  return changed ? { ...channel, values } : channel;
}
