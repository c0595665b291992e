/**
 * The cycle of a channel that repeats, and keys outside of it.
 *
 * What repeats is all that lies between the first and the last key. A key before the first or after the last one makes
 * that longer, so that everything which was a repetition is another one. By such a key one can mean three things:
 *
 *     lengthen   just that: the channel repeats with a longer period
 *     bake       whole repetitions become keys first; then the key is inside, and changes what is next to it
 *     inside     the key is put at the same place of the cycle, and every repetition shows it
 */
import { type Channel, type ChannelClip, type KeyedChannel, keysOf, repeats } from '../../model/clip.ts';
import { withExtrapolationBaked } from '../channels/bake-extrapolation.ts';
import { keyAt } from './columns.ts';
import { sameTime } from './same-time.ts';
import { withKeyAt } from './splice.ts';

export const OUTSIDE_CYCLE = ['bake', 'inside', 'lengthen'] as const;
export type OutsideCycle = (typeof OUTSIDE_CYCLE)[number];

/** Where keys outside a cycle go. */
export interface KeyPlacing {
  /** `lengthen` where absent. */
  readonly outsideCycle?: OutsideCycle | undefined;
  /** Seconds of the clip that are baked at least, as far as the channel repeats there; the key's own time where absent. */
  readonly bakedRange?: readonly [number, number] | undefined;
}

/** Seconds from the first key to the last; 0 without keys. */
export function period(channel: Channel): number {
  const { times } = keysOf(channel);
  return times.length ? times[times.length - 1] - times[0] : 0;
}

/** Whether it has a cycle. A single key has none, whatever is done beyond it. */
function hasCycle(channel: Channel): channel is KeyedChannel {
  return (
    channel.kind === 'keys' &&
    (repeats(channel.extrapolateIn) || repeats(channel.extrapolateOut)) &&
    period(channel) > 0
  );
}

export interface ChangedCycle {
  readonly channel: number;
  /** Seconds from one repetition to the next, before and after. */
  readonly from: number;
  readonly to: number;
  /** Of the key that ends the cycle now: where the new cycle begins otherwise than the old one, the first, else the last. */
  readonly timeSeconds: number;
}

/**
 * The channels that repeat with another period than before, ascending. This decides what is asked before keys are added
 * and what is said after they were moved or deleted.
 */
export function changedCycles(
  { channels: before }: Pick<ChannelClip, 'channels'>,
  { channels: after }: Pick<ChannelClip, 'channels'>,
): readonly ChangedCycle[] {
  return after.flatMap((now, channel) => {
    const was = before[channel];
    if (was === now || !was || !hasCycle(was) || !hasCycle(now)) return [];
    const [from, to] = [period(was), period(now)];
    // A loop that is dragged as a whole is as long as it was, but for rounding.
    if (sameTime(from, to)) return [];
    const timeSeconds = now.times[sameTime(was.times[0], now.times[0]) ? now.times.length - 1 : 0];
    return [{ channel, from, to, timeSeconds }];
  });
}

/**
 * The channel with keys for whole repetitions, so that `from` to `to` (seconds of the clip) lies between its keys as far
 * as it repeats there; the very same channel where it does already. It repeats as before, with the longer period, and
 * the curve is the same at every time. (Of a channel that repeats in one way before its keys and in another way after
 * them, this holds for the time up to the outermost keys: no longer cycle has both of its continuations.)
 *
 * Throws a `CommandError` where it would take a million keys.
 */
export function withRepeatsBaked(channel: KeyedChannel, from: number, to: number): KeyedChannel {
  if (!hasCycle(channel)) return channel;
  const { times, extrapolateIn, extrapolateOut } = channel;
  const length = period(channel);
  const [start, stop] = [times[0], times[times.length - 1]];
  // A time on a seam, but for rounding, is the end of the repetition before it.
  const count = (seconds: number) => Math.max(0, Math.ceil(seconds / length - 1e-9));
  const before = repeats(extrapolateIn) ? count(start - from) : 0;
  const after = repeats(extrapolateOut) ? count(to - stop) : 0;
  if (before === 0 && after === 0) return channel;
  const baked = withExtrapolationBaked(channel, start - before * length, stop + after * length);
  const cycling = { ...baked.channel, extrapolateIn, extrapolateOut };
  return withEndSteps(channel, cycling, before, after);
}

