/** Selecting keys with the keyboard, like clicking them. Pure; keys are indices into a take. */
import { lastNotAbove } from '../../math/search.ts';
import type { ChannelKeys } from '../../model/session.ts';
import { type Channel, keysOf } from '../../model/takes/take.ts';

/**
 * Moves the selection by one key, forwards (`step` 1) or back (−1), in each channel with selected keys: from the last
 * or the first of them. Without a selection it starts at the key nearest to a time, in the first channel of `inView`.
 *
 * @param adds keeps the selected keys selected
 */
export function walkKeys(
  channels: readonly Channel[],
  keys: readonly ChannelKeys[],
  inView: readonly number[],
  takeSeconds: number,
  step: 1 | -1,
  adds: boolean,
): ChannelKeys[] {
  if (!keys.length) {
    const channel = inView.find((c) => channels[c]?.kind === 'keys');
    return channel === undefined
      ? []
      : [{ channel, indices: [nearestKey(keysOf(channels[channel]).times, takeSeconds)] }];
  }
  return keys.map(({ channel, indices }) => {
    const from = step > 0 ? indices[indices.length - 1] : indices[0];
    const to = Math.min(keysOf(channels[channel]).times.length - 1, Math.max(0, from + step));
    if (!adds) return { channel, indices: [to] };
    if (to === from) return { channel, indices };
    return { channel, indices: step > 0 ? [...indices, to] : [to, ...indices] };
  });
}

/** The key nearest in time to the selected one, in the previous or next visible channel; the same if there is none. */
export function walkChannels(
  channels: readonly Channel[],
  keys: readonly ChannelKeys[],
  inView: readonly number[],
  step: 1 | -1,
): readonly ChannelKeys[] {
  const having = inView.filter((c) => channels[c]?.kind === 'keys');
  const from = step > 0 ? keys.at(-1) : keys[0];
  if (!from) return keys;
  const at = having.indexOf(from.channel);
  const channel = at < 0 ? having[0] : having[at + step];
  if (channel === undefined) return keys;
  const time = keysOf(channels[from.channel]).times[from.indices[0]];
  return [{ channel, indices: [nearestKey(keysOf(channels[channel]).times, time)] }];
}

/** Index of the key nearest to a time; the earlier of equally near ones. The channel must have keys. */
export function nearestKey(times: Float64Array, takeSeconds: number): number {
  const before = lastNotAbove(times, 0, times.length, takeSeconds);
  const after = Math.min(times.length - 1, before + 1);
  return Math.abs(times[after] - takeSeconds) < Math.abs(takeSeconds - times[before]) ? after : before;
}
