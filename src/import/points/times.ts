/** The frame rate of frames whose times are given, with as many decimals as a program printed. */
import { isRate } from './table.ts';

/** Rates that programs record in, besides whole ones. */
const USUAL_RATES = [24_000 / 1001, 30_000 / 1001, 60_000 / 1001, 120_000 / 1001];
/** How far a rate may be off one of those, or a whole one, to be meant as that. */
const NEAR = 5e-4;
/** A step that is this much longer than the usual one leaves frames out. */
const GAP = 1.5;

/**
 * Frames per second of frames at these seconds, in order; undefined if they don't rise.
 * @param steps how many frames later than the first each is, rising, if some are left out
 */
export function rateOfTimes(times: Float64Array, steps?: Float64Array): number | undefined {
  const last = times.length - 1;
  if (last < 1) return undefined;
  const gaps = Float64Array.from({ length: last }, (_, i) => {
    return (times[i + 1] - times[i]) / (steps ? steps[i + 1] - steps[i] : 1);
  }).sort();
  const usual = gaps[last >> 1];
  const count = steps ? steps[last] - steps[0] : last;
  const seconds = (times[last] - times[0]) / count;
  const isEven = seconds < GAP * usual && usual < GAP * seconds;
  const rate = 1 / (isEven ? seconds : usual);
  if (!isRate(rate)) return undefined;
  const near = [Math.round(rate), ...USUAL_RATES].find((whole) => Math.abs(rate - whole) <= NEAR * whole);
  return near ?? Number(rate.toPrecision(6));
}
