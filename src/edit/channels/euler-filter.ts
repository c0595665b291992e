/**
 * The Euler filter: the same rotations with angles that don't jump, so that interpolation between keys doesn't spin.
 *
 * Three angles about axes i, then j, then k are not unique for a rotation:
 *
 *     (φi, φj, φk)  =  (φi + 2πa, φj + 2πb, φk + 2πc)  =  (φi + π, π − φj, φk + π)
 *
 * From the first key on, each key gets the triple nearest to the previous one (least sum of squares). The rotation at
 * every key is unchanged; between keys it differs, which is the purpose. If the middle angle is mirrored, numeric
 * slopes change sign with it.
 *
 * The second form needs all three angles of a key. If they are not keyed at the same times, or not all given, each
 * channel is only unrolled by whole turns.
 *
 * A key never leaves its joint's limits, since playback clamps to them; one that is outside is not changed. In gimbal
 * lock (φj = ±π/2) a rotation has more forms, which are not considered.
 */

import type { EulerOrder, Limit } from '../../model/skeleton/skeleton.ts';
import type { Channel, KeyedChannel, Tangents } from '../../model/takes/take.ts';
import { FIXED_TANGENT } from '../../model/takes/tangent-kinds.ts';

const TURN = 2 * Math.PI;
const NO_LIMIT: Limit = { min: Number.NEGATIVE_INFINITY, max: Number.POSITIVE_INFINITY };

/** One of something for each of a rotation's three angles. */
export type Triple<T> = readonly [T, T, T];

/** Whether three channels are keyed at the same times, as `filterRotations` requires. */
export function keyedTogether(channels: Triple<KeyedChannel>): boolean {
  const [{ times }] = channels;
  return channels.every((c) => c.times.length === times.length && c.times.every((t, k) => t === times[k]));
}

/**
 * The channels rx, ry, rz of a ball joint, keyed at the same times, without jumps. Unchanged channels keep their
 * identity.
 *
 * @param limits of rx, ry, rz; none if min > max
 */
export function filterRotations(
  channels: Triple<KeyedChannel>,
  order: EulerOrder,
  limits: readonly Limit[] = [],
): Triple<KeyedChannel> {
  const middle = 'xyz'.indexOf(order[1]);
  const count = channels[0].times.length;
  const values = channels.map((c) => c.values.slice());
  const isFlipped = new Uint8Array(count);
  const before = [0, 0, 0];
  const plain = [0, 0, 0];
  const flipped = [0, 0, 0];
  for (let k = 0; k < count; k++) {
    const allowed = [0, 1, 2].every((a) => isWithin(values[a][k], limitOf(limits, a)));
    if (k > 0 && allowed) {
      let plainDistance = 0;
      let flippedDistance = 0;
      for (let a = 0; a < 3; a++) {
        const angle = values[a][k];
        const other = a === middle ? Math.PI - angle : angle + Math.PI;
        plain[a] = nearestTurn(angle, before[a], limitOf(limits, a));
        flipped[a] = nearestTurn(other, before[a], limitOf(limits, a));
        plainDistance += (plain[a] - before[a]) ** 2;
        flippedDistance += (flipped[a] - before[a]) ** 2;
      }
      // NaN, if limits leave no room, is never less.
      isFlipped[k] = flippedDistance < plainDistance - 1e-9 ? 1 : 0;
      for (let a = 0; a < 3; a++) values[a][k] = isFlipped[k] ? flipped[a] : plain[a];
    }
    for (let a = 0; a < 3; a++) before[a] = values[a][k];
  }
  const made = channels.map((c, a) => withAngles(c, values[a], a === middle ? isFlipped : undefined));
  return [made[0], made[1], made[2]];
}

/**
 * The channel of one angle with each key within half a turn of the previous one. The same object if nothing changes.
 */
export function unrollAngle(channel: KeyedChannel, limit: Limit = NO_LIMIT): KeyedChannel {
  const values = channel.values.slice();
  const within = limit.min > limit.max ? NO_LIMIT : limit;
  for (let k = 1; k < values.length; k++) {
    if (isWithin(values[k], within)) values[k] = nearestTurn(values[k], values[k - 1], within);
  }
  return withAngles(channel, values);
}

/** Number of keys whose values changed. */
export function keysChanged(before: readonly Channel[], after: readonly Channel[]): number {
  let count = 0;
  after.forEach((channel, c) => {
    const was = before[c];
    if (channel === was || channel.kind !== 'keys' || was.kind !== 'keys') return;
    for (let k = 0; k < channel.values.length; k++) if (channel.values[k] !== was.values[k]) count++;
  });
  return count;
}

function limitOf(limits: readonly Limit[], a: number): Limit {
  const limit = limits[a];
  return !limit || limit.min > limit.max ? NO_LIMIT : limit;
}

function isWithin(angle: number, { min, max }: Limit): boolean {
  return angle >= min && angle <= max;
}

/**
 * The angle plus whole turns, nearest to `target` within the limit; NaN if there is none. Exactly unchanged for 0
 * turns.
 */
function nearestTurn(angle: number, target: number, { min, max }: Limit): number {
  const fewest = Math.ceil((min - angle) / TURN);
  const most = Math.floor((max - angle) / TURN);
  if (fewest > most) return Number.NaN;
  const turns = Math.min(most, Math.max(fewest, Math.round((target - angle) / TURN)));
  return turns === 0 ? angle : angle + TURN * turns;
}

function withAngles(channel: KeyedChannel, values: Float64Array, isMirrored?: Uint8Array): KeyedChannel {
  const mirrors = isMirrored?.some((m) => m === 1) ?? false;
  if (!mirrors && values.every((v, k) => v === channel.values[k])) return channel;
  if (!isMirrored || !mirrors) return { ...channel, values };
  const mirrored = (side: Tangents): Tangents => ({
    kinds: side.kinds,
    slopes: side.slopes.map((slope, k) => (isMirrored[k] && side.kinds[k] === FIXED_TANGENT ? 0 - slope : slope)),
  });
  return { ...channel, values, tangentsIn: mirrored(channel.tangentsIn), tangentsOut: mirrored(channel.tangentsOut) };
}
