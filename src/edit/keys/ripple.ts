/**
 * Ripple: moves all later keys along, so that a pause becomes longer or shorter and the motion after it is kept.
 *
 * Backwards, keys move only up to the previous key, with which they then form a step. (Further, they would tear the
 * rippled motion apart, or overwrite what precedes it.)
 */
import type { KeyedChannel } from '../../model/takes/take.ts';
import { arrangeKeys, type EditedChannel, timesFor } from './arrange.ts';
import { wholeSteps } from './steps.ts';

/** How far back the keys from `first` on can ripple, in seconds: 0 or negative. */
export function rippleRoom({ times }: KeyedChannel, key: number): number {
  const [first] = wholeSteps({ times }, [key]);
  return first > 0 && first < times.length ? times[first - 1] - times[first] : Number.NEGATIVE_INFINITY;
}

/**
 * Moves the given keys and all later ones.
 * @param indices ascending; returned with their new positions
 * @param seconds clamped to `rippleRoom`
 */
export function withKeysRippled(channel: KeyedChannel, indices: readonly number[], seconds: number): EditedChannel {
  const { times } = channel;
  const whole = wholeSteps(channel, indices);
  const first = whole[0];
  if (first === undefined || seconds === 0) return { channel, indices };
  const by = Math.max(seconds, rippleRoom(channel, first));
  const all = Array.from({ length: times.length - first }, (_, i) => first + i);
  // Rounding must not carry the first one past the key it stops at.
  const floor = times[first - 1] ?? Number.NEGATIVE_INFINITY;
  const moved = arrangeKeys(
    channel,
    all,
    timesFor(all, (k) => Math.max(floor, times[k] + by)),
    'step',
  );
  const given = new Set(whole);
  return { channel: moved.channel, indices: moved.indices.filter((_k, i) => given.has(moved.from[i])) };
}
