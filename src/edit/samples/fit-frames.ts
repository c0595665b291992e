/**
 * Fits keys to a sampled channel within a tolerance: the method of *simplify* (`channels/simplify.ts`,
 * `channels/fit.ts`) on a smooth curve through the frames. A curve that stays within tolerance of a single value gets a
 * single key.
 *
 * Long takes are fitted in pieces, with a key where two pieces meet and the frames' own slope on both of its sides, so
 * that the curve is smooth there too. This costs an extra key per two thousand frames, and lets the page respond in
 * between.
 */
import { type KeyedChannel, NO_EXTRAPOLATION } from '../../model/takes/take.ts';
import { FIXED_TANGENT, SMOOTH } from '../../model/takes/tangent-kinds.ts';
import { simplifyChannel } from '../channels/simplify.ts';

const PIECE_FRAMES = 2048;

/**
 * Yields after each piece.
 * @param times of the frames, ascending
 * @param tolerance in the channel's unit; greater than 0
 */
export function* fittingFrames(
  times: Float64Array,
  values: Float64Array,
  tolerance: number,
): Generator<void, KeyedChannel> {
  const still = stillAt(times, values, tolerance);
  if (still) return still;
  const pieces: KeyedChannel[] = [];
  const last = times.length - 1;
  for (let from = 0; from < last; from += PIECE_FRAMES) {
    const to = Math.min(last, from + PIECE_FRAMES);
    pieces.push(simplifyChannel(piece(times, values, from, to), tolerance).channel);
    yield;
  }
  return joined(pieces);
}

/** A single key, if that is enough. */
function stillAt(times: Float64Array, values: Float64Array, tolerance: number): KeyedChannel | undefined {
  let low = values[0];
  let high = values[0];
  for (const value of values) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  if (!(high - low <= 2 * tolerance)) return undefined;
  return smoothChannel(times.slice(0, 1), Float64Array.of(high === low ? low : low + (high - low) / 2));
}

/** Frames `from` to `to` as keys, with fixed slopes at ends that are not the take's. */
function piece(times: Float64Array, values: Float64Array, from: number, to: number): KeyedChannel {
  const channel = smoothChannel(times.slice(from, to + 1), values.slice(from, to + 1));
  const fix = (side: KeyedChannel['tangentsIn'], key: number, frame: number) => {
    side.kinds[key] = FIXED_TANGENT;
    side.slopes[key] = (values[frame + 1] - values[frame - 1]) / (times[frame + 1] - times[frame - 1]);
  };
  if (from > 0) fix(channel.tangentsOut, 0, from);
  if (to < times.length - 1) fix(channel.tangentsIn, to - from, to);
  return channel;
}

function smoothChannel(times: Float64Array, values: Float64Array): KeyedChannel {
  const side = () => ({ kinds: new Uint8Array(times.length).fill(SMOOTH), slopes: new Float64Array(times.length) });
  return {
    kind: 'keys',
    ...NO_EXTRAPOLATION,
    times,
    values,
    tangentsIn: side(),
    tangentsOut: side(),
  };
}

/** Consecutive pieces, each ending with the first key of the next. */
function joined(pieces: readonly KeyedChannel[]): KeyedChannel {
  if (pieces.length === 1) return pieces[0];
  const count = pieces.reduce((sum, { times }) => sum + times.length - 1, 1);
  const whole = smoothChannel(new Float64Array(count), new Float64Array(count));
  let at = 0;
  for (const { times, values, tangentsIn, tangentsOut } of pieces) {
    const first = at > 0 ? 1 : 0;
    const to = at - 1 + (first === 0 ? 1 : 0);
    if (first) {
      // The existing key gets the out tangent of this piece.
      whole.tangentsOut.kinds[at - 1] = tangentsOut.kinds[0];
      whole.tangentsOut.slopes[at - 1] = tangentsOut.slopes[0];
    }
    whole.times.set(times.subarray(first), to + first);
    whole.values.set(values.subarray(first), to + first);
    whole.tangentsIn.kinds.set(tangentsIn.kinds.subarray(first), to + first);
    whole.tangentsIn.slopes.set(tangentsIn.slopes.subarray(first), to + first);
    whole.tangentsOut.kinds.set(tangentsOut.kinds.subarray(first), to + first);
    whole.tangentsOut.slopes.set(tangentsOut.slopes.subarray(first), to + first);
    at += times.length - first;
  }
  return whole;
}
