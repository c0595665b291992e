/**
 * Plays a take faster or slower: times are scaled about the start of its range, keys too, and the frames are sampled
 * again at the take's own rate. The way it goes stays the same.
 */
import type { Steps } from '../../evaluate/steps.ts';
import type { Character } from '../../model/document.ts';
import type { Take } from '../../model/takes/take.ts';
import { withMarkers } from '../../model/takes/with-markers.ts';
import { withKeysScaled } from '../keys/scale.ts';
import { retimed } from '../markers.ts';
import { resampling } from './resample.ts';

/**
 * Changes the speed of a take, with its keys, samples and markers.
 * @param factor greater than 0; 2 takes half the time. The same object for 1.
 */
export function* retiming(character: Character, take: Take, factor: number): Steps<Take> {
  if (factor === 1) return take;
  const [start, end] = take.range;
  const at = (seconds: number) => start + (seconds - start) / factor;
  const channels = take.channels.map((channel) => {
    if (channel.kind !== 'keys') return channel;
    const scaling = { pivotSeconds: start, timeFactor: 1 / factor, pivotValue: 0, valueFactor: 1 };
    return withKeysScaled(channel, [...channel.times.keys()], scaling, 'step').channel;
  });
  const { samples } = take;
  const timed: Take = withMarkers({ ...take, range: [start, at(end)], channels }, retimed(take.markers, at));
  if (!samples) return timed;
  const { startSeconds, frameSeconds } = samples;
  const scaled = { ...samples, startSeconds: at(startSeconds), frameSeconds: frameSeconds / factor };
  const made = yield* resampling(character, { ...timed, samples: scaled }, 1 / frameSeconds);
  return { ...made, ...(made.samples && { samples: { ...made.samples, frameSeconds } }) };
}
