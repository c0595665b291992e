/**
 * Moves keys to new times: sorts them, and handles overlapping keys. Moving, scaling, snapping, typing a time, rippling
 * and pasting all use it.
 *
 *     before     a   b   c   d        b moves to d's time:   a   c   b        replaces it, or
 *                    └───────▶                               a   c   d b      makes a step, b applying from then on
 *
 * The rules:
 *  - A moved key that lands on unmoved ones replaces them. If steps are requested, the first of the unmoved and the
 * last of the moved keys are kept: where the curve arrives and where it continues, never more than two. The moved key
 * takes the exact time of the other, so that channels keyed together stay aligned.
 *  - Of moved keys that meet (scaled to zero, snapped to one frame) the last is kept, with its other half if it was
 * half of a step. Steps that move together stay steps.
 *  - A key that is moved to its own time lands on nothing.
 *
 * Both lists, moved and unmoved, are already sorted or exactly reversed, so this is one merge over indices in typed
 * arrays, without an object per key.
 */
import { lastNotAbove } from '../../math/search.ts';
import type { KeyedChannel, Tangents } from '../../model/takes/take.ts';
import { CommandError } from '../command-error.ts';
import { takeKeys } from './columns.ts';
import { sameTime } from './same-time.ts';

/** Treatment of a key that another lands on. */
export type Collision = 'replace' | 'step';
/** Ways to treat a moved key that lands on another: it replaces that one, or makes a step with it. */
export const COLLISIONS: readonly Collision[] = ['replace', 'step'];

/** A channel after an edit. */
export interface EditedChannel {
  readonly channel: KeyedChannel;
  /** Current indices of the edited keys, ascending; replaced ones are missing. */
  readonly indices: readonly number[];
}

/** A channel with keys at new times. */
export interface Arranged extends EditedChannel {
  /** The previous index of each of `indices`. */
  readonly from: readonly number[];
}

/**
 * The channel with some keys at new times; the same object if nothing changes.
 * @param indices ascending, unique
 * @param newTimes one for each of `indices`: ascending, or descending if time is mirrored
 * @param arriving the keys come from elsewhere: they land on others even if their times don't change
 * @throws CommandError if a new time is not finite
 */
export function arrangeKeys(
  channel: KeyedChannel,
  indices: readonly number[],
  newTimes: Float64Array,
  collision: Collision,
  arriving = false,
): Arranged {
  for (const i of [0, newTimes.length - 1]) {
    if (newTimes.length && !Number.isFinite(newTimes[i])) {
      throw new CommandError('Keys can’t be moved that far: the time is too large.');
    }
  }
  const { times } = channel;
  if (!arriving) {
    const inPlace = movedInPlace(times, indices, newTimes);
    if (inPlace)
      return { channel: inPlace === times ? channel : { ...channel, times: inPlace }, indices, from: indices };
  }
  const movers = new Uint32Array(indices);
  const landing = newTimes.slice();
  if (landing[0] > landing[landing.length - 1]) {
    movers.reverse();
    landing.reverse();
  }
  const others = unselected(times.length, indices);
  adoptTimes(times, movers, landing, others, arriving);
  const { order, orderTimes, now, from } = merged(times, movers, landing, others, collision, arriving);
  return { channel: inOrder(channel, order, orderTimes), indices: now, from };
}

/**
 * The column of times if no key passes or meets another, as in most mouse moves: only moved keys and their neighbours
 * are examined. The same column if no time changes; undefined if keys have to be sorted.
 */
function movedInPlace(times: Float64Array, indices: readonly number[], newTimes: Float64Array) {
  let changed = false;
  for (let i = 0; i < indices.length; i++) changed ||= newTimes[i] !== times[indices[i]];
  if (!changed) return times;
  const next = times.slice();
  for (let i = 0; i < indices.length; i++) next[indices[i]] = newTimes[i];
  for (let i = 0; i < indices.length; i++) {
    const k = indices[i];
    const alongside = i > 0 && indices[i - 1] === k - 1;
    if (k > 0 && !inOrderStill(times, next, k - 1, alongside)) return undefined;
    const last = i + 1 === indices.length || indices[i + 1] !== k + 1;
    if (last && k + 1 < times.length && !inOrderStill(times, next, k, false)) return undefined;
  }
  return next;
}

/** Whether key `k` is still before the next one; the halves of a step may move together. */
function inOrderStill(times: Float64Array, next: Float64Array, k: number, together: boolean): boolean {
  const gap = next[k + 1] - next[k];
  if (together) return gap > 0 || (gap === 0 && times[k + 1] === times[k]);
  return gap > 0 && !sameTime(next[k + 1], next[k]);
}

