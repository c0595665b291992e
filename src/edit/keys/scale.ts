/**
 * Scaling keys about a point:
 *
 *     time′ = pivot + (time − pivot) · timeFactor         value′ = pivot + (value − pivot) · valueFactor
 *     slope′ = slope · valueFactor / timeFactor
 *
 * A negative factor of time mirrors: the side a curve came in on is the one it leaves on, so the two tangents of each
 * key change places. (Slopes then change sign by the formula.)
 */
import type { KeyedChannel, Tangents } from '../../model/clip.ts';
import { FIXED_TANGENT } from '../../model/clip.ts';
import { CommandError } from '../store.ts';
import { arrangeKeys, type Collision, type EditedChannel, timesFor } from './arrange.ts';
import { withValues } from './move.ts';

export interface Scaling {
  /** The moment of the clip that stays where it is. */
  readonly pivotSeconds: number;
  /** 0 puts all keys at the pivot, where the last one stays. */
  readonly timeFactor: number;
  /** The value that stays what it is. */
  readonly pivotValue: number;
  readonly valueFactor: number;
}

/**
 * The very same channel where nothing changes, the very same columns where they don't.
 * @param indices ascending, each once
 */
export function withKeysScaled(
  channel: KeyedChannel,
  indices: readonly number[],
  { pivotSeconds, timeFactor, pivotValue, valueFactor }: Scaling,
  collision: Collision = 'replace',
): EditedChannel {
  // A factor of 1 leaves numbers alone: through a pivot far away they would come back rounded.
  const valued =
    valueFactor === 1 ? channel : withValues(channel, indices, (v) => pivotValue + (v - pivotValue) * valueFactor);
  // Keys that all come to stand at one time have no slope to speak of; theirs stays as steep as it was.
  const scaled = withScaledTangents(valued, indices, valueFactor / (timeFactor === 0 ? 1 : timeFactor), timeFactor < 0);
  if (timeFactor === 1) return { channel: scaled, indices };
  const times = timesFor(indices, (k) => pivotSeconds + (channel.times[k] - pivotSeconds) * timeFactor);
  return arrangeKeys(scaled, indices, times, collision);
}

/** The channel with some keys' slopes multiplied, and their two sides exchanged if `mirrored`. */
function withScaledTangents(
  channel: KeyedChannel,
  indices: readonly number[],
  factor: number,
  mirrored: boolean,
): KeyedChannel {
  const { tangentsIn, tangentsOut } = channel;
  const into = scaledTangents(tangentsIn, mirrored ? tangentsOut : tangentsIn, indices, factor);
  const out = scaledTangents(tangentsOut, mirrored ? tangentsIn : tangentsOut, indices, factor);
  return into === tangentsIn && out === tangentsOut ? channel : { ...channel, tangentsIn: into, tangentsOut: out };
}

/** `own` with some keys' tangents taken from `from`; the very same, and the same columns, where nothing changes. */
function scaledTangents(own: Tangents, from: Tangents, indices: readonly number[], factor: number): Tangents {
  let { kinds, slopes } = own;
  for (const k of indices) {
    const kind = from.kinds[k];
    const slope = kind === FIXED_TANGENT ? from.slopes[k] * factor : 0;
    if (!Number.isFinite(slope)) throw new CommandError('That makes a slope too steep.');
    if (kind !== own.kinds[k]) {
      if (kinds === own.kinds) kinds = kinds.slice();
      kinds[k] = kind;
    }
    if (slope !== own.slopes[k]) {
      if (slopes === own.slopes) slopes = slopes.slice();
      slopes[k] = slope;
    }
  }
  return kinds === own.kinds && slopes === own.slopes ? own : { kinds, slopes };
}
