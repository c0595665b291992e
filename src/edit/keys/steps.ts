/**
 * Steps: two keys at one time, which are shown, selected, moved in time and deleted as one.
 *
 *     held       k ────────┐ later        the earlier key has the value of the key before it, and the tangents
 *                  earlier │              between the two have slope 0
 *                          └ …
 *
 * The earlier key of a held step is no key of its own: it follows the value of the key before it.
 */
import { keySlope } from '../../evaluate/slopes.ts';
import type { ChannelKeys } from '../../model/session.ts';
import { type Channel, type KeyedChannel, keysOf } from '../../model/takes/take.ts';
import { FLAT } from '../../model/takes/tangent-kinds.ts';
import type { EditedChannel } from './arrange.ts';
import { type Key, keyAt, takeKeys, tangent, withKeyList } from './columns.ts';

/** Whether the key at an index is the earlier one of a held step. */
export function isHeld(channel: KeyedChannel, earlier: number): boolean {
  const { times, values } = channel;
  const before = earlier - 1;
  return (
    times[earlier + 1] === times[earlier] &&
    times[before] < times[earlier] &&
    values[before] === values[earlier] &&
    keySlope(channel, before, 'out') === 0 &&
    keySlope(channel, earlier, 'in') === 0
  );
}

/** Whether a held step follows a key; of a step this is said of the later key. */
export function isStepped(channel: KeyedChannel, key: number): boolean {
  return isHeld(channel, key + 1);
}

/** The keys with the other halves of their steps, ascending; the same list if none is missing. */
export function wholeSteps({ times }: Pick<KeyedChannel, 'times'>, indices: readonly number[]): readonly number[] {
  let isWhole = true;
  for (let i = 0; i < indices.length && isWhole; i++) {
    const k = indices[i];
    const time = times[k];
    isWhole =
      !(times[k - 1] === time && indices[i - 1] !== k - 1) && !(times[k + 1] === time && indices[i + 1] !== k + 1);
  }
  if (isWhole) return indices;
  const whole = new Set<number>();
  for (const k of indices) {
    whole.add(k);
    for (let j = k - 1; times[j] === times[k]; j--) whole.add(j);
    for (let j = k + 1; times[j] === times[k]; j++) whole.add(j);
  }
  return [...whole].sort((a, b) => a - b);
}

/** A selection with the other halves of its steps; the same list if none is missing. */
export function withWholeSteps(channels: readonly Channel[], keys: readonly ChannelKeys[]): readonly ChannelKeys[] {
  let changed = false;
  const whole = keys.map((entry) => {
    const indices = wholeSteps(keysOf(channels[entry.channel]), entry.indices);
    if (indices === entry.indices) return entry;
    changed = true;
    return { ...entry, indices };
  });
  return changed ? whole : keys;
}

/** The keys, of steps only the later ones: those that a curve continues from. */
function outerKeys({ times }: KeyedChannel, indices: readonly number[]): readonly number[] {
  return indices.filter((k) => times[k + 1] !== times[k]);
}

/**
 * Makes keys hold their values up to the next key, where a held step begins. The last key only becomes flat.
 * @param indices ascending, unique
 * @returns the same channel if the keys were stepped already
 */
export function withStepsAfter(channel: KeyedChannel, indices: readonly number[]): EditedChannel {
  const whole = wholeSteps(channel, indices);
  const stepped = new Set(outerKeys(channel, whole).filter((k) => !isStepped(channel, k) || !isFlat(channel, k)));
  if (stepped.size === 0) return { channel, indices: whole };
  const { times, values } = channel;
  const flat = tangent(FLAT);
  const given = new Set(whole);
  const keys: Key[] = [];
  const now: number[] = [];
  for (let k = 0; k < times.length; k++) {
    const isSet = stepped.has(k);
    if (given.has(k)) now.push(keys.length);
    const last = keys[keys.length - 1];
    const key = keyAt(channel, k);
    // The earlier key of a step that was there already.
    if (stepped.has(k - 1) && times[k + 1] === times[k]) keys.push({ ...key, value: last.value, in: flat });
    else keys.push(isSet ? { ...key, out: flat } : key);
    const isPair = times[k + 2] === times[k + 1];
    if (isSet && k + 1 < times.length && !isPair) {
      keys.push({ time: times[k + 1], value: values[k], in: flat, out: flat });
      // Both halves are selected if one is.
      if (given.has(k + 1)) now.push(keys.length - 1);
    }
  }
  return { channel: withKeyList(channel, keys), indices: now };
}

function isFlat({ tangentsOut }: KeyedChannel, key: number): boolean {
  return tangentsOut.kinds[key] === FLAT;
}

/**
 * Removes the held steps that follow keys, so that another tangent can leave these.
 * @param indices ascending, unique; returned with their new positions
 * @param lasting times of steps that stay
 */
export function withoutStepsAfter(
  channel: KeyedChannel,
  indices: readonly number[],
  lasting: readonly number[] = [],
): EditedChannel {
  const gone = new Set(
    outerKeys(channel, wholeSteps(channel, indices))
      .filter((k) => isStepped(channel, k) && !lasting.includes(channel.times[k + 1]))
      .map((k) => k + 1),
  );
  if (gone.size === 0) return { channel, indices };
  const kept: number[] = [];
  const now: number[] = [];
  const given = new Set(indices);
  for (let k = 0; k < channel.times.length; k++) {
    if (gone.has(k)) continue;
    if (given.has(k)) now.push(kept.length);
    kept.push(k);
  }
  return { channel: takeKeys(channel, kept), indices: now };
}
