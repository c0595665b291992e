/**
 * Scales keys about a point:
 *
 *     time′ = pivot + (time − pivot) · timeFactor         value′ = pivot + (value − pivot) · valueFactor
 *     slope′ = slope · valueFactor / timeFactor
 *
 * A negative time factor mirrors: the in and out tangents of each key are swapped. (By the formula, slopes then change
 * sign.)
 */
import type { KeyedChannel, Tangents } from '../../model/takes/take.ts';
import { FIXED_TANGENT } from '../../model/takes/tangent-kinds.ts';
import { CommandError } from '../command-error.ts';
import { arrangeKeys, type Collision, type EditedChannel, timesFor } from './arrange.ts';
import { withValues } from './move.ts';
import { wholeSteps } from './steps.ts';

/** Factors of times and values, and the point that stays. */
export interface Scaling {
  /** Take time that stays fixed. */
  readonly pivotSeconds: number;
  /** 0 puts all keys at the pivot, where the last one is kept. */
  readonly timeFactor: number;
  /** The value that stays fixed. */
  readonly pivotValue: number;
  readonly valueFactor: number;
}

/**
 * The channel with scaled keys: the same object if nothing changes, and the same columns if these don't.
 * @param indices ascending, unique
 */
export function withKeysScaled(
  channel: KeyedChannel,
  indices: readonly number[],
  { pivotSeconds, timeFactor, pivotValue, valueFactor }: Scaling,
  collision: Collision = 'replace',
): EditedChannel {
  // A factor of 1 leaves numbers exact; with a distant pivot they would be rounded.
  const valued =
    valueFactor === 1 ? channel : withValues(channel, indices, (v) => pivotValue + (v - pivotValue) * valueFactor);
  // Keys that end at the same time have no meaningful slope; theirs are kept.
  const moved = timeFactor === 1 ? indices : wholeSteps(channel, indices);
  const scaled = withScaledTangents(valued, moved, valueFactor / (timeFactor === 0 ? 1 : timeFactor), timeFactor < 0);
  if (timeFactor === 1) return { channel: scaled, indices };
  const times = timesFor(moved, (k) => pivotSeconds + (channel.times[k] - pivotSeconds) * timeFactor);
  return arrangeKeys(scaled, moved, times, collision);
}

/** The channel with some keys' slopes multiplied, and in and out swapped if `mirrored`. */
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

/** `own` with some keys' tangents from `from`; the same object and columns if nothing changes. */
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
