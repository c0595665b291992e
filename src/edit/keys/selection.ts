/**
 * Sets of keys, as the selection holds them: `ChannelKeys` sorted by channel, none without a key, indices ascending.
 * Everything here keeps that order, and merges sorted lists rather than searching in them: all the keys of a long clip
 * are selected as fast as one.
 */
import { firstNotBelow } from '../../math/search.ts';
import { type ChannelClip, keysOf } from '../../model/clip.ts';
import type { ChannelKeys } from '../../model/session.ts';
import { sameTime } from './same-time.ts';

export const NO_KEY_SELECTION: readonly ChannelKeys[] = [];

/** Every key of these channels (indices into the clip's), of all channels if none are given. */
export function allKeys(clip: ChannelClip, channels?: readonly number[]): readonly ChannelKeys[] {
  return collect(clip, channels, (times) => [0, times.length]);
}

/** The keys at a moment of the clip: of a step both. */
export function keysAtTime(
  clip: ChannelClip,
  channels: readonly number[] | undefined,
  time: number,
): readonly ChannelKeys[] {
  return collect(clip, channels, (times) => {
    const near = firstNotBelow(times, time);
    let from = near;
    let to = near;
    while (from > 0 && sameTime(times[from - 1], time)) from--;
    while (to < times.length && sameTime(times[to], time)) to++;
    return [from, to];
  });
}

/** Those in either. */
export function unionKeys(a: readonly ChannelKeys[], b: readonly ChannelKeys[]): readonly ChannelKeys[] {
  return combine(a, b, (inA, inB) => inA || inB);
}

/** Those in one of them only: keys of `b` that `a` has leave it, the others join. */
export function toggleKeys(a: readonly ChannelKeys[], b: readonly ChannelKeys[]): readonly ChannelKeys[] {
  return combine(a, b, (inA, inB) => inA !== inB);
}

/** Those of `a` that are not in `b`. */
export function withoutKeys(a: readonly ChannelKeys[], b: readonly ChannelKeys[]): readonly ChannelKeys[] {
  return combine(a, b, (inA, inB) => inA && !inB);
}

/** Whether a key is among them. O(log), for picking and drawing. */
export function hasKey(keys: readonly ChannelKeys[] | undefined, channel: number, index: number): boolean {
  const indices = keys?.find((k) => k.channel === channel)?.indices;
  return indices !== undefined && indices[firstNotBelow(indices, index)] === index;
}

export function countKeys(keys: readonly ChannelKeys[] | undefined): number {
  let count = 0;
  for (const { indices } of keys ?? []) count += indices.length;
  return count;
}

/** The keys from one index up to, not including, another, of each of the channels. */
function collect(
  clip: ChannelClip,
  channels: readonly number[] | undefined,
  stretch: (times: Float64Array) => readonly [number, number],
): readonly ChannelKeys[] {
  const found: ChannelKeys[] = [];
  const of = channels ? [...new Set(channels)].sort((a, b) => a - b) : clip.channels.keys();
  for (const channel of of) {
    const [from, to] = stretch(keysOf(clip.channels[channel]).times);
    if (from < to) found.push({ channel, indices: Array.from({ length: to - from }, (_, i) => from + i) });
  }
  return found;
}

/** The keys of two sets for which `keep` says so, by whether each set has them. A set that stays whole stays itself. */
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
