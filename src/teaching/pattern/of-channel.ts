/** Where the values of a channel differ, and what makes ours theirs there. */
import { type Channel, type KeyedChannel, repeats } from '../../model/takes/take.ts';
import { shortNumber } from '../compare/short-number.ts';
import { sidesOf } from '../program/jumps.ts';

/** Samples of one channel, by time. */
export interface ChannelSamples {
  readonly times: Float64Array;
  readonly theirs: Float64Array;
  readonly ours: Float64Array;
}

/** In words, with a comma before them; undefined if all agree. */
export function channelPattern(
  channel: Channel | undefined,
  samples: ChannelSamples,
  tolerance: number,
): string | undefined {
  const { times, theirs, ours } = samples;
  const wrong = Array.from(times.keys()).filter((i) => !(Math.abs(theirs[i] - ours[i]) <= tolerance));
  if (wrong.length === 0) return undefined;
  const keys = channel?.kind === 'keys' ? channel : undefined;
  if (wrong.length === 1) return `, at ${times[wrong[0]]} s alone, ${byText(theirs[wrong[0]] - ours[wrong[0]])}`;
  const where = keys
    ? placeText(
        keys,
        wrong.map((i) => times[i]),
      )
    : '';
  return `${where}, ${howText(keys, samples, wrong, tolerance)}`;
}

/** `, after its last key`; nothing if they are on all sides. */
function placeText({ times: keyTimes }: KeyedChannel, times: readonly number[]): string {
  const last = keyTimes.length - 1;
  const isBefore = (time: number) => time < keyTimes[0];
  const isAfter = (time: number) => time > keyTimes[last];
  if (times.every(isBefore)) return ', before its first key';
  if (times.every(isAfter)) return ', after its last key';
  if (times.every((time) => isBefore(time) || isAfter(time))) return ', outside its keys';
  if (times.some((time) => isBefore(time) || isAfter(time))) return '';
  for (let k = 0; k < last; k++) {
    if (times.every((time) => time >= keyTimes[k] && time <= keyTimes[k + 1]))
      return `, between its keys at ${shortNumber(keyTimes[k])} and ${shortNumber(keyTimes[k + 1])} s`;
  }
  return ', between its keys';
}

function howText(
  keys: KeyedChannel | undefined,
  { times, theirs, ours }: ChannelSamples,
  wrong: readonly number[],
  tolerance: number,
): string {
  if (wrong.some((i) => !Number.isFinite(theirs[i]))) return 'where some are not finite numbers';
  const differences = wrong.map((i) => theirs[i] - ours[i]);
  const isNear = (a: number, b: number) => Math.abs(a - b) <= tolerance;
  if (differences.every((d) => isNear(d, differences[0]))) return byText(differences[0]);
  const all = Array.from(times.keys());
  const before = (i: number) => all.every((s) => s + i < 0 || s + i >= all.length || isNear(theirs[s], ours[s + i]));
  if (all.length > MIN_SAMPLES && before(-1)) return 'of the sample before';
  if (all.length > MIN_SAMPLES && before(1)) return 'of the sample after';
  if (wrong.length > MIN_SAMPLES && wrong.every((i) => isNear(theirs[i], theirs[wrong[0]])))
    return `where all are ${shortNumber(theirs[wrong[0]])}`;
  const scale =
    all.reduce((sum, i) => sum + theirs[i] * ours[i], 0) / all.reduce((sum, i) => sum + ours[i] * ours[i], 0);
  if (wrong.length > 2 && all.every((i) => isNear(theirs[i], scale * ours[i])))
    return isNear(scale, -1) ? 'negated' : `scaled by ${shortNumber(scale)}`;
  const periods =
    keys &&
    periodsOf(
      keys,
      wrong.map((i) => times[i]),
    );
  const perPeriod = periods && slopeOf(periods, differences, tolerance);
  if (perPeriod !== undefined) return `${byText(perPeriod)} more each period`;
  const perSecond = slopeOf(
    wrong.map((i) => times[i]),
    differences,
    tolerance,
  );
  if (perSecond !== undefined) return `${byText(perSecond)} more each second`;
  return `by up to ${shortNumber(differences.reduce((most, d) => Math.max(most, Math.abs(d)), 0))}`;
}

/** Samples that tell a shift or a constant. */
const MIN_SAMPLES = 3;

const byText = (difference: number) =>
  Number.isFinite(difference) ? `by ${shortNumber(difference)}` : 'which is not a finite number';

/** In which period after the keys each time is, 1 the first; negative before them. Undefined if the channel doesn't repeat there. */
function periodsOf(keys: KeyedChannel, times: readonly number[]): readonly number[] | undefined {
  const [first, last] = [keys.times[0], keys.times[keys.times.length - 1]];
  const isRepeated = (time: number) => repeats(time < first ? keys.extrapolateIn : keys.extrapolateOut);
  const isOutside = (time: number) => time < first || time > last;
  if (!(last > first) || !times.every((time) => isOutside(time) && isRepeated(time))) return undefined;
  // What is at the end of a period may be of either.
  return times.map((time) => {
    const [a, b] = sidesOf(time).map((side) => Math.floor((side - first) / (last - first)));
    return a === b ? a : Number.NaN;
  });
}

/** The slope of a line through all; undefined if there is none, or fewer than three places. */
function slopeOf(at: readonly number[], values: readonly number[], tolerance: number): number | undefined {
  const known = at.flatMap((x, i) => (Number.isNaN(x) ? [] : [i]));
  const places = new Set(known.map((i) => at[i]));
  if (places.size < 2 || known.length < MIN_SAMPLES) return undefined;
  const meanAt = known.reduce((sum, i) => sum + at[i], 0) / known.length;
  const mean = known.reduce((sum, i) => sum + values[i], 0) / known.length;
  let [product, square] = [0, 0];
  for (const i of known) {
    product += (at[i] - meanAt) * (values[i] - mean);
    square += (at[i] - meanAt) ** 2;
  }
  const slope = product / square;
  const isLine = known.every((i) => Math.abs(values[i] - mean - slope * (at[i] - meanAt)) <= tolerance);
  return isLine && (places.size > 2 || known.length > 2 * places.size - 1) ? slope : undefined;
}
