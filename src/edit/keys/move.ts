/**
 * Moves keys in time and value; steps move in time as one. Drags always pass the total movement from their start.
 * Tangents are kept, since slopes are per second.
 */
import type { KeyedChannel } from '../../model/takes/take.ts';
import { CommandError } from '../command-error.ts';
import { arrangeKeys, type Collision, type EditedChannel, timesFor } from './arrange.ts';
import { isHeld, wholeSteps } from './steps.ts';

/**
 * Keys may pass others; see `arrange.ts` for keys that overlap. The same channel if nothing changes, and the same
 * columns if these don't.
 * @param indices ascending, unique
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
  const whole = wholeSteps(channel, indices);
  const times = timesFor(whole, (k) => channel.times[k] + seconds);
  return arrangeKeys(raised, whole, times, collision);
}

/**
 * The channel with some values changed; the same object if none is. Held steps follow the key before them.
 * @param indices ascending
 * @throws CommandError if a new value is not finite
 */
export function withValues(
  channel: KeyedChannel,
  indices: readonly number[],
  change: (value: number, key: number) => number,
): KeyedChannel {
  const values = channel.values.slice();
  let changed = false;
  const set = (k: number, value: number) => {
    changed ||= value !== values[k];
    values[k] = value;
  };
  for (const k of indices) {
    const value = change(values[k], k);
    if (!Number.isFinite(value)) throw new CommandError('That value is too large.');
    set(k, isHeld(channel, k) ? values[k - 1] : value);
    if (isHeld(channel, k + 1)) set(k + 1, values[k]);
  }
  return changed ? { ...channel, values } : channel;
}
