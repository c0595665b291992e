/** Editing tangents of keys, by side. Requested slopes become numbers (FIXED); other kinds follow the neighbours. */
import { keySlope } from '../../evaluate/slopes.ts';
import type { ChannelKeys } from '../../model/session.ts';
import type { Channel, KeyedChannel, Take, Tangents } from '../../model/takes/take.ts';
import { FIXED_TANGENT, FLAT, TANGENT_CHOICES } from '../../model/takes/tangent-kinds.ts';
import { type Tangent, tangent } from './columns.ts';
import { isStepped } from './steps.ts';

/** The side of a key that is edited. */
export const TANGENT_SIDES = ['in', 'out', 'both'] as const;
/** Which of a key's tangents is meant; see `TANGENT_SIDES`. */
export type TangentSide = (typeof TANGENT_SIDES)[number];

/**
 * The choices that keys have on one or both sides, as bits: 1 << index into TANGENT_CHOICES; 0 for no keys. A last key
 * can only be flat where others are steps, and counts as they do.
 * @param channels of the take
 */
export function tangentKindsOf(channels: readonly Channel[], keys: readonly ChannelKeys[], side: TangentSide): number {
  let found = 0;
  let isLastFlat = false;
  for (const { channel, indices } of keys) {
    const own = channels[channel];
    if (own?.kind !== 'keys') continue;
    const { times, tangentsIn, tangentsOut } = own;
    for (const k of indices) {
      // Between the halves of a step there is no curve, unless this is the only one.
      if (side !== 'out' && times[k - 1] !== times[k]) found |= 1 << tangentsIn.kinds[k];
      if (side === 'in' || times[k + 1] === times[k]) continue;
      if (k + 1 === times.length && tangentsOut.kinds[k] === FLAT) isLastFlat = true;
      else found |= 1 << (isStepped(own, k) ? STEP : tangentsOut.kinds[k]);
    }
  }
  return isLastFlat && !(found & (1 << STEP)) ? found | (1 << FLAT) : found;
}

const STEP = TANGENT_CHOICES.findIndex(({ name }) => name === 'step');

/** Relative difference below which slopes are equal. */
const SAME_SLOPE = 1e-12;

/**
 * The channel with a tangent kind on one or both sides of keys; the same object if nothing changes.
 * @param kind index into TANGENT_KINDS; FIXED keeps the current slope as a number
 */
export function setTangentKind(
  channel: KeyedChannel,
  indices: readonly number[],
  side: TangentSide,
  kind: number,
): KeyedChannel {
  return withTangents(channel, indices, (k, at) => {
    if (kind !== FIXED_TANGENT) return side === 'both' || side === at ? tangent(kind) : undefined;
    return side === 'both' || side === at ? tangent(FIXED_TANGENT, keySlope(channel, k, at)) : undefined;
  });
}

/**
 * The take with a tangent kind (index into TANGENT_KINDS) on both sides of every key; the same object if nothing
 * changes.
 */
export function withAllTangents(take: Take, kind: number): Take {
  const channels = take.channels.map((channel) =>
    channel.kind === 'keys' ? setTangentKind(channel, [...channel.times.keys()], 'both', kind) : channel,
  );
  return channels.every((channel, c) => channel === take.channels[c]) ? take : { ...take, channels };
}

/** Sets one or both sides of keys to a number: value per second. */
export function setSlope(
  channel: KeyedChannel,
  indices: readonly number[],
  side: TangentSide,
  slope: number,
): KeyedChannel {
  return withTangents(channel, indices, (_k, at) =>
    side === 'both' || side === at ? tangent(FIXED_TANGENT, slope) : undefined,
  );
}

/** Unifies tangents: both sides of each key get the mean slope. Keys with equal slopes are not changed. */
export function withTangentsUnified(channel: KeyedChannel, indices: readonly number[]): KeyedChannel {
  return withTangents(channel, indices, (k) => {
    const into = keySlope(channel, k, 'in');
    const out = keySlope(channel, k, 'out');
    if (Math.abs(into - out) <= SAME_SLOPE * Math.max(Math.abs(into), Math.abs(out))) return undefined;
    return tangent(FIXED_TANGENT, into / 2 + out / 2);
  });
}

/**
 * Breaks tangents: both sides of each key become numbers with their current slopes, so that each can be changed alone.
 */
export function withTangentsBroken(channel: KeyedChannel, indices: readonly number[]): KeyedChannel {
  return withTangents(channel, indices, (k, at) => tangent(FIXED_TANGENT, keySlope(channel, k, at)));
}

/**
 * The channel with other tangents at some keys: `change` returns them, or `undefined` for no change. Unchanged columns
 * keep their identity, and so does the channel if none changes.
 */
export function withTangents(
  channel: KeyedChannel,
  indices: readonly number[],
  change: (key: number, side: 'in' | 'out') => Tangent | undefined,
): KeyedChannel {
  const tangentsIn = changed(channel.tangentsIn, indices, (k) => change(k, 'in'));
  const tangentsOut = changed(channel.tangentsOut, indices, (k) => change(k, 'out'));
  if (tangentsIn === channel.tangentsIn && tangentsOut === channel.tangentsOut) return channel;
  return { ...channel, tangentsIn, tangentsOut };
}

function changed(own: Tangents, indices: readonly number[], change: (key: number) => Tangent | undefined): Tangents {
  let { kinds, slopes } = own;
  for (const k of indices) {
    const to = change(k);
    if (!to) continue;
    if (to.kind !== kinds[k]) {
      if (kinds === own.kinds) kinds = kinds.slice();
      kinds[k] = to.kind;
    }
    if (to.slope !== slopes[k]) {
      if (slopes === own.slopes) slopes = slopes.slice();
      slopes[k] = to.slope;
    }
  }
  return kinds === own.kinds && slopes === own.slopes ? own : { kinds, slopes };
}
