/** Our values of the channels that are compared. */
import { compileClip } from '../evaluate/compiled-clip.ts';
import { evaluateChannel } from '../evaluate/curves.ts';
import { type Character, shownClip } from '../model/document.ts';
import type { ChannelTarget } from './targets.ts';

/** Of the samples. */
export function ownValues(character: Character, { channels, times }: ChannelTarget): Float64Array {
  const clip = shownClip(character);
  const compiled = clip && compileClip(clip);
  return Float64Array.from(channels, (c, i) => (compiled ? evaluateChannel(compiled, c, times[i]) : 0));
}
