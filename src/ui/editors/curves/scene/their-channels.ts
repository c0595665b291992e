/** Channels as another program printed them, in the order of their times, and where they are wrong. */
import { firstNotBelow } from '../../../../math/search.ts';
import { perObject } from '../../../../model/per-object.ts';
import type { ComparedResult } from '../../../state/dump-comparison.ts';
import { errorSize, shown } from '../../../widgets/numbers/number-text.ts';

export interface TheirChannel {
  /** Ascending; seconds of the take. */
  readonly times: Float64Array;
  /** Theirs and ours, in model units. */
  readonly values: Float64Array;
  readonly ours: Float64Array;
  /** 1 if a value is off by more than the tolerance, or no number. */
  readonly wrong: Uint8Array;
  /** The largest difference; infinite if a value is not a number. */
  readonly largest: number;
  /** Time of the first wrong value; undefined if all agree. */
  readonly firstWrong: number | undefined;
}

/** By channel of the take. */
export type TheirChannels = ReadonlyMap<number, TheirChannel>;

/** Cached; undefined if no channels were compared. */
export const theirChannels = perObject(({ targets, comparison, tolerance }: ComparedResult) => {
  const { channels, times, values } = targets.channels;
  if (channels.length === 0) return undefined;
  const samples = new Map<number, number[]>();
  channels.forEach((channel, i) => {
    const own = samples.get(channel);
    if (own) own.push(i);
    else samples.set(channel, [i]);
  });
  const made = new Map<number, TheirChannel>();
  for (const [channel, all] of samples) {
    all.sort((a, b) => times[a] - times[b]);
    made.set(channel, channelOf(all, times, values, comparison.ourChannels, tolerance));
  }
  return made satisfies TheirChannels;
});

function channelOf(
  samples: readonly number[],
  times: Float64Array,
  values: Float64Array,
  ours: Float64Array,
  tolerance: number,
): TheirChannel {
  const differences = samples.map((i) => Math.abs(values[i] - ours[i]));
  // Not `>`: NaN is wrong too.
  const wrong = Uint8Array.from(differences, (difference) => (difference <= tolerance ? 0 : 1));
  const first = wrong.indexOf(1);
  return {
    times: Float64Array.from(samples, (i) => times[i]),
    values: Float64Array.from(samples, (i) => values[i]),
    ours: Float64Array.from(samples, (i) => ours[i]),
    wrong,
    largest: differences.reduce((most, d) => Math.max(most, Number.isNaN(d) ? Number.POSITIVE_INFINITY : d), 0),
    firstWrong: first < 0 ? undefined : times[samples[first]],
  };
}

/** `yours differs by up to 0.12, first at 0.4 s`, in model units. */
export function theirsText({ largest, firstWrong }: TheirChannel): string {
  if (firstWrong === undefined) return 'yours agrees';
  const size = Number.isFinite(largest) ? ` by up to ${errorSize(largest)}` : ', with values that are not numbers';
  return `yours differs${size}, first at ${shown(firstWrong)} s`;
}

/** The sample nearest to a time; −1 if there is none within `reach` seconds. */
export function sampleNear({ times }: TheirChannel, time: number, reach: number): number {
  const after = firstNotBelow(times, time);
  const before = after - 1;
  const isBefore = after >= times.length || (before >= 0 && time - times[before] < times[after] - time);
  const nearest = isBefore ? before : after;
  return nearest >= 0 && nearest < times.length && Math.abs(times[nearest] - time) <= reach ? nearest : -1;
}
