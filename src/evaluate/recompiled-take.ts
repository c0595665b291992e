/**
 * Where takes are edited: copies what of a take is compiled already.
 *
 *     provideReuse(RECOMPILED);
 */
import type { KeyedChannel, Motion } from '../model/takes/take.ts';
import type { CompiledTake, Reuse } from './compiled-take.ts';

/** Where a channel was last compiled; after an edit of one channel all others are copied from there. */
const homes = new WeakMap<KeyedChannel, { readonly take: WeakRef<CompiledTake>; readonly index: number }>();

/** The take compiled last, possibly the one before an edit. */
let latest: WeakRef<Motion> | undefined;

/** Copies what is compiled already. */
export const RECOMPILED: Reuse = {
  channel(channel, to, index) {
    const home = homes.get(channel);
    const from = home?.take.deref();
    if (home && from) copyChannel(from, home.index, to, index);
    return from !== undefined;
  },
  spans(channel, to, index) {
    const before = latest?.deref()?.channels[index];
    if (before?.kind === 'keys') return copySameSpans(channel, before, to, to.firstKey[index]);
    return [0, channel.times.length - 1];
  },
  note(take, reference) {
    latest = new WeakRef(take);
    take.channels.forEach((channel, index) => {
      if (channel.kind === 'keys') homes.set(channel, { take: reference, index });
    });
  },
};

/** Shorter channels are faster to compile than to compare. */
const LONG_CHANNEL = 512;

/**
 * Copies the cubics of spans that did not change; a span depends on its two keys and their two neighbours.
 *
 *     keys      the same: head      others      the same: tail
 *     spans     0 … head − 3      [from, end)      count − tail + 1 … last − 1
 *
 * @returns the range of spans, end excluded, that has to be compiled
 */
function copySameSpans(
  channel: KeyedChannel,
  before: KeyedChannel,
  to: CompiledTake,
  next: number,
): readonly [number, number] {
  const count = channel.times.length;
  const all = [0, count - 1] as const;
  if (count < LONG_CHANNEL || before.times.length < LONG_CHANNEL) return all;
  const home = homes.get(before);
  const source = home?.take.deref();
  if (!home || !source) return all;
  const columns = columnsOf(channel);
  const others = columnsOf(before);
  const most = Math.min(count, before.times.length);
  let head = most;
  let tail = most;
  columns.forEach((column, c) => {
    head = sameHead(column, others[c], head);
    tail = sameTail(column, others[c], tail);
  });
  const from = Math.max(0, head - 2);
  const end = Math.max(from, count - tail + 1);
  const first = source.firstKey[home.index];
  to.cubics.set(source.cubics.subarray(4 * first, 4 * (first + from)), 4 * next);
  if (end >= count - 1) return [from, count - 1];
  const shift = before.times.length - count;
  const rest = source.cubics.subarray(4 * (first + end + shift), 4 * (first + count - 1 + shift));
  to.cubics.set(rest, 4 * (next + end));
  return [from, end];
}

type Column = Float64Array | Uint8Array;

function columnsOf({ times, values, tangentsIn, tangentsOut }: KeyedChannel): readonly Column[] {
  return [times, values, tangentsIn.kinds, tangentsIn.slopes, tangentsOut.kinds, tangentsOut.slopes];
}

/** Number of equal elements at the beginning, at most `most`. */
function sameHead(a: Column, b: Column, most: number): number {
  if (a === b) return most;
  let same = 0;
  while (same < most && a[same] === b[same]) same++;
  return same;
}

/** Number of equal elements at the end, at most `most`. */
function sameTail(a: Column, b: Column, most: number): number {
  if (a === b) return most;
  let same = 0;
  while (same < most && a[a.length - 1 - same] === b[b.length - 1 - same]) same++;
  return same;
}

function copyChannel(from: CompiledTake, channel: number, to: CompiledTake, index: number): void {
  const first = from.firstKey[channel];
  const end = from.firstKey[channel + 1];
  const next = to.firstKey[index];
  to.times.set(from.times.subarray(first, end), next);
  to.cubics.set(from.cubics.subarray(4 * first, 4 * end), 4 * next);
  to.extrapolations.set(from.extrapolations.subarray(2 * channel, 2 * channel + 2), 2 * index);
  to.beyond.set(from.beyond.subarray(4 * channel, 4 * channel + 4), 4 * index);
}
