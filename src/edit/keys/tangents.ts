/**
 * Tangents of keys, a side at a time. Slopes that are asked for become numbers (FIXED); a kind by name follows the
 * neighbours from then on.
 */
import { keySlope } from '../../evaluate/slopes.ts';
import { FIXED_TANGENT, type KeyedChannel, type Tangents } from '../../model/clip.ts';
import { type Tangent, tangent } from './columns.ts';

/** The side a curve comes in on, or leaves on. */
export const TANGENT_SIDES = ['in', 'out', 'both'] as const;
export type TangentSide = (typeof TANGENT_SIDES)[number];

/** Slopes that differ by less, relative to the larger, are one slope. */
const SAME_SLOPE = 1e-12;

/**
 * The channel with a tangent kind on one side of keys or both; the very same where nothing changes.
 * @param kind index into TANGENT_KINDS; FIXED keeps the slope there is, as a number
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

/** Makes one side of keys, or both, a number: value per second. */
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

/** Gives both sides of each key one slope, the mean of the two. Keys whose slopes are equal stay as they are. */
export function withTangentsUnified(channel: KeyedChannel, indices: readonly number[]): KeyedChannel {
  return withTangents(channel, indices, (k) => {
    const into = keySlope(channel, k, 'in');
    const out = keySlope(channel, k, 'out');
    if (Math.abs(into - out) <= SAME_SLOPE * Math.max(Math.abs(into), Math.abs(out))) return undefined;
    return tangent(FIXED_TANGENT, into / 2 + out / 2);
  });
}

/** Makes both sides of each key numbers, the slopes they have: from then on each can be turned without the other. */
export function withTangentsBroken(channel: KeyedChannel, indices: readonly number[]): KeyedChannel {
  return withTangents(channel, indices, (k, at) => tangent(FIXED_TANGENT, keySlope(channel, k, at)));
}

/**
 * The channel with other tangents at some keys: `change` says which, `undefined` to leave one. Columns that do not
 * change stay the same objects, and the channel where none does.
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
