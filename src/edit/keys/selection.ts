/**
 * Sets of keys, as in the selection: `ChannelKeys` sorted by channel, none empty, indices ascending. All functions
 * preserve that order and merge sorted lists instead of searching, so that selecting all keys of a long take is as fast
 * as selecting one.
 */
import { firstNotBelow } from '../../math/search.ts';
import { perObject } from '../../model/per-object.ts';
import type { ChannelKeys } from '../../model/session.ts';
import { type Channel, keysOf, type Take } from '../../model/takes/take.ts';
import { sameTime } from './same-time.ts';

/** The set without keys; always the same object. */
export const NO_KEY_SELECTION: readonly ChannelKeys[] = [];

/** Every key of these channels (indices into the take's); default: all channels. */
export function allKeys(take: Take, channels?: readonly number[]): readonly ChannelKeys[] {
  return collect(take, channels, (times) => [0, times.length]);
}

/** The keys at a take time; of a step both. */
export function keysAtTime(take: Take, channels: readonly number[] | undefined, time: number): readonly ChannelKeys[] {
  return collect(take, channels, (times) => {
    const near = firstNotBelow(times, time);
    let from = near;
    let to = near;
    while (from > 0 && sameTime(times[from - 1], time)) from--;
    while (to < times.length && sameTime(times[to], time)) to++;
    return [from, to];
  });
}

/** Keys in either set. */
export function unionKeys(a: readonly ChannelKeys[], b: readonly ChannelKeys[]): readonly ChannelKeys[] {
  return combine(a, b, (inA, inB) => inA || inB);
}

/** Keys in only one of the sets: keys of `b` are removed if in `a`, and otherwise added. */
export function toggleKeys(a: readonly ChannelKeys[], b: readonly ChannelKeys[]): readonly ChannelKeys[] {
  return combine(a, b, (inA, inB) => inA !== inB);
}

/** Keys of `a` that are not in `b`. */
export function withoutKeys(a: readonly ChannelKeys[], b: readonly ChannelKeys[]): readonly ChannelKeys[] {
  return combine(a, b, (inA, inB) => inA && !inB);
}

/** Whether the set contains a key. O(log), for picking and drawing. */
export function hasKey(keys: readonly ChannelKeys[] | undefined, channel: number, index: number): boolean {
  const indices = keys?.find((k) => k.channel === channel)?.indices;
  return indices !== undefined && indices[firstNotBelow(indices, index)] === index;
}

/** The number of keys, a step's two as one. @param channels of the take */
export function countKeys(channels: readonly Channel[], keys: readonly ChannelKeys[]): number {
  let count = 0;
  for (const { channel, indices } of keys) {
    const { times } = keysOf(channels[channel]);
    // Keys that no longer exist have no time, and count.
    for (let i = 0; i < indices.length; i++) {
      if (i === 0 || indices[i - 1] !== indices[i] - 1 || times[indices[i] - 1] !== times[indices[i]]) count++;
    }
  }
  return count;
}

/** The number of keys of a channel, a step's two as one; cached. */
export const keyCountOf: (channel: Channel) => number = perObject((channel: Channel) => {
  const { times } = keysOf(channel);
  let count = times.length;
  for (let k = 1; k < times.length; k++) if (times[k] === times[k - 1]) count--;
  return count;
});

/** The keys from one index up to (excluding) another, in each of the channels. */
function collect(
  take: Take,
  channels: readonly number[] | undefined,
  stretch: (times: Float64Array) => readonly [number, number],
): readonly ChannelKeys[] {
  const found: ChannelKeys[] = [];
  const of = channels ? [...new Set(channels)].sort((a, b) => a - b) : take.channels.keys();
  for (const channel of of) {
    const [from, to] = stretch(keysOf(take.channels[channel]).times);
    if (from < to) found.push({ channel, indices: Array.from({ length: to - from }, (_, i) => from + i) });
  }
  return found;
}

/**
 * The keys for which `keep` returns true, given whether each set contains them. An unchanged set keeps its identity.
 */
function combine(
  a: readonly ChannelKeys[],
  b: readonly ChannelKeys[],
  keep: (inA: boolean, inB: boolean) => boolean,
): readonly ChannelKeys[] {
  const combined: ChannelKeys[] = [];
  let i = 0;
  let j = 0;
  while (i < a.length || j < b.length) {
    const first = Math.min(a[i]?.channel ?? Number.POSITIVE_INFINITY, b[j]?.channel ?? Number.POSITIVE_INFINITY);
    const own = a[i]?.channel === first ? a[i++] : undefined;
    const other = b[j]?.channel === first ? b[j++] : undefined;
    if (!other) {
      if (own && keep(true, false)) combined.push(own);
    } else if (!own) {
      if (keep(false, true)) combined.push(other);
    } else {
      const indices = combineIndices(own.indices, other.indices, keep);
      if (indices.length) combined.push({ channel: first, indices });
    }
  }
  return combined;
}

function combineIndices(
  a: readonly number[],
  b: readonly number[],
  keep: (inA: boolean, inB: boolean) => boolean,
): readonly number[] {
  const kept: number[] = [];
  let i = 0;
  let j = 0;
  while (i < a.length || j < b.length) {
    const inA = j >= b.length || a[i] <= b[j];
    const inB = i >= a.length || b[j] <= a[i];
    const index = inA ? a[i] : b[j];
    if (inA) i++;
    if (inB) j++;
    if (keep(inA, inB)) kept.push(index);
  }
  return kept;
}
