/**
 * Reverses a take, frames and keys, about the middle of its samples: the last frame becomes the first.
 *
 *     t  →  start + stop − t
 */

import { STEP_VALUES, type Steps } from '../../evaluate/steps.ts';
import { rangeOfSamples } from '../../model/takes/samples.ts';
import type { Channel, Take } from '../../model/takes/take.ts';
import { withMarkers } from '../../model/takes/with-markers.ts';
import { sameValue } from '../delta.ts';
import { withKeysScaled } from '../keys/scale.ts';
import { retimed } from '../markers.ts';
import { requireSamples } from './frames.ts';

/**
 * Reverses a take with samples, with its keys, range and markers; yields the fraction that is done.
 * @throws CommandError if it has no samples
 */
export function* reversing(take: Take): Steps<Take> {
  const samples = requireSamples(take);
  const { values, scales, frameCount } = samples;
  const width = scales.length;
  const backwards = new Float64Array(values.length);
  const rows = Math.max(1, Math.floor(STEP_VALUES / Math.max(1, width)));
  for (let from = 0; from < frameCount; from += rows) {
    const to = Math.min(frameCount, from + rows);
    for (let f = from; f < to; f++) {
      const source = f * width;
      const target = (frameCount - 1 - f) * width;
      for (let c = 0; c < width; c++) backwards[target + c] = values[source + c];
    }
    yield to / frameCount;
  }
  const [start, stop] = rangeOfSamples(samples);
  const mirror = (seconds: number) => start + stop - seconds;
  const reversed = {
    ...take,
    range: [mirror(take.range[1]), mirror(take.range[0])] as const,
    channels: take.channels.map((channel) => reversedKeys(channel, (start + stop) / 2)),
    samples: sameValue(backwards, values) ? samples : { ...samples, values: backwards },
  };
  return withMarkers(reversed, retimed(take.markers, mirror));
}

function reversedKeys(channel: Channel, pivotSeconds: number): Channel {
  if (channel.kind !== 'keys') return channel;
  const scaling = { pivotSeconds, timeFactor: -1, pivotValue: 0, valueFactor: 1 };
  const { channel: turned } = withKeysScaled(channel, [...channel.times.keys()], scaling, 'step');
  return { ...turned, extrapolateIn: channel.extrapolateOut, extrapolateOut: channel.extrapolateIn };
}
