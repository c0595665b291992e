/** Setting keys to exact, typed numbers. */
import type { KeyedChannel } from '../../model/takes/take.ts';
import { FIXED_TANGENT } from '../../model/takes/tangent-kinds.ts';
import { arrangeKeys, type EditedChannel, timesFor } from './arrange.ts';
import { tangent } from './columns.ts';
import { withValues } from './move.ts';
import { wholeSteps } from './steps.ts';
import { withTangents } from './tangents.ts';

/** Omitted numbers are not changed. */
export interface TypedKey {
  /** Seconds of the take. */
  readonly timeSeconds?: number;
  readonly value?: number;
  /** Value per second; makes that side FIXED. */
  readonly slopeIn?: number;
  readonly slopeOut?: number;
}

/**
 * The channel with these numbers at all given keys; the same object if nothing changes. A key that lands on another's
 * time replaces it; of several given keys put at one time the last is kept.
 * @param indices ascending, unique
 */
export function withKeysSet(
  channel: KeyedChannel,
  indices: readonly number[],
  { timeSeconds, value, slopeIn, slopeOut }: TypedKey,
): EditedChannel {
  const valued = value === undefined ? channel : withValues(channel, indices, () => value);
  const sloped = withTangents(valued, indices, (_k, side) => {
    const slope = side === 'in' ? slopeIn : slopeOut;
    return slope === undefined ? undefined : tangent(FIXED_TANGENT, slope);
  });
  if (timeSeconds === undefined) return { channel: sloped, indices };
  const whole = wholeSteps(channel, indices);
  return arrangeKeys(sloped, whole, new Float64Array(whole.length).fill(timeSeconds), 'replace');
}

/**
 * The channel with keys moved to the nearest frame; of several on one frame the last is kept.
 * @param offsetSeconds time of frame 0, in seconds of the take
 */
export function withKeysSnapped(
  channel: KeyedChannel,
  indices: readonly number[],
  framesPerSecond: number,
  offsetSeconds = 0,
): EditedChannel {
  // Adding 0 avoids −0.
  const toFrame = (time: number) =>
    Math.round((time - offsetSeconds) * framesPerSecond) / framesPerSecond + offsetSeconds + 0;
  const whole = wholeSteps(channel, indices);
  return arrangeKeys(
    channel,
    whole,
    timesFor(whole, (k) => toFrame(channel.times[k])),
    'replace',
  );
}
