/**
 * Ripple: keys take all that comes after them along, so that a pause is made longer or shorter and the motion behind it
 * stays as it is.
 *
 * Backwards they come as far as the key before them and no further: there the two are a step. (Going on would tear the
 * motion that ripples apart, or eat what lies before it.)
 */
import type { KeyedChannel } from '../../model/clip.ts';
import { arrangeKeys, type EditedChannel, timesFor } from './arrange.ts';

/** How far back the keys from `first` on can ripple, in seconds: 0 or less. */
export function rippleRoom({ times }: KeyedChannel, first: number): number {
  return first > 0 && first < times.length ? times[first - 1] - times[first] : Number.NEGATIVE_INFINITY;
}

/**
 * Moves the given keys and every later one.
 * @param indices ascending; where they are now is returned
 * @param seconds held to `rippleRoom`
 */
export function withKeysRippled(channel: KeyedChannel, indices: readonly number[], seconds: number): EditedChannel {
  const { times } = channel;
  const first = indices[0];
  if (first === undefined || seconds === 0) return { channel, indices };
  const by = Math.max(seconds, rippleRoom(channel, first));
  const all = Array.from({ length: times.length - first }, (_, i) => first + i);
  // Rounding must not carry the first one past the key it comes up to.
  const floor = times[first - 1] ?? Number.NEGATIVE_INFINITY;
  const moved = arrangeKeys(
    channel,
    all,
    timesFor(all, (k) => Math.max(floor, times[k] + by)),
    'step',
  );
  const given = new Set(indices);
  return { channel: moved.channel, indices: moved.indices.filter((_k, i) => given.has(moved.from[i])) };
}
