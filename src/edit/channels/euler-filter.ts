/**
 * The Euler filter: the same rotations with angles that don't jump, so that what lies between keys doesn't spin.
 *
 * Three angles about axes i, then j, then k stand for one rotation in many ways:
 *
 *     (φi, φj, φk)  =  (φi + 2πa, φj + 2πb, φk + 2πc)  =  (φi + π, π − φj, φk + π)
 *
 * From the first key on, each key gets the triple that is nearest to the one before it (least sum of squares). The
 * rotation at every key is what it was; between keys it is another, which is the purpose. Where the middle angle is
 * mirrored, slopes that are numbers change sign with it.
 *
 * The second form needs all three angles of a key. Where they are not keyed at the same times, or not all given, each
 * channel is unrolled by whole turns alone.
 *
 * A key never leaves its joint's limits, for what is played is clamped to them; one that lies outside stays as it is.
 * A triple at φj = ±π/2 (gimbal lock) has still more forms; they are not looked for.
 */
import { type Channel, FIXED_TANGENT, type KeyedChannel, type Tangents } from '../../model/clip.ts';
import type { EulerOrder, Limit } from '../../model/skeleton.ts';

const TURN = 2 * Math.PI;
const NO_LIMIT: Limit = { min: Number.NEGATIVE_INFINITY, max: Number.POSITIVE_INFINITY };

export type Triple<T> = readonly [T, T, T];

/** Whether three channels have their keys at the same times: what `filterRotations` asks for. */
export function keyedTogether(channels: Triple<KeyedChannel>): boolean {
  const [{ times }] = channels;
  return channels.every((c) => c.times.length === times.length && c.times.every((t, k) => t === times[k]));
}

/**
 * The channels rx, ry, rz of a ball joint, keyed at the same times, without jumps. A channel that needs no change is
 * the very same.
 *
 * @param limits of rx, ry, rz; crossed ones (min > max) are none
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
      // NaN, where limits leave no room, is never less.
      isFlipped[k] = flippedDistance < plainDistance - 1e-9 ? 1 : 0;
      for (let a = 0; a < 3; a++) values[a][k] = isFlipped[k] ? flipped[a] : plain[a];
    }
    for (let a = 0; a < 3; a++) before[a] = values[a][k];
  }
  const made = channels.map((c, a) => withAngles(c, values[a], a === middle ? isFlipped : undefined));
  return [made[0], made[1], made[2]];
}

/** The channel of one angle, each key within half a turn of the one before it. The very same where they are. */
export function unrollAngle(channel: KeyedChannel, limit: Limit = NO_LIMIT): KeyedChannel {
  const values = channel.values.slice();
  const within = limit.min > limit.max ? NO_LIMIT : limit;
  for (let k = 1; k < values.length; k++) {
    if (isWithin(values[k], within)) values[k] = nearestTurn(values[k], values[k - 1], within);
  }
  return withAngles(channel, values);
}

/** How many keys have other values than before. */
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

/** The angle, whole turns away, nearest to `target` within the limit; NaN where none is. Unchanged by 0 turns. */
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