/**
 * A step at an end belongs to the cycle: `cycle_offset` counts from the outer key of one end to that of the other. What
 * was baked ends with the inner one, on which the curve borders.
 */
function withEndSteps(
  before: KeyedChannel,
  baked: KeyedChannel,
  turnsBefore: number,
  turnsAfter: number,
): KeyedChannel {
  const end = before.times.length - 1;
  const rise = before.values[end] - before.values[0];
  const { extrapolateIn, extrapolateOut } = before;
  let channel = baked;
  if (turnsAfter > 0 && extrapolateOut !== 'bounce' && before.times[end - 1] === before.times[end]) {
    const stop = channel.times.length;
    const value = before.values[end] + (extrapolateOut === 'cycle_offset' ? turnsAfter * rise : 0);
    channel = withKeyAt(channel, stop, { ...keyAt(before, end), time: channel.times[stop - 1], value });
  }
  if (turnsBefore > 0 && extrapolateIn !== 'bounce' && before.times[0] === before.times[1]) {
    const value = before.values[0] - (extrapolateIn === 'cycle_offset' ? turnsBefore * rise : 0);
    channel = withKeyAt(channel, 0, { ...keyAt(before, 0), time: channel.times[0], value });
  }
  return channel;
}

/** Where a key is put, and into which channel. */
export interface Place<C extends Channel = Channel> {
  /** The very same where nothing had to be baked. */
  readonly channel: C;
  /** Seconds of the clip. */
  readonly time: number;
  /** Subtracted from the key's value: what `cycle_offset` adds to the repetition that the key was meant for. */
  readonly offset: number;
  /** The key was meant for a repetition that runs backwards: its tangents trade places and signs. */
  readonly isMirrored: boolean;
  /** It is not at the time that was asked for, but at the same place of the cycle. */
  readonly isFolded: boolean;
}

/**
 * Where a key at this time is put. `inside` is `bake` on a side that does not repeat: there is no place of the cycle for
 * that time, and the repetitions on the other side would change.
 */
export function placeOf<C extends Channel>(channel: C, time: number, placing: KeyPlacing): Place<C | KeyedChannel> {
  const asked = { channel, time, offset: 0, isMirrored: false, isFolded: false };
  const { outsideCycle = 'lengthen', bakedRange = [time, time] } = placing;
  if (outsideCycle === 'lengthen' || !hasCycle(channel)) return asked;
  const { times } = channel;
  const [start, stop] = [times[0], times[times.length - 1]];
  if ((time >= start && time <= stop) || sameTime(time, start) || sameTime(time, stop)) return asked;
  const side = time < start ? channel.extrapolateIn : channel.extrapolateOut;
  if (outsideCycle === 'inside' && repeats(side)) return { ...asked, ...folded(channel, time, start, stop) };
  const baked = withRepeatsBaked(channel, Math.min(time, bakedRange[0]), Math.max(time, bakedRange[1]));
  return { ...asked, channel: baked };
}

function folded(channel: KeyedChannel, time: number, start: number, stop: number): Omit<Place, 'channel'> {
  const length = stop - start;
  const side = time < start ? channel.extrapolateIn : channel.extrapolateOut;
  let turn = Math.floor((time - start) / length);
  let since = time - start - turn * length;
  if (sameTime(since, length)) {
    turn++;
    since = 0;
  } else if (sameTime(since, 0)) since = 0;
  const isMirrored = side === 'bounce' && turn % 2 !== 0;
  const rise = channel.values[channel.values.length - 1] - channel.values[0];
  return {
    time: isMirrored ? stop - since : start + since,
    offset: side === 'cycle_offset' ? turn * rise : 0,
    isMirrored,
    isFolded: true,
  };
}
