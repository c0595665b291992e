/**
 * Copying keys and pasting them at another time, into the same channels or others. Keys are copied, not curves:
 * tangents by kind (`linear`, `smooth`) stay so and adapt to their new neighbours.
 */

import type { ChannelKeys } from '../../model/session.ts';
import type { Channel, KeyedChannel, Keys, Take, Tangents } from '../../model/takes/take.ts';
import { CommandError } from '../command-error.ts';
import { sameValue } from '../delta.ts';
import { arrangeKeys, type EditedChannel } from './arrange.ts';
import { type Key, type Tangent, takeKeys, tangent, withKeyList } from './columns.ts';
import { type KeyPlacing, placeOf } from './cycle.ts';
import { withKeysMoved } from './move.ts';
import { withKeysRemoved } from './remove.ts';
import { sameTime } from './same-time.ts';

/** Keys without their take: plain data that outlives it. */
export interface CopiedKeys {
  /** From the earliest key to the latest. */
  readonly seconds: number;
  /** By channel, ascending; only those with keys. */
  readonly channels: readonly CopiedChannel[];
}

/** The copied keys of one channel, as columns. */
export interface CopiedChannel {
  /** Its character, if keys of several were copied together. */
  readonly characterId?: string;
  /** The source channel. */
  readonly channel: number;
  /** Seconds after the earliest key of all, ascending. */
  readonly times: Float64Array;
  readonly values: Float64Array;
  readonly tangentsIn: Tangents;
  readonly tangentsOut: Tangents;
}

/**
 * Treatment of existing keys:
 *  - merge: a pasted key replaces the one it lands on, all others are kept;
 *  - replace: keys between the first and last pasted key are removed in every target channel;
 *  - insert: keys there and later are moved by the duration of the pasted keys.
 */
export const PASTE_MODES = ['merge', 'replace', 'insert'] as const;
/** Treatment of keys in the pasted range; see `PASTE_MODES`. */
export type PasteMode = (typeof PASTE_MODES)[number];

/** With `insert`, keys are always put at the requested time, since moving later keys changes the cycle anyway. */
export interface Paste extends KeyPlacing {
  /** Take time for the earliest key. */
  readonly timeSeconds: number;
  /** Target channels other than the source: any number for one copied channel, else one for each. */
  readonly into?: readonly number[];
  readonly mode: PasteMode;
}

/** The channels after pasting. */
export interface Pasted {
  /** All channels of the take; unchanged ones keep their identity. */
  readonly channels: readonly Channel[];
  /** The pasted keys. */
  readonly keys: readonly ChannelKeys[];
}

/** Copies keys, with times relative to the earliest one; channels without keys are left out. */
export function copyKeys(take: Take, keys: readonly ChannelKeys[]): CopiedKeys {
  const taken = keys.flatMap(({ channel, indices }) => {
    const own = take.channels[channel];
    return own?.kind === 'keys' && indices.length > 0 ? [{ channel, keys: takeKeys(own, indices) }] : [];
  });
  let first = Number.POSITIVE_INFINITY;
  let last = Number.NEGATIVE_INFINITY;
  for (const { times } of taken.map((t) => t.keys)) {
    first = Math.min(first, times[0]);
    last = Math.max(last, times[times.length - 1]);
  }
  return {
    seconds: taken.length ? last - first : 0,
    channels: taken.map(({ channel, keys: { times, values, tangentsIn, tangentsOut } }) => ({
      channel,
      times: times.map((t) => t - first),
      values,
      tangentsIn,
      tangentsOut,
    })),
  };
}

/** Throws a `CommandError` if the channels don't match. */
export function withKeysPasted(take: Take, copied: CopiedKeys, { timeSeconds, into, mode, ...placing }: Paste): Pasted {
  const channels = [...take.channels];
  const keys: ChannelKeys[] = [];
  for (const { to, from } of destinations(take, copied, into)) {
    const room = makeRoom(channels[to], timeSeconds, copied.seconds, mode);
    const { channel, indices } = joined(room, from, timeSeconds, mode === 'insert' ? {} : placing);
    if (!sameValue(channel, take.channels[to])) channels[to] = channel;
    keys.push({ channel: to, indices });
  }
  return { channels, keys };
}

