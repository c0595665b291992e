/** Removes keys from a channel. The remaining keys determine the curve. */
import { type Channel, type KeyedChannel, restChannel } from '../../model/takes/take.ts';
import { takeKeys } from './columns.ts';

/**
 * The channel without some keys.
 * @param indices ascending
 * @param rest value of the channel if no key is left
 */
export function withKeysRemoved(channel: KeyedChannel, indices: readonly number[], rest = 0): Channel {
  const count = channel.times.length;
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
  return takeKeys(channel, kept);
}
