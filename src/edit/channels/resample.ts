/**
 * Resamples with a key on every frame, for frame-based tools, or to start again from an even grid. Frame n is at n /
 * rate seconds of the take, plus a given offset: frames are those of the transport, and a character may start later.
 *
 * `smooth` gives each key the curve's slope there, as a number. Cubics with the true slopes at both ends are off by
 * h⁴/384 · |f⁗|; the tangent kind `smooth` would take its slopes from the neighbours, be off by h³, and overshoot next
 * to a step. At a corner the two sides have different slopes. `linear` is off by h²/8 · |f″|.
 *
 * A step on a frame is kept. Between two frames it can't be: it becomes a ramp over that frame. The distance between
 * the new curve and the old is measured, including such steps.
 */
import { compileChannels } from '../../evaluate/compiled-take.ts';
import { resolvedSlopes } from '../../evaluate/slopes.ts';
import type { KeyedChannel } from '../../model/takes/take.ts';
import { FIXED_TANGENT, LINEAR } from '../../model/takes/tangent-kinds.ts';
import { CommandError } from '../command-error.ts';
import { type Key, keyAt, tangent, withKeyList } from '../keys/columns.ts';
import { unrolled } from './bake-extrapolation.ts';
import { type Difference, largestDifference } from './difference.ts';
import { frozen, meets, slopedKey, withSeamFrozen } from './sloped-key.ts';

/** Frames at which a channel gets keys, and how these are joined. */
export interface Resampling {
  readonly framesPerSecond: number;
  /**
   * Time of frame 0, in seconds of the take; default 0. Pass the character's time offset to use the transport's frames,
   * which are the visible ones.
   */
  readonly offsetSeconds?: number;
  /** Seconds of the take: all frames in between, both included, get a key. */
  readonly from: number;
  readonly to: number;
  readonly tangents: 'linear' | 'smooth';
}

/** The result of resampling; `largestError` is relative to the previous curve, extrapolation included. */
export interface Resampled extends Difference {
  readonly channel: KeyedChannel;
  readonly keysBefore: number;
  readonly keysAfter: number;
}

const MAX_KEYS = 1_000_000;
/** Files round times to a few digits: a key this close to a frame, in seconds, is on it. */
const ON_FRAME = 1e-5;

/**
 * The channel with keys on all frames of the range, replacing the previous ones. Keys before the first frame and after
 * the last one are kept, with the curve between them. Frames beyond the ends take the extrapolated value; repetitions
 * on that side become constant, since the period has changed. The same object if it has no key or the range no frame.
 * Throws a `CommandError` above a million frames.
 */
export function resampleChannel(channel: KeyedChannel, resampling: Resampling): Resampled {
  const { framesPerSecond, offsetSeconds = 0, from, to, tangents } = resampling;
  const keysBefore = channel.times.length;
  // Adding 0 avoids −0, which would be written to files.
  const firstFrame = Math.ceil((from - offsetSeconds - ON_FRAME) * framesPerSecond) + 0;
  const lastFrame = Math.floor((to - offsetSeconds + ON_FRAME) * framesPerSecond) + 0;
  // Beyond, one frame isn't told from the next.
  if (!Number.isSafeInteger(firstFrame) || !Number.isSafeInteger(lastFrame)) {
    throw new CommandError(
      `Times from ${from} s to ${to} s are too large for frame numbers at ${framesPerSecond} fps.`,
    );
  }
  if (lastFrame - firstFrame >= MAX_KEYS) {
    throw new CommandError(`That would take ${lastFrame - firstFrame + 1} keys per curve, which is too many.`);
  }
  if (keysBefore === 0 || firstFrame > lastFrame) {
    return { channel, keysBefore, keysAfter: keysBefore, largestError: 0, atSeconds: channel.times[0] ?? 0 };
  }
  const timeOf = (frame: number) => frame / framesPerSecond + offsetSeconds;
  const whole = withSeamFrozen(unrolled(channel, timeOf(firstFrame), timeOf(lastFrame)));
  const resampled = withKeyList(whole, framesOf(whole, firstFrame, lastFrame, timeOf, tangents === 'linear'));
  return {
    channel: resampled,
    keysBefore,
    keysAfter: resampled.times.length,
    ...largestDifference(whole, resampled),
  };
}

/** Keys on the frames of a channel that extends from the first to the last one, and its own keys outside. */
function framesOf(
  channel: KeyedChannel,
  firstFrame: number,
  lastFrame: number,
  timeOf: (frame: number) => number,
  isLinear: boolean,
): Key[] {
  const { times } = channel;
  const { cubics } = compileChannels([channel]);
  const slopes = resolvedSlopes(channel);
  const last = times.length - 1;
  const keys: Key[] = [];
  const borderKey = (key: number) => frozen(slopedKey(channel, slopes, key));
  let k = 0;
  for (; k <= last && times[k] < timeOf(firstFrame) - ON_FRAME; k++) keys.push(keyAt(channel, k));
  if (k > 0) keys[k - 1] = borderKey(k - 1);
  for (let frame = firstFrame; frame <= lastFrame; frame++) {
    const time = timeOf(frame);
    // Outwards the slope is a number, since the curve there is kept.
    const sideIn = (slope: number) =>
      isLinear && frame > firstFrame ? tangent(LINEAR) : tangent(FIXED_TANGENT, slope);
    const sideOut = (slope: number) =>
      isLinear && frame < lastFrame ? tangent(LINEAR) : tangent(FIXED_TANGENT, slope);
    while (k <= last && times[k] < time - ON_FRAME) k++;
    let end = k;
    while (end <= last && times[end] <= time + ON_FRAME) end++;
    if (end > k) {
      pushOwn(channel, k, end, { time, value: 0, in: sideIn(slopes.in[k]), out: sideOut(slopes.out[end - 1]) }, keys);
      k = end;
      continue;
    }
    const o = 4 * (k - 1);
    const t = time - times[k - 1];
    const value = ((cubics[o + 3] * t + cubics[o + 2]) * t + cubics[o + 1]) * t + cubics[o];
    const slope = (3 * cubics[o + 3] * t + 2 * cubics[o + 2]) * t + cubics[o + 1];
    keys.push({ time, value, in: sideIn(slope), out: sideOut(slope) });
  }
  if (k <= last) keys.push(borderKey(k));
  for (k++; k <= last; k++) keys.push(keyAt(channel, k));
  return keys;
}

/** The frame's key if the channel has keys of its own on it, `from` up to `end`: the nearest one, or their step. */
function pushOwn({ times, values }: KeyedChannel, from: number, end: number, key: Key, keys: Key[]): void {
  let nearest = from;
  let isStep = false;
  for (let k = from; k < end; k++) {
    if (Math.abs(times[k] - key.time) < Math.abs(times[nearest] - key.time)) nearest = k;
    isStep ||= k > from && times[k] === times[k - 1] && !meets(values[k], values[k - 1]);
  }
  if (isStep) keys.push({ ...key, value: values[from] }, { ...key, value: values[end - 1] });
  else keys.push({ ...key, value: values[nearest] });
}
