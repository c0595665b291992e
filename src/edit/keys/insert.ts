/**
 * Inserts a key on the curve, which keeps its shape.
 *
 *     before   a ───────────── b        one cubic from a to b
 *     after    a ───── n ───── b        the same cubic in two: n has its value and its slope
 *
 * Two things could change the curve next to the new key. A neighbour's `linear` or `smooth` tangent, which now depends
 * on the new key, may resolve to another slope: it is replaced by its previous slope as a number (on both sides if
 * necessary). And beyond the ends, where the new key takes the extrapolated value and slope, the outer side of the old
 * end key starts to matter: it gets the slope of the extrapolated curve. With `constant` and `linear` extrapolation
 * nothing changes; if a channel cycles or bounces, its period changes, which can't be avoided.
 *
 * Between two keys the new one has a single slope, and bends the curve smoothly when it is moved: it is `smooth` if
 * that comes to this slope, as on a straight line, and a number elsewhere; between `flat` keys on a level it is flat
 * too. Only between two `linear` keys it is `linear`, since corners are meant there. Beyond the ends it gets for each
 * side the most adaptive kind that changes nothing now. A channel without keys gets a `smooth` key at its value.
 *
 * An `auto` tangent is a number from then on if it faces the new key, which then is one too; so is one at the other end
 * of a loop, across its seam. Where the shape may follow instead, see `insertKeyAmong`.
 *
 * At an existing key nothing changes; of a step the later key counts, which applies from that time on.
 */
import { compileChannels } from '../../evaluate/compiled-take.ts';
import { evaluateChannel, evaluateSlope } from '../../evaluate/curves.ts';
import { keySlope } from '../../evaluate/slopes.ts';
import { type Channel, type KeyedChannel, repeats } from '../../model/takes/take.ts';
import { AUTO_TANGENT, FIXED_TANGENT, FLAT, LINEAR, SMOOTH } from '../../model/takes/tangent-kinds.ts';
import { withSeamFrozen } from '../channels/sloped-key.ts';
import { type Tangent, tangent, withKeyList } from './columns.ts';
import { countNotAbove, findKey } from './same-time.ts';
import { withKeyAt } from './splice.ts';

const SIDES = ['in', 'out'] as const;

/** A channel with a key at the time asked for. */
export interface Inserted {
  /** The same object if there was a key already. */
  readonly channel: KeyedChannel;
  /** Index of the new or existing key. */
  readonly index: number;
  /** Whether the channel cycles or bounces with another period now. */
  readonly periodChanged: boolean;
}

/**
 * Inserts a key on the curve that is one of its neighbours' kind: where both tangents that face it are `auto`, or the
 * only one beyond an end, it is `auto` too, and the shape follows. Elsewhere the shape stays.
 * @param channel not a sampled one
 */
export function insertKeyAmong(channel: Channel, time: number): Inserted {
  if (channel.kind !== 'keys' || findKey(channel, time) >= 0) return insertKey(channel, time);
  const index = countNotAbove(channel.times, time);
  const facing = facingKinds(channel, index);
  if (facing.some((kind) => kind !== AUTO_TANGENT)) return insertKey(channel, time);
  const auto = tangent(AUTO_TANGENT);
  const value = evaluateChannel(compileChannels([channel]), 0, time);
  const next = withKeyAt(channel, index, { time, value, in: auto, out: auto });
  return { channel: next, index, periodChanged: changesPeriod(channel, next) };
}

/** The kinds of the tangents that face a key to be inserted at an index: two, beyond an end one. */
function facingKinds({ times, tangentsIn, tangentsOut }: KeyedChannel, index: number): readonly number[] {
  const before = index > 0 ? [tangentsOut.kinds[index - 1]] : [];
  return index < times.length ? [...before, tangentsIn.kinds[index]] : before;
}

/**
 * Inserts a key on the curve, which keeps its shape.
 * @param channel not a sampled one
 */
export function insertKey(channel: Channel, time: number): Inserted {
  if (channel.kind !== 'keys') {
    const value = channel.kind === 'rest' ? channel.value : 0;
    const first = { time, value, in: tangent(SMOOTH), out: tangent(SMOOTH) };
    return { channel: withKeyList(channel, [first]), index: 0, periodChanged: false };
  }
  const there = findKey(channel, time);
  if (there >= 0) return { channel, index: there, periodChanged: false };
  return inserted(withSeamFrozen(channel), channel, time);
}

/** @param given the channel as it was */
function inserted(channel: KeyedChannel, given: KeyedChannel, time: number): Inserted {
  const curve = compileChannels([channel]);
  const value = evaluateChannel(curve, 0, time);
  const slopes = { in: evaluateSlope(curve, 0, time, 'in'), out: evaluateSlope(curve, 0, time, 'out') };
  const index = countNotAbove(channel.times, time);
  const last = channel.times.length;
  const key = { time, value, in: tangent(FIXED_TANGENT, slopes.in), out: tangent(FIXED_TANGENT, slopes.out) };
  const next = withKeyAt(channel, index, key);

  if (index > 0) {
    const before = index - 1;
    const outer = index === last ? evaluateSlope(curve, 0, channel.times[before], 'out') : undefined;
    keepSlope(next, before, 'in', keySlope(channel, before, 'in'));
    keepSlope(next, before, 'out', outer ?? keySlope(channel, before, 'out'), outer === 0);
  }
  if (index < last) {
    const outer = index === 0 ? evaluateSlope(curve, 0, channel.times[0], 'in') : undefined;
    keepSlope(next, index + 1, 'in', outer ?? keySlope(channel, index, 'in'), outer === 0);
    keepSlope(next, index + 1, 'out', keySlope(channel, index, 'out'));
  }
  const facesAuto = facingKinds(channel, index).includes(AUTO_TANGENT);
  if (index > 0) fixIfAuto(next, index - 1, 'out', keySlope(channel, index - 1, 'out'));
  if (index < last) fixIfAuto(next, index + 1, 'in', keySlope(channel, index, 'in'));
  if (!facesAuto) {
    const between = index > 0 && index < last ? tangentBetween(next, index, slopes.in) : undefined;
    setTangent(next, index, 'in', between ?? honestTangent(next, index, 'in', slopes.in));
    setTangent(next, index, 'out', between ?? honestTangent(next, index, 'out', slopes.out));
  }
  return { channel: next, index, periodChanged: changesPeriod(given, next) };
}

