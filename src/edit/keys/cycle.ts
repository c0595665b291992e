/**
 * The cycle of a repeating channel, and keys outside it.
 *
 * Everything between the first and last key repeats. A key before or after them lengthens the cycle, so that every
 * repetition changes. Such a key can mean three things:
 *
 *     lengthen   just that: the channel repeats with a longer period
 *     bake       whole repetitions become keys first; then the key is inside and changes only what is next to it
 *     inside     the key is put at the same phase of the cycle, and every repetition shows it
 */

import { type Character, shownTake } from '../../model/document.ts';
import { type Channel, type KeyedChannel, keysOf, repeats, type Take } from '../../model/takes/take.ts';
import { withExtrapolationBaked } from '../channels/bake-extrapolation.ts';
import { keyAt } from './columns.ts';
import { sameTime } from './same-time.ts';
import { withKeyAt } from './splice.ts';

/** Ways to treat a key outside the cycle of a repeating channel. */
export const OUTSIDE_CYCLE = ['bake', 'inside', 'lengthen'] as const;
/** Treatment of a key outside a cycle; see `OUTSIDE_CYCLE`. */
export type OutsideCycle = (typeof OUTSIDE_CYCLE)[number];

/** Treatment of keys outside a cycle. */
export interface KeyPlacing {
  /** Default `lengthen`. */
  readonly outsideCycle?: OutsideCycle;
  /**
   * Minimum range to bake, in seconds of the take, as far as the channel repeats there; default: the key's own time.
   */
  readonly bakedRange?: readonly [number, number];
}

/** Seconds from the first key to the last; 0 without keys. */
export function period(channel: Channel): number {
  const { times } = keysOf(channel);
  return times.length ? times[times.length - 1] - times[0] : 0;
}

/** Whether the channel has a cycle. A single key has none, whatever its extrapolation. */
function hasCycle(channel: Channel): channel is KeyedChannel {
  return (
    channel.kind === 'keys' &&
    (repeats(channel.extrapolateIn) || repeats(channel.extrapolateOut)) &&
    period(channel) > 0
  );
}

/** A channel that now repeats with another period. */
export interface ChangedCycle {
  readonly channel: number;
  /** Seconds from one repetition to the next, before and after. */
  readonly from: number;
  readonly to: number;
  /** Time of the key that now ends the cycle: the first if the start of the cycle moved, else the last. */
  readonly timeSeconds: number;
}

/**
 * The channels whose period changed, ascending. Decides whether to ask before adding keys, and what to report after
 * moving or deleting them.
 */
export function changedCycles(
  { channels: before }: Pick<Take, 'channels'>,
  { channels: after }: Pick<Take, 'channels'>,
): readonly ChangedCycle[] {
  return after.flatMap((now, channel) => {
    const was = before[channel];
    if (was === now || !was || !hasCycle(was) || !hasCycle(now)) return [];
    const [from, to] = [period(was), period(now)];
    // A loop moved as a whole keeps its length up to rounding.
    if (sameTime(from, to)) return [];
    const timeSeconds = now.times[sameTime(was.times[0], now.times[0]) ? now.times.length - 1 : 0];
    return [{ channel, from, to, timeSeconds }];
  });
}

/**
 * The changed cycles of the take that a character shows before and after a step; none if take, skeleton or morphs are
 * others.
 */
export function changedCyclesOf(was: Character, now: Character): readonly ChangedCycle[] {
  if (was === now || was.shownTake !== now.shownTake || was.takes.length !== now.takes.length) return [];
  // With other DOFs, channels only change places, together with their keys.
  if (was.skeleton !== now.skeleton || was.morphs !== now.morphs) return [];
  const [before, after] = [shownTake(was), shownTake(now)];
  return before && after && before !== after ? changedCycles(before, after) : [];
}

/**
 * The channels, ascending, that repeat by `cycle` and of which only the first and last key have another value now, the
 * same for both: what keying either end of a closed loop does (`put-key.ts`).
 */
export function keyedEndsOf(was: Character, now: Character): readonly number[] {
  if (was === now || was.shownTake !== now.shownTake || was.takes.length !== now.takes.length) return [];
  if (was.skeleton !== now.skeleton || was.morphs !== now.morphs) return [];
  const before = shownTake(was)?.channels;
  return (shownTake(now)?.channels ?? []).flatMap((channel, index) => {
    const old = before?.[index];
    return old && old !== channel && hasKeyedEnds(old, channel) ? [index] : [];
  });
}

function hasKeyedEnds(was: Channel, now: Channel): boolean {
  if (!hasCycle(was) || !hasCycle(now) || now.values.length !== was.values.length) return false;
  if (now.extrapolateIn !== 'cycle' && now.extrapolateOut !== 'cycle') return false;
  const last = now.values.length - 1;
  if (was.values[0] !== was.values[last] || now.values[0] !== now.values[last]) return false;
  return now.values.every((value, k) => (value !== was.values[k]) === (k === 0 || k === last));
}

/**
 * The channel with keys for whole repetitions, so that `from` to `to` (seconds of the take) lies between its keys as
 * far as it repeats there; the same object if it does already. It repeats with the longer period, and the curve is the
 * same at every time. (If a channel repeats differently before and after its keys, this holds only up to the outermost
 * keys: no longer cycle has both continuations.)
 *
 * Throws a `CommandError` if it would take more than a million keys.
 */
export function withRepeatsBaked(channel: KeyedChannel, from: number, to: number): KeyedChannel {
  if (!hasCycle(channel)) return channel;
  const { times, extrapolateIn, extrapolateOut } = channel;
  const length = period(channel);
  const [start, stop] = [times[0], times[times.length - 1]];
  // A time on a seam, up to rounding, is the end of the repetition before it.
  const count = (seconds: number) => Math.max(0, Math.ceil(seconds / length - 1e-9));
  const before = repeats(extrapolateIn) ? count(start - from) : 0;
  const after = repeats(extrapolateOut) ? count(to - stop) : 0;
  if (before === 0 && after === 0) return channel;
  const baked = withExtrapolationBaked(channel, start - before * length, stop + after * length);
  const cycling = { ...baked.channel, extrapolateIn, extrapolateOut };
  return withEndSteps(channel, cycling, before, after);
}

/**
 * A step at an end belongs to the cycle: `cycle_offset` counts between the outer keys of both ends. Baked repetitions
 * end with the inner one, which borders on the curve.
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
  /** The same object if nothing had to be baked. */
  readonly channel: C;
  /** Seconds of the take. */
  readonly time: number;
  /** Subtracted from the key's value: what `cycle_offset` adds in the repetition the key was meant for. */
  readonly offset: number;
  /** The key was meant for a repetition that runs backwards: its tangents are swapped and negated. */
  readonly isMirrored: boolean;
  /** Not at the requested time but at the same phase of the cycle. */
  readonly isFolded: boolean;
}

/**
 * Where a key at this time is put. On a side that does not repeat, `inside` acts like `bake`: the time has no phase in
 * the cycle, and the repetitions on the other side would change.
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
