/** A new key past the ends lengthens what repeats. That is no mistake, but nobody should have to find it out. */
import type { Channel, ChannelClip, Extrapolation } from '../../model/clip.ts';
import { plural, shown } from '../number-text.ts';

const REPEATING: readonly Extrapolation[] = ['cycle', 'cycle_offset', 'bounce'];

/** A sentence about the channels whose repetition takes longer or shorter than before; undefined where none does. */
export function periodNote(before: ChannelClip, after: ChannelClip, name: (channel: number) => string) {
  const changed: number[] = [];
  after.channels.forEach((channel, i) => {
    const was = before.channels[i];
    if (was === channel || !was || !repeats(channel) || !was.times.length) return;
    if (period(was) !== period(channel)) changed.push(i);
  });
  if (!changed.length) return undefined;
  const [first] = changed;
  const [from, to] = [period(before.channels[first]), period(after.channels[first])];
  const which = changed.length === 1 ? name(first) : `${plural(changed.length, 'channel')}, ${name(first)} among them,`;
  const verb = changed.length === 1 ? 'repeats' : 'repeat';
  return `${which} now ${verb} every ${shown(to, 3)} s instead of every ${shown(from, 3)} s.`;
}

function repeats({ extrapolateIn, extrapolateOut }: Channel): boolean {
  return REPEATING.includes(extrapolateIn) || REPEATING.includes(extrapolateOut);
}

function period({ times }: Channel): number {
  return times[times.length - 1] - times[0];
}
