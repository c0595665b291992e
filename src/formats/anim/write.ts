/**
 * Writes `.anim`. A channel that rests at a value becomes a single key at the start of the range, and a sampled one
 * gets a key per frame: the format has no other way. Those keys are the samples' values; to avoid jumps of angles,
 * convert to keys first (`edit/convert/keys-of-samples.ts`).
 */

import { autoNumber } from '../../model/takes/auto-slope.ts';
import { columnOf, type Samples } from '../../model/takes/samples.ts';
import type { KeyedChannel, RestChannel, Take, Tangents } from '../../model/takes/take.ts';
import { AUTO_TANGENT, FIXED_TANGENT, TANGENT_KINDS } from '../../model/takes/tangent-kinds.ts';
import type { WriteResult } from '../reader.ts';
import { Text, UnwritableError } from '../write-text.ts';

/**
 * Writes a `.anim`.
 * @param fileName appears in diagnostics
 * @throws UnwritableError for a take without channels, and for numbers that aren't finite
 */
export function writeAnim(take: Take, fileName = ''): WriteResult {
  // No reader takes such a file.
  if (take.channels.length === 0)
    throw new UnwritableError(`Expected channels in ${take.name}, found none. Key a DOF first.`);
  const text = new Text(fileName);
  text.line(0, 'animation {');
  text.about('the range');
  text.line(1, `range ${text.numbers(take.range)}`);
  text.line(1, `numchannels ${take.channels.length}`);
  take.channels.forEach((channel, c) => {
    text.about(`channel ${c}`);
    text.line(1, 'channel {');
    text.line(2, `extrapolate ${channel.extrapolateIn} ${channel.extrapolateOut}`);
    if (channel.kind === 'keys') writeKeys(text, channel);
    else if (channel.kind === 'rest') writeRest(text, channel, take.range[0]);
    else if (take.samples) writeSampled(text, take.samples, columnOf(take.samples, c));
    text.line(2, '}');
    text.line(1, '}');
  });
  text.line(0, '}');
  return text.result();
}

function writeKeys(text: Text, channel: KeyedChannel): void {
  const { times, values, tangentsIn, tangentsOut } = channel;
  text.line(2, `keys ${times.length} {`);
  for (let k = 0; k < times.length; k++) {
    text.row = k + 1;
    const tangents = `${tangent(text, channel, tangentsIn, k)} ${tangent(text, channel, tangentsOut, k)}`;
    text.line(3, `${text.number(times[k])} ${text.number(values[k])} ${tangents}`);
  }
}

/** Readers take a channel without keys as 0. */
function writeRest(text: Text, { value }: RestChannel, start: number): void {
  text.line(2, `keys ${value === 0 ? 0 : 1} {`);
  if (value !== 0) text.line(3, `${text.number(start)} ${text.number(value)} flat flat`);
}

function writeSampled(text: Text, { frameCount, frameSeconds, startSeconds, scales, values }: Samples, column: number) {
  text.line(2, `keys ${frameCount} {`);
  for (let f = 0; f < frameCount; f++) {
    text.row = f + 1;
    const value = values[f * scales.length + column] * scales[column];
    text.line(3, `${text.number(startSeconds + f * frameSeconds)} ${text.number(value)} linear linear`);
  }
}

function tangent(text: Text, channel: KeyedChannel, { kinds, slopes }: Tangents, key: number): string {
  if (kinds[key] === AUTO_TANGENT) return text.number(autoNumber(channel, key, slopes[key]));
  return kinds[key] === FIXED_TANGENT ? text.number(slopes[key]) : (TANGENT_KINDS[kinds[key]] ?? 'flat');
}