/** A tangent that faces the new key no longer follows its neighbours. In place: columns are new. */
function fixIfAuto(next: KeyedChannel, key: number, side: 'in' | 'out', slope: number): void {
  const { kinds } = side === 'in' ? next.tangentsIn : next.tangentsOut;
  if (kinds[key] === AUTO_TANGENT) setTangent(next, key, side, tangent(FIXED_TANGENT, slope));
}

/** (A single key has no period; its channel is constant or straight.) */
function changesPeriod(before: KeyedChannel, after: KeyedChannel): boolean {
  if (!repeats(before.extrapolateIn) && !repeats(before.extrapolateOut)) return false;
  const period = lengthOf(before);
  if (period === lengthOf(after)) return false;
  // A channel with a single value stays constant, whatever its period.
  return period > 0 || after.values[0] !== after.values[after.values.length - 1];
}

function lengthOf({ times }: KeyedChannel): number {
  return times[times.length - 1] - times[0];
}

/** Replaces one side's tangent by a number if its kind would resolve to another slope. In place: columns are new. */
function keepSlope(next: KeyedChannel, key: number, side: 'in' | 'out', slope: number, asFlat = false): void {
  if (comesTo(next, key, side, keySlope(next, key, side), slope)) return;
  setTangent(next, key, side, asFlat ? tangent(FLAT) : tangent(FIXED_TANGENT, slope));
}

/** The tangent on both sides of a key that has two neighbours. */
function tangentBetween(next: KeyedChannel, key: number, slope: number): Tangent {
  const kinds = [next.tangentsOut.kinds[key - 1], next.tangentsIn.kinds[key + 1]];
  const resolves = (kind: number) => {
    setTangent(next, key, 'in', tangent(kind));
    setTangent(next, key, 'out', tangent(kind));
    return SIDES.every((side) => comesTo(next, key, side, keySlope(next, key, side), slope));
  };
  for (const kind of [LINEAR, FLAT]) {
    if (kinds.every((own) => own === kind) && resolves(kind)) return tangent(kind);
  }
  for (const kind of [SMOOTH, FLAT]) if (resolves(kind)) return tangent(kind);
  return tangent(FIXED_TANGENT, slope);
}

/** The tangent on a side of a key at an end. */
function honestTangent(next: KeyedChannel, key: number, side: 'in' | 'out', slope: number): Tangent {
  const { times, values } = next;
  const neighbour = side === 'in' ? key - 1 : key + 1;
  const hasSegment = neighbour >= 0 && neighbour < times.length;
  // On the outer side of an end `linear` uses the only segment.
  const from = Math.max(0, Math.min(times.length - 2, side === 'in' ? key - 1 : key));
  const secant = (values[from + 1] - values[from]) / (times[from + 1] - times[from]);
  const facing = side === 'in' ? 'out' : 'in';
  const isStraight =
    comesTo(next, key, side, secant, slope) &&
    (!hasSegment || comesTo(next, neighbour, facing, secant, keySlope(next, neighbour, facing)));
  const neighbourKind = hasSegment && (side === 'in' ? next.tangentsOut : next.tangentsIn).kinds[neighbour];
  if (isStraight && neighbourKind === LINEAR) return tangent(LINEAR);
  if (comesTo(next, key, side, 0, slope)) return tangent(FLAT);
  return isStraight ? tangent(LINEAR) : tangent(FIXED_TANGENT, slope);
}

/**
 * Whether two slopes on one side of a key are equal up to rounding. Between keys the rounding of a secant's values
 * counts; beyond the ends a slope extends any distance, so there the numbers themselves must be nearly equal.
 */
function comesTo({ times, values }: KeyedChannel, key: number, side: 'in' | 'out', a: number, b: number): boolean {
  const far = side === 'in' ? key - 1 : key + 1;
  const difference = Math.abs(a - b);
  const own = 1e-13 * Math.max(Math.abs(a), Math.abs(b));
  if (difference <= own) return true;
  if (far < 0 || far >= times.length) return false;
  const length = Math.abs(times[far] - times[key]);
  return difference * length <= 4 * Number.EPSILON * Math.max(Math.abs(values[far]), Math.abs(values[key]));
}

function setTangent(next: KeyedChannel, key: number, side: 'in' | 'out', { kind, slope }: Tangent): void {
  const { kinds, slopes } = side === 'in' ? next.tangentsIn : next.tangentsOut;
  kinds[key] = kind;
  slopes[key] = slope;
}
