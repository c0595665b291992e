/** Keys that end one stretch of a curve and begin another: for switching limbs, changing their space, and putting down. */
import { keySlope } from '../../evaluate/slopes.ts';
import type { Channel, KeyedChannel } from '../../model/takes/take.ts';
import { AUTO_TANGENT, FIXED_TANGENT, FLAT, SMOOTH } from '../../model/takes/tangent-kinds.ts';
import { sameValue } from '../delta.ts';
import { type Key, keyAt, tangent, withKeyList } from './columns.ts';
import { placeOf } from './cycle.ts';
import { insertKey } from './insert.ts';
import { withStepsAfter } from './steps.ts';

/** Values this near are the same: a match is exact but for rounding. */
const SAME = 1e-9;

/** How a curve continues from a new value: continues to its next key, or holds the value until then. */
export type StepTo = 'continues' | 'holds';

/**
 * The channel with another value from a time on. Before that it stays exactly as it is, whatever is keyed later: a step
 * where the value jumps, a single key where it doesn't. A repeating channel has its repetitions as keys up to there.
 *
 * @param given not a sampled one
 * @param time seconds of the take
 * @param range in which the repetitions become keys, too, so that they are not others
 */
export function steppedTo(
  given: Channel,
  time: number,
  value: number,
  then: StepTo,
  range?: readonly [number, number],
): Channel {
  if (given.kind === 'rest' && isSame(given.value, value)) return given;
  const place = placeOf(given, time, { outsideCycle: 'bake', ...(range && { bakedRange: range }) });
  const { channel, index } = insertKey(place.channel, place.time);
  const end = index + 1;
  let start = index;
  while (start > 0 && channel.times[start - 1] === channel.times[index]) start--;
  const last = keyAt(channel, index);
  const before: Key = { ...keyAt(channel, start), in: frozen(channel, start, 'in') };
  const flat = tangent(FLAT);
  const wanted = value - place.offset;
  const jumps = !isSame(before.value, wanted);
  // As it continues: a curve that isn't changed there keeps its slope.
  const isKept = isSame(last.value, wanted);
  const out = then === 'holds' ? flat : isKept ? frozen(channel, index, 'out') : tangent(AUTO_TANGENT);
  const key: Key = { ...last, value: wanted, in: jumps ? flat : before.in, out };
  const keys = Array.from(channel.times, (_, k) => keyAt(channel, k));
  keys.splice(start, end - start, ...(jumps ? [{ ...before, out: flat }, key] : [key]));
  const next = withKeyList(channel, keys);
  const held = then === 'holds' ? withStepsAfter(next, [start + (jumps ? 1 : 0)]).channel : next;
  return sameValue(held, given) ? given : held;
}

/** A curve without a key, or with one, at a time, with one there that keeps its shape, whatever is keyed later. */
export function keptAt(given: Channel, time: number): Channel {
  if (given.kind !== 'keys') return given;
  const place = placeOf(given, time, { outsideCycle: 'bake' });
  const { channel, index } = insertKey(place.channel, place.time);
  const keys = Array.from(channel.times, (_, k) => keyAt(channel, k));
  keys[index] = { ...keys[index], in: frozen(channel, index, 'in'), out: frozen(channel, index, 'out') };
  const next = withKeyList(channel, keys);
  return sameValue(next, given) ? given : next;
}

function isSame(a: number, b: number): boolean {
  return Math.abs(a - b) <= SAME * Math.max(1, Math.abs(a));
}

/** The tangent as it is, of kinds that depend on both neighbours as a number. */
function frozen(channel: KeyedChannel, k: number, side: 'in' | 'out') {
  const key = keyAt(channel, k)[side];
  const depends = key.kind === SMOOTH || key.kind === AUTO_TANGENT;
  return depends ? tangent(FIXED_TANGENT, keySlope(channel, k, side)) : key;
}
