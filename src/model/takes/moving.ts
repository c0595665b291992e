/** Which takes move. Scenes of other programs often begin with one that doesn't: an empty one, or a T-pose. */

import type { Samples } from './samples.ts';
import type { Channel, Take } from './take.ts';

/** Values that differ by less stay put: radians, weights, or a part of the value. Files hold floats. */
const STILL = 1e-5;

/** Index of the take that is shown first: the first that moves, or the first if none does; -1 without takes. */
export function firstTake(takes: readonly Take[]): number {
  // Looking through all frames of a lone capture would decide nothing.
  if (takes.length < 2) return takes.length - 1;
  return Math.max(0, takes.findIndex(moves));
}

function moves({ channels, samples, range }: Take): boolean {
  return range[1] > range[0] && (channels.some(hasMotion) || (samples !== undefined && samplesMove(samples)));
}

function hasMotion(channel: Channel): boolean {
  if (channel.kind !== 'keys') return false;
  const { values, tangentsIn, tangentsOut } = channel;
  const isSloped = [tangentsIn, tangentsOut].some(({ slopes }) => slopes.some((slope) => Math.abs(slope) > STILL));
  return isSloped || values.some((value) => differs(value, values[0]));
}

function samplesMove({ values, scales, frameCount }: Samples): boolean {
  const width = scales.length;
  for (let column = 0; column < width; column++) {
    for (let frame = 1; frame < frameCount; frame++) {
      const scale = scales[column];
      if (differs(scale * values[frame * width + column], scale * values[column])) return true;
    }
  }
  return false;
}

function differs(a: number, b: number): boolean {
  return Math.abs(a - b) > STILL * Math.max(1, Math.abs(b));
}