/** Which keys are pasted where, by ascending channel. */
function destinations(take: Take, { channels }: CopiedKeys, into: readonly number[] | undefined) {
  const targets = into ?? channels.map((c) => c.channel);
  if (channels.length !== 1 && targets.length !== channels.length) {
    throw new CommandError(
      `Keys copied from ${channels.length} channels can only be pasted into ${channels.length} channels, keys from one channel into any number; ` +
        `found ${targets.length}.`,
    );
  }
  if (new Set(targets).size !== targets.length) throw new CommandError('Each channel can be pasted into only once.');
  for (const to of targets) {
    if (take.channels[to]) continue;
    throw new CommandError(`There is no channel ${to} to paste into: ${take.name} has ${take.channels.length}.`);
  }
  return targets.map((to, i) => ({ to, from: channels[channels.length === 1 ? 0 : i] })).sort((a, b) => a.to - b.to);
}

function makeRoom(channel: Channel, time: number, seconds: number, mode: PasteMode): Channel {
  if (mode === 'merge' || channel.kind !== 'keys') return channel;
  const { times } = channel;
  const isAfterStart = (k: number) => times[k] >= time || sameTime(times[k], time);
  const later: number[] = [];
  for (let k = 0; k < times.length; k++) if (isAfterStart(k)) later.push(k);
  if (mode === 'insert') return withKeysMoved(channel, later, seconds, 0).channel;
  const end = time + seconds;
  return withKeysRemoved(
    channel,
    later.filter((k) => times[k] <= end || sameTime(times[k], end)),
  );
}

/** A channel with copied keys merged in: appended, then sorted. */
function joined(channel: Channel, copied: CopiedChannel, time: number, placing: KeyPlacing): EditedChannel {
  const { channel: room, keys } = placed(channel, copied, time, placing);
  const own = room.kind === 'keys' ? room : withKeyList(room, []);
  const both: KeyedChannel = {
    ...own,
    times: concatenated(own.times, keys.times),
    values: concatenated(own.values, keys.values),
    tangentsIn: concatenatedTangents(own.tangentsIn, keys.tangentsIn),
    tangentsOut: concatenatedTangents(own.tangentsOut, keys.tangentsOut),
  };
  const indices = Array.from({ length: keys.times.length }, (_, k) => own.times.length + k);
  return arrangeKeys(both, indices, keys.times, 'replace', true);
}

/** The keys at their take times, and the channel they are pasted into. */
function placed(channel: Channel, copied: CopiedChannel, time: number, placing: KeyPlacing): Placed {
  const times = copied.times.map((t) => time + t);
  const asked = { channel, keys: { ...copied, times } };
  if ((placing.outsideCycle ?? 'lengthen') === 'lengthen') return asked;
  const last = times[times.length - 1];
  const { bakedRange: [from, to] = [time, last] } = placing;
  const range = { ...placing, bakedRange: [Math.min(from, time), Math.max(to, last)] as const };
  const keys: Key[] = [];
  for (let k = 0; k < times.length; k++) {
    const place = placeOf(channel, times[k], range);
    // In a baked channel, all keys are at the requested times.
    if (place.channel !== channel) return { ...asked, channel: place.channel };
    const sides = [copied.tangentsIn, copied.tangentsOut].map(({ kinds, slopes }) => tangent(kinds[k], slopes[k]));
    const [before, after] = place.isMirrored ? sides.map(turned).reverse() : sides;
    keys.push({ time: place.time, value: copied.values[k] - place.offset, in: before, out: after });
  }
  return { channel, keys: withKeyList(channel, keys) };
}

interface Placed {
  readonly channel: Channel;
  readonly keys: Keys;
}

function turned({ kind, slope }: Tangent): Tangent {
  return tangent(kind, 0 - slope);
}

function concatenatedTangents(a: Tangents, b: Tangents): Tangents {
  const kinds = new Uint8Array(a.kinds.length + b.kinds.length);
  kinds.set(a.kinds);
  kinds.set(b.kinds, a.kinds.length);
  return { kinds, slopes: concatenated(a.slopes, b.slopes) };
}

function concatenated(a: Float64Array, b: Float64Array): Float64Array {
  const both = new Float64Array(a.length + b.length);
  both.set(a);
  both.set(b, a.length);
  return both;
}
