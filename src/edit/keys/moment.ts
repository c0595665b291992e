/**
 * A pose for a moment, over motion that continues: a curve is offset by what was posed, eased in before that time and
 * out after it.
 *
 *     value(t) = take(t) + w(t) · (posed − take(at))
 *
 *     w    1            ╭─╮            smoothstep on both sides: a cubic each, so that the sum with the take's cubics has
 *                     ╭─╯ ╰─╮          keys at the same times and is exact
 *          0   ───────╯     ╰───────
 *            at − easeIn  at  at + easeOut
 *
 * At the time itself the curve has the posed value to the digit, and outside the moment it is the take's.
 */
import { compileChannels } from '../../evaluate/compiled-take.ts';
import { evaluateChannel } from '../../evaluate/curves.ts';
import { resolvedSlopes } from '../../evaluate/slopes.ts';
import { columnOf, type Samples } from '../../model/takes/samples.ts';
import { type Channel, type KeyedChannel, repeats } from '../../model/takes/take.ts';
import { FIXED_TANGENT } from '../../model/takes/tangent-kinds.ts';
import { keyAt, tangent, withKeyList } from './columns.ts';
import { withRepeatsBaked } from './cycle.ts';
import { insertKey } from './insert.ts';
import { findKey, sameTime } from './same-time.ts';

/** Seconds of the take. */
export interface Moment {
  readonly at: number;
  /** Greater than 0. */
  readonly easeIn: number;
  readonly easeOut: number;
}

/** The weight of the posed value at a time, 0 … 1. */
export function weightAt({ at, easeIn, easeOut }: Moment, time: number): number {
  const part = partAt({ at, easeIn, easeOut }, time);
  return part * part * (3 - 2 * part);
}

/** Its slope, per second. */
function weightSlope(moment: Moment, time: number): number {
  const part = partAt(moment, time);
  const way = time < moment.at ? 1 / moment.easeIn : -1 / moment.easeOut;
  return 6 * part * (1 - part) * way;
}

/** How far a time is eased in, 0 … 1. */
function partAt({ at, easeIn, easeOut }: Moment, time: number): number {
  const away = time < at ? (at - time) / easeIn : (time - at) / easeOut;
  return Math.max(0, 1 - away);
}

/**
 * A channel that has the value at the moment's time. A repeating one gets keys for its repetitions first, so that only
 * this one changes; with them it repeats over the longer time.
 *
 * @param channel not a sampled one
 * @param range at least what the repetitions are baked over, in seconds of the take
 */
export function withMoment(
  channel: Channel,
  asked: Moment,
  value: number,
  range: readonly [number, number],
): KeyedChannel {
  const { at } = asked;
  const [from, to] = [at - asked.easeIn, at + asked.easeOut];
  const whole =
    channel.kind === 'keys'
      ? withRepeatsBaked(channel, Math.min(from, range[0]), Math.max(to, range[1]))
      : insertKey(channel, at).channel;
  const moment = withinCycle(whole, asked);
  const times = [at - moment.easeIn, at, at + moment.easeOut];
  const keyed = times.reduce((before, time) => insertKey(before, time).channel, whole);
  const offset = value - evaluateChannel(compileChannels([keyed]), 0, at);
  const slopes = resolvedSlopes(keyed);
  const [first, middle, last] = times.map((time) => findKey(keyed, time));
  const keys = Array.from(keyed.times, (time, k) => {
    const key = keyAt(keyed, k);
    const isOutside = (time < at && k < first && !sameTime(time, times[0])) || k > last;
    if (isOutside) return key;
    const isAt = sameTime(time, at);
    // At both ends exactly 0, although their keys may have been there up to rounding.
    const isEnd = k <= first || k >= last;
    const slope = isAt || isEnd ? 0 : offset * weightSlope(moment, time);
    return {
      // A key that is there up to rounding is moved by that: the value is to be exact at this very time.
      time: isAt ? at : time,
      value: k === middle ? value : key.value + offset * (isAt ? 1 : isEnd ? 0 : weightAt(moment, time)),
      in: tangent(FIXED_TANGENT, slopes.in[k] + slope),
      out: tangent(FIXED_TANGENT, slopes.out[k] + slope),
    };
  });
  return withKeyList(keyed, keys);
}

/** A channel that repeats on one side only keeps its cycle: the moment begins and ends within it, if it is there. */
function withinCycle({ times, extrapolateIn, extrapolateOut }: KeyedChannel, moment: Moment): Moment {
  if (!repeats(extrapolateIn) && !repeats(extrapolateOut)) return moment;
  const { at, easeIn, easeOut } = moment;
  const [before, after] = [at - times[0], times[times.length - 1] - at];
  const least = 1e-6;
  return {
    at,
    easeIn: before > least ? Math.min(easeIn, before) : easeIn,
    easeOut: after > least ? Math.min(easeOut, after) : easeOut,
  };
}

/**
 * Samples in which channels have their values at the moment's time; frames outside it are the same to the bit. Between
 * two frames both have the whole offset.
 *
 * @param values by channel, each of which has a column
 * @param shown the channel's value at that time
 */
export function samplesWithMoment(
  samples: Samples,
  moment: Moment,
  values: ReadonlyMap<number, number>,
  shown: (channel: number) => number,
): Samples {
  const { startSeconds, frameSeconds, frameCount, scales } = samples;
  const width = scales.length;
  const changed = samples.values.slice();
  const exact = (moment.at - startSeconds) / frameSeconds;
  const isOnFrame = sameTime(Math.round(exact) * frameSeconds + startSeconds, moment.at);
  const near = isOnFrame ? [Math.round(exact)] : [Math.floor(exact), Math.ceil(exact)];
  const first = Math.max(0, Math.floor(exact - moment.easeIn / frameSeconds));
  const end = Math.min(frameCount - 1, Math.ceil(exact + moment.easeOut / frameSeconds));
  for (const [channel, value] of values) {
    const column = columnOf(samples, channel);
    const scale = scales[column];
    const offset = (value - shown(channel)) / scale;
    for (let frame = first; frame <= end; frame++) {
      const weight = near.includes(frame) ? 1 : weightAt(moment, startSeconds + frame * frameSeconds);
      if (weight === 0) continue;
      const o = frame * width + column;
      changed[o] = isOnFrame && frame === near[0] ? value / scale : changed[o] + weight * offset;
    }
  }
  return { ...samples, values: changed };
}
