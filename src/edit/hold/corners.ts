/**
 * Where a take turns sharply: a foot that touches the ground, a hand that lets go. The pose that compensates for it
 * turns as sharply, so those times become frames of their own, and curves get different slopes on either side of them.
 */
import { resolvedSlopes } from '../../evaluate/slopes.ts';
import type { Take } from '../../model/takes/take.ts';
import { withExtrapolationBaked } from '../channels/bake-extrapolation.ts';

/** Slopes that differ by less than this fraction, or by this little per second, are equal. */
const SAME_SLOPE = 1e-3;

/**
 * The times at which a curve of these channels has different slopes on either side; seconds of the take, ascending.
 * @param between only times strictly between
 */
export function cornerTimes(take: Take, channels: readonly number[], [from, to]: readonly [number, number]): number[] {
  const found = new Set<number>();
  for (const channel of channels) {
    const own = take.channels[channel];
    if (own.kind !== 'keys' || own.times.length < 2) continue;
    const curve = withExtrapolationBaked(own, from, to).channel;
    const slopes = resolvedSlopes(curve);
    for (let k = 1; k + 1 < curve.times.length; k++) {
      const time = curve.times[k];
      if (time <= from || time >= to) continue;
      const [a, b] = [slopes.in[k], slopes.out[k]];
      if (Math.abs(b - a) > SAME_SLOPE * (1 + Math.max(Math.abs(a), Math.abs(b)))) found.add(time);
    }
  }
  return [...found].sort((a, b) => a - b);
}
