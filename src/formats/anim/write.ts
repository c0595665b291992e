/**
 * Writes `.anim`. A channel that stands at a value without keys becomes a lone key at the beginning of the range, and
 * one that follows samples has a key a frame: the format knows no other way to say so. Those keys are what the samples
 * are; who wants angles without jumps between them makes keys first (`edit/convert/keys-of-samples.ts`).
 */
import { type Channel, type ChannelClip, FIXED, isSampled, TANGENT_KINDS, type Tangents } from '../../model/clip.ts';
import { columnOf, type Samples } from '../../model/samples.ts';
import type { WriteResult } from '../reader.ts';
import { Text } from '../write-text.ts';

/** `fileName` is what diagnostics name. */
export function writeAnim(clip: ChannelClip, fileName = ''): WriteResult {
  const text = new Text(fileName);
  text.line(0, 'animation {');
  text.line(1, `range ${text.numbers(clip.range)}`);
  text.line(1, `numchannels ${clip.channels.length}`);
  clip.channels.forEach((channel, c) => {
    if (clip.samples && isSampled(clip, c)) writeSampled(text, channel, clip.samples, columnOf(clip.samples, c));
    else writeChannel(text, channel, clip.range[0]);
  });
  text.line(0, '}');
  return text.result();
}

function writeChannel(text: Text, channel: Channel, start: number): void {
  const { times, values, tangentsIn, tangentsOut, rest } = channel;
  text.line(1, 'channel {');
  text.line(2, `extrapolate ${channel.extrapolateIn} ${channel.extrapolateOut}`);
  const standsStill = times.length === 0 && rest !== undefined;
  text.line(2, `keys ${standsStill ? 1 : times.length} {`);
  if (standsStill) text.line(3, `${text.number(start)} ${text.number(rest)} flat flat`);
  for (let k = 0; k < times.length; k++) {
    const tangents = `${tangent(text, tangentsIn, k)} ${tangent(text, tangentsOut, k)}`;
    text.line(3, `${text.number(times[k])} ${text.number(values[k])} ${tangents}`);
  }
  text.line(2, '}');
  text.line(1, '}');
}

function writeSampled(text: Text, channel: Channel, samples: Samples, column: number): void {
  const { frameCount, frameSeconds, startSeconds, scales, values } = samples;
  text.line(1, 'channel {');
  text.line(2, `extrapolate ${channel.extrapolateIn} ${channel.extrapolateOut}`);
  text.line(2, `keys ${frameCount} {`);
  for (let f = 0; f < frameCount; f++) {
    const value = values[f * scales.length + column] * scales[column];
    text.line(3, `${text.number(startSeconds + f * frameSeconds)} ${text.number(value)} linear linear`);
  }
  text.line(2, '}');
  text.line(1, '}');
}

function tangent(text: Text, { kinds, slopes }: Tangents, key: number): string {
  return kinds[key] === FIXED ? text.number(slopes[key]) : (TANGENT_KINDS[kinds[key]] ?? 'flat');
}
