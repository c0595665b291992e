/**
 * Removes keys from a channel. The remaining keys determine the curve; a held step whose key is removed goes on from
 * the flat key before that.
 */
import { type Channel, type KeyedChannel, restChannel } from '../../model/takes/take.ts';
import { FLAT } from '../../model/takes/tangent-kinds.ts';
import { takeKeys } from './columns.ts';
import { isHeld, wholeSteps } from './steps.ts';

/**
 * The channel without some keys; steps are removed as one.
 * @param given indices, ascending
 * @param rest value of the channel if no key is left
 */
export function withKeysRemoved(channel: KeyedChannel, given: readonly number[], rest = 0): Channel {
  const count = channel.times.length;
  const indices = wholeSteps(channel, given);
  if (indices.length === 0) return channel;
  const { extrapolateIn, extrapolateOut } = channel;
  if (indices.length === count) return { ...restChannel(rest), extrapolateIn, extrapolateOut };
  const kept = new Uint32Array(count - indices.length);
  let next = 0;
  let gone = 0;
  for (let k = 0; k < count; k++) {
    if (k === indices[gone]) gone++;
    else kept[next++] = k;
  }
  return withHoldsJoined(channel, kept);
}

function withHoldsJoined(channel: KeyedChannel, kept: Uint32Array): KeyedChannel {
  const taken = takeKeys(channel, kept);
  for (let i = 1; i < kept.length; i++) {
    if (kept[i - 1] === kept[i] - 1 || !isHeld(channel, kept[i])) continue;
    // The columns are new.
    if (taken.tangentsOut.kinds[i - 1] === FLAT) taken.values[i] = taken.values[i - 1];
  }
  return taken;
}
