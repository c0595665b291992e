/** Keying a value from a time on, whatever a channel does before. */
import { keySlope } from '../../evaluate/slopes.ts';
import type { Channel } from '../../model/takes/take.ts';
import { FIXED_TANGENT, FLAT } from '../../model/takes/tangent-kinds.ts';
import { tangent } from './columns.ts';
import { placeOf } from './cycle.ts';
import { insertKey } from './insert.ts';
import { withValues } from './move.ts';
import { withKeyAt } from './splice.ts';

/**
 * The channel with a value at a time, from which it continues to its later keys; before, it is what it was. So there is a
 * step, unless that is its value then.
 * @param channel not a sampled one
 * @param range seconds of the take in which repetitions become keys, so that they are not others before
 */
export function withJump(channel: Channel, time: number, value: number, range: readonly [number, number]): Channel {
  const place = placeOf(channel, time, { outsideCycle: 'bake', bakedRange: range });
  const { channel: keyed, index } = insertKey(place.channel, time);
  if (keyed.values[index] === value) return keyed;
  const key = { time: keyed.times[index], value, in: tangent(FLAT), out: tangent(FLAT) };
  if (keyed.times[index - 1] === keyed.times[index]) return withValues(keyed, [index], () => value);
  const next = withKeyAt(keyed, index + 1, key);
  // Another kind might give another slope at a step. In place: columns are new.
  next.tangentsIn.kinds[index] = FIXED_TANGENT;
  next.tangentsIn.slopes[index] = keySlope(keyed, index, 'in');
  return next;
}
