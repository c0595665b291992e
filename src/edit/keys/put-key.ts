/** Sets a key with a given value, on the curve or off it: for posing, and for clicks beside a curve. */
import type { Channel, KeyedChannel } from '../../model/takes/take.ts';
import { tangent, withKeyList } from './columns.ts';
import { type KeyPlacing, placeOf } from './cycle.ts';
import { withValues } from './move.ts';
import { countNotAbove, findKey } from './same-time.ts';
import { withKeyAt } from './splice.ts';

/** A channel with the requested key. */
export interface Put {
  readonly channel: KeyedChannel;
  readonly index: number;
}

/**
 * Sets a key at a time. An existing key takes the value and keeps its tangents (of a step the one that applies from
 * then on); returns the same channel if it had that value. Neighbours keep their kinds of tangents, which shape the
 * curve through the new key.
 *
 * @param channel not a sampled one
 * @param kind index into TANGENT_KINDS, for both sides of a new key; a fixed one has slope 0
 */
export function putKey(channel: Channel, time: number, value: number, kind: number): Put {
  const key = { time, value, in: tangent(kind), out: tangent(kind) };
  if (channel.kind !== 'keys') return { channel: withKeyList(channel, [key]), index: 0 };
  const at = findKey(channel, time);
  if (at >= 0) {
    return { channel: withValues(channel, [at], () => value), index: at };
  }
  const index = countNotAbove(channel.times, time);
  return { channel: withKeyAt(channel, index, key), index };
}

/**
 * Puts a key that may lie outside the cycle of a repeating channel (`cycle.ts`): the channel has that value at that
 * time, wherever the key is put. On the seam of a loop, both ends are changed, so that the loop stays closed: keying
 * only one of them would make a jump in every repetition (Blender's *cycle-aware keying*).
 */
export function putKeyAt(channel: Channel, time: number, value: number, kind: number, placing: KeyPlacing): Put {
  const place = placeOf(channel, time, placing);
  const put = putKey(place.channel, place.time, value - place.offset, kind);
  if (place.channel.kind !== 'keys') return put;
  return { ...put, channel: withClosedSeam(place.channel, put.channel, place.isFolded) };
}

/**
 * Changes the last key along with the first, or the first with the last, if a loop continues from one to the other. A
 * `cycle_offset` keeps its rise only if the key was meant for another repetition: it never jumps, and keying its own
 * end is meant to change how far it goes.
 */
function withClosedSeam(before: KeyedChannel, after: KeyedChannel, isFolded: boolean): KeyedChannel {
  const last = before.times.length - 1;
  if (after.times.length !== before.times.length || last === 0) return after;
  const byFirst = after.values[0] - before.values[0];
  const byLast = after.values[last] - before.values[last];
  if ((byFirst === 0) === (byLast === 0)) return after;
  const ways = [before.extrapolateIn, before.extrapolateOut];
  const values = after.values.slice();
  if (before.values[0] === before.values[last] && ways.includes('cycle')) {
    if (byFirst !== 0) values[last] = values[0];
    else values[0] = values[last];
  } else if (isFolded && byFirst !== 0 && ways.includes('cycle_offset')) values[last] += byFirst;
  else return after;
  return { ...after, values };
}
