/** Our values of the channels that are compared. */
import { compileTake } from '../../evaluate/compiled-take.ts';
import { evaluateChannel } from '../../evaluate/curves.ts';
import { type Character, shownTake } from '../../model/document.ts';
import type { ChannelTarget } from '../compare/targets.ts';
import { nearestSide } from './jumps.ts';

/** Our values at the samples; where the value jumps, that of the side which is nearest theirs. */
export function valuesNearest(character: Character, target: ChannelTarget, tolerance: number): Float64Array {
  const take = shownTake(character);
  const compiled = take && compileTake(take);
  const { channels, times, values } = target;
  return Float64Array.from(channels, (c, i) => {
    if (!compiled) return 0;
    const valueAt = (time: number) => evaluateChannel(compiled, c, time);
    // Frames don't jump at a time: between them is what lies between them.
    if (take.channels[c]?.kind !== 'keys') return valueAt(times[i]);
    return nearestSide(times[i], values[i], tolerance, valueAt);
  });
}

/** Our values at the samples. */
export function ownValues(character: Character, { channels, times }: Omit<ChannelTarget, 'values'>): Float64Array {
  const take = shownTake(character);
  const compiled = take && compileTake(take);
  return Float64Array.from(channels, (c, i) => (compiled ? evaluateChannel(compiled, c, times[i]) : 0));
}
