/** Keys with exact, typed numbers. */
import { FIXED_TANGENT, type KeyedChannel } from '../../model/clip.ts';
import { arrangeKeys, type EditedChannel, timesFor } from './arrange.ts';
import { tangent } from './columns.ts';
import { withValues } from './move.ts';
import { withTangents } from './tangents.ts';

/** What is given is set, the rest stays. */
export interface TypedKey {
  /** Of the clip. */
  readonly timeSeconds?: number | undefined;
  readonly value?: number | undefined;
  /** Value per second; makes that side FIXED. */
  readonly slopeIn?: number | undefined;
  readonly slopeOut?: number | undefined;
}

/**
 * The channel with these numbers at all of the given keys; the very same where nothing changes. A key that comes to
 * another's time replaces it; of several given keys that are put at one time the last stays.
 * @param indices ascending, each once
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
  return arrangeKeys(sloped, indices, new Float64Array(indices.length).fill(timeSeconds), 'replace');
}

/**
 * The channel with keys moved to the nearest frame; of those that come to one frame the last stays.
 * @param offsetSeconds where frame 0 is, in seconds of the clip
 */
export function withKeysSnapped(
  channel: KeyedChannel,
  indices: readonly number[],
  framesPerSecond: number,
  offsetSeconds = 0,
): EditedChannel {
  // Plus 0: frame −0 is frame 0.
  const toFrame = (time: number) =>
    Math.round((time - offsetSeconds) * framesPerSecond) / framesPerSecond + offsetSeconds + 0;
  return arrangeKeys(
    channel,
    indices,
    timesFor(indices, (k) => toFrame(channel.times[k])),
    'replace',
  );
}
