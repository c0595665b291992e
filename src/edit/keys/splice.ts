/** Inserting a key into a channel's columns. */
import type { KeyedChannel, Tangents } from '../../model/takes/take.ts';
import type { Key, Tangent } from './columns.ts';

/** The channel with another key at `index`. All columns are new. */
export function withKeyAt(channel: KeyedChannel, index: number, key: Key): KeyedChannel {
  return {
    ...channel,
    times: spliced(channel.times, index, key.time),
    values: spliced(channel.values, index, key.value),
    tangentsIn: splicedTangents(channel.tangentsIn, index, key.in),
    tangentsOut: splicedTangents(channel.tangentsOut, index, key.out),
  };
}

function splicedTangents({ kinds, slopes }: Tangents, index: number, { kind, slope }: Tangent): Tangents {
  const longer = new Uint8Array(kinds.length + 1);
  longer.set(kinds.subarray(0, index));
  longer[index] = kind;
  longer.set(kinds.subarray(index), index + 1);
  return { kinds: longer, slopes: spliced(slopes, index, slope) };
}

function spliced(column: Float64Array, index: number, value: number): Float64Array {
  const longer = new Float64Array(column.length + 1);
  longer.set(column.subarray(0, index));
  longer[index] = value;
  longer.set(column.subarray(index), index + 1);
  return longer;
}
