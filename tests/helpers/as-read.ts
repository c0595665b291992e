/** Keys as a file gives them back. */
import { autoSlope, withAutoRecognised } from '../../src/model/takes/auto-slope.ts';
import type { Channel, KeyedChannel, Tangents } from '../../src/model/takes/take.ts';
import { AUTO_TANGENT, FIXED_TANGENT } from '../../src/model/takes/tangent-kinds.ts';

/**
 * A channel as an `.anim` gives it back: an `auto` slope is a number there, and any number that is one is read as
 * `auto`.
 */
export function asRead(channel: Channel): Channel {
  return channel.kind === 'keys' ? withAutoRecognised(withNumbers(channel)) : channel;
}

function withNumbers(keys: KeyedChannel): KeyedChannel {
  const side = ({ kinds, slopes }: Tangents): Tangents => ({
    kinds: kinds.map((kind) => (kind === AUTO_TANGENT ? FIXED_TANGENT : kind)),
    slopes: slopes.map((slope, k) => (kinds[k] === AUTO_TANGENT ? autoSlope(keys, k) : slope)),
  });
  return { ...keys, tangentsIn: side(keys.tangentsIn), tangentsOut: side(keys.tangentsOut) };
}
