/**
 * The keys of a row, which are those of its channels together. Nothing is merged beforehand: a query for a time or
 * range costs a binary search per channel, and the result identifies keys by channel and index, as in the selection.
 *
 * Times here are the take’s; the dope sheet shows the transport's, which are less by the character's offset.
 */
import { firstNotBelow } from '../../math/search.ts';
import type { ChannelKeys } from '../../model/session.ts';
import { type Channel, keysOf } from '../../model/takes/take.ts';
import { countNotAbove } from './same-time.ts';
import { countKeys, keyCountOf } from './selection.ts';

/** The keys of these channels from one time to another, both included. */
export function keysBetween(
  channels: readonly Channel[],
  of: readonly number[],
  from: number,
  to: number,
): ChannelKeys[] {
  const found: ChannelKeys[] = [];
  for (const channel of of) {
    const { times } = keysOf(channels[channel]);
    const first = firstNotBelow(times, from);
    const end = countNotAbove(times, to);
    if (end > first) found.push({ channel, indices: indexRange(first, end) });
  }
  return found;
}

/** Time of the key nearest to a time; undefined if there is none within `reach` seconds. */
export function nearestKeyTime(
  channels: readonly Channel[],
  of: readonly number[],
  time: number,
  reach: number,
): number | undefined {
  let best: number | undefined;
  let least = reach;
  for (const channel of of) {
    const { times } = keysOf(channels[channel]);
    const after = firstNotBelow(times, time);
    for (let i = Math.max(0, after - 1); i <= after && i < times.length; i++) {
      const distance = Math.abs(times[i] - time);
      if (distance > least || (distance === least && best !== undefined)) continue;
      least = distance;
      best = times[i];
    }
  }
  return best;
}

/** Number of keys in the row, a step's two as one. */
export function keyCount(channels: readonly Channel[], of: readonly number[]): number {
  let count = 0;
  for (const channel of of) if (channels[channel]) count += keyCountOf(channels[channel]);
  return count;
}

/** Number of selected ones, a step's two as one. */
export function selectedCount(
  channels: readonly Channel[],
  of: readonly number[],
  selected: readonly ChannelKeys[],
): number {
  let count = 0;
  let s = 0;
  // Both are in channel order.
  for (const channel of of) {
    while (s < selected.length && selected[s].channel < channel) s++;
    if (s < selected.length && selected[s].channel === channel) count += countKeys(channels, [selected[s]]);
  }
  return count;
}

/** First and last time of some keys; undefined without keys. Keys that no longer exist are ignored. */
export function spanOf(channels: readonly Channel[], keys: readonly ChannelKeys[]): [number, number] | undefined {
  let from = Infinity;
  let to = -Infinity;
  for (const { channel, indices } of keys) {
    const { times } = keysOf(channels[channel]);
    // Ascending like the times, so that the first and last are the ends.
    const last = indices[indices.length - 1];
    if (last === undefined || last >= times.length) continue;
    from = Math.min(from, times[indices[0]]);
    to = Math.max(to, times[last]);
  }
  return from <= to ? [from, to] : undefined;
}

/** Whether all of `keys` are in `selected`. */
export function areSelected(keys: readonly ChannelKeys[], selected: readonly ChannelKeys[]): boolean {
  return keys.every(({ channel, indices }) => {
    const own = indicesIn(selected, channel);
    return own !== undefined && indices.every((i) => own[firstNotBelow(own, i)] === i);
  });
}

/** The selected indices of one channel. */
export function indicesIn(keys: readonly ChannelKeys[], channel: number): readonly number[] | undefined {
  let low = 0;
  let high = keys.length;
  while (low < high) {
    const middle = (low + high) >>> 1;
    if (keys[middle].channel < channel) low = middle + 1;
    else high = middle;
  }
  return keys[low]?.channel === channel ? keys[low].indices : undefined;
}

function indexRange(first: number, end: number): number[] {
  const indices = new Array<number>(end - first);
  for (let i = first; i < end; i++) indices[i - first] = i;
  return indices;
}