/** The unmoved keys, ascending. */
function unselected(count: number, indices: readonly number[]): Uint32Array {
  const others = new Uint32Array(count - indices.length);
  let next = 0;
  let i = 0;
  for (let k = 0; k < count; k++) {
    if (k === indices[i]) i++;
    else others[next++] = k;
  }
  return others;
}

/** Replaces times that equal another key's up to rounding by that key's, in place; order is kept. */
function adoptTimes(
  times: Float64Array,
  movers: Uint32Array,
  landing: Float64Array,
  others: Uint32Array,
  arriving: boolean,
): void {
  const standing = new Float64Array(others.length);
  for (let i = 0; i < others.length; i++) standing[i] = times[others[i]];
  let before = Number.NEGATIVE_INFINITY;
  for (let i = 0; i < landing.length; i++) {
    const time = landing[i];
    if (standing.length && (arriving || time !== times[movers[i]])) {
      const k = lastNotAbove(standing, 0, standing.length, time);
      const above = Math.min(k + 1, standing.length - 1);
      const near = Math.abs(standing[above] - time) < Math.abs(standing[k] - time) ? above : k;
      if (sameTime(standing[near], time)) landing[i] = standing[near];
    }
    if (landing[i] < before) landing[i] = before;
    before = landing[i];
  }
}

function merged(
  times: Float64Array,
  movers: Uint32Array,
  landing: Float64Array,
  others: Uint32Array,
  collision: Collision,
  arriving: boolean,
) {
  const order = new Uint32Array(times.length);
  const orderTimes = new Float64Array(times.length);
  const now: number[] = [];
  const from: number[] = [];
  let count = 0;
  let m = 0;
  let o = 0;
  const put = (key: number, time: number) => {
    order[count] = key;
    orderTimes[count++] = time;
  };
  const land = (key: number, time: number) => {
    now.push(count);
    from.push(key);
    put(key, time);
  };
  while (m < movers.length || o < others.length) {
    // All keys at the next time, moved and unmoved.
    const moving = m < movers.length ? landing[m] : Number.POSITIVE_INFINITY;
    const standing = o < others.length ? times[others[o]] : Number.POSITIVE_INFINITY;
    const time = Math.min(moving, standing);
    const firstOther = o;
    while (o < others.length && times[others[o]] === time) o++;
    let firstMover = m;
    while (m < movers.length && landing[m] === time) m++;
    if (firstMover < m) {
      const last = times[movers[m - 1]];
      while (times[movers[firstMover]] !== last) firstMover++;
    }
    if (firstMover === m || firstOther === o) {
      for (let i = firstOther; i < o; i++) put(others[i], time);
      for (let i = firstMover; i < m; i++) land(movers[i], time);
    } else if (!arriving && times[movers[m - 1]] === time) {
      // Half of a step whose other half doesn't move.
      let i = firstOther;
      let j = firstMover;
      while (i < o || j < m) {
        if (j >= m || (i < o && others[i] < movers[j])) put(others[i++], time);
        else land(movers[j++], time);
      }
    } else if (collision === 'step') {
      put(others[firstOther], time);
      land(movers[m - 1], time);
    } else {
      for (let i = firstMover; i < m; i++) land(movers[i], time);
    }
  }
  return { order: order.subarray(0, count), orderTimes: orderTimes.slice(0, count), now, from };
}

/** The channel's keys in another order, at these times. Unchanged columns keep their identity. */
function inOrder(channel: KeyedChannel, order: Uint32Array, times: Float64Array): KeyedChannel {
  const taken = takeKeys(channel, order);
  const { values, tangentsIn, tangentsOut } = channel;
  return {
    ...taken,
    times,
    values: same(values, taken.values) ? values : taken.values,
    tangentsIn: sameTangents(tangentsIn, taken.tangentsIn) ? tangentsIn : taken.tangentsIn,
    tangentsOut: sameTangents(tangentsOut, taken.tangentsOut) ? tangentsOut : taken.tangentsOut,
  };
}

function sameTangents(a: Tangents, b: Tangents): boolean {
  return same(a.kinds, b.kinds) && same(a.slopes, b.slopes);
}

function same(a: Float64Array | Uint8Array, b: Float64Array | Uint8Array): boolean {
  if (a.length !== b.length) return false;
  for (let i = 0; i < a.length; i++) if (!Object.is(a[i], b[i])) return false;
  return true;
}

/** A new time for each of some keys. (`Float64Array.from` with a function is several times slower.) */
export function timesFor(indices: readonly number[], of: (key: number) => number): Float64Array {
  const times = new Float64Array(indices.length);
  for (let i = 0; i < indices.length; i++) times[i] = of(indices[i]);
  return times;
}
