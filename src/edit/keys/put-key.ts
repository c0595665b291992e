/** A key with a value of its own, on the curve or off it: posing, and clicking beside a curve. */
import type { Channel, KeyedChannel } from '../../model/clip.ts';
import { tangent, withKeyList } from './columns.ts';
import { type KeyPlacing, placeOf } from './cycle.ts';
import { countNotAbove, findKey } from './same-time.ts';
import { withKeyAt } from './splice.ts';

/** A channel with the key that was asked for. */
export interface Put {
  readonly channel: KeyedChannel;
  readonly index: number;
}

/**
 * Puts a key at a time. Where there is one already it takes the value and keeps its tangents (of a step the key that
 * holds from then on); the very same channel comes back where it had that value. Neighbours keep their kinds, so that
 * the curve passes through the new key as they say.
 *
 * @param channel not a sampled one
 * @param kind index into TANGENT_KINDS, for both sides of a new key; a fixed one has slope 0
 */
export function putKey(channel: Channel, time: number, value: number, kind: number): Put {
  const key = { time, value, in: tangent(kind), out: tangent(kind) };
  if (channel.kind !== 'keys') return { channel: withKeyList(channel, [key]), index: 0 };
  const at = findKey(channel, time);
  if (at >= 0) {
    if (channel.values[at] === value) return { channel, index: at };
    const values = channel.values.slice();
    values[at] = value;
    return { channel: { ...channel, values }, index: at };
  }
  const index = countNotAbove(channel.times, time);
  return { channel: withKeyAt(channel, index, key), index };
}

/**
 * The same outside the cycle of a channel that repeats (`cycle.ts`): the channel has that value at that time, whichever
 * place the key is given. Where it is put on the seam of a loop, both ends of the loop move, so that none opens.
 */
export function putKeyAt(channel: Channel, time: number, value: number, kind: number, placing: KeyPlacing): Put {
  const place = placeOf(channel, time, placing);
  const put = putKey(place.channel, place.time, value - place.offset, kind);
  if (!place.isFolded || channel.kind !== 'keys') return put;
  return { ...put, channel: withClosedSeam(channel, put.channel) };
}

/** The last key moved along with the first one, where a loop goes on from one to the other. */
function withClosedSeam(before: KeyedChannel, after: KeyedChannel): KeyedChannel {
  const last = before.times.length - 1;
  if (after.times.length !== before.times.length || after.values[0] === before.values[0]) return after;
  const ways = [before.extrapolateIn, before.extrapolateOut];
  const isClosed = before.values[0] === before.values[last] && ways.includes('cycle');
  if (!isClosed && !ways.includes('cycle_offset')) return after;
  const values = after.values.slice();
  values[last] += after.values[0] - before.values[0];
  return { ...after, values };
}
