/** Results of an operation on several channels, as numbers that can also be shown in advance. */
import type { DofUnit } from '../../model/skeleton/skeleton.ts';
import type { Difference } from './difference.ts';

/** "1,240 → 86 keys, largest error 0.12° at 1.3 s". */
export interface Reduction {
  /** Number of channels whose keys changed. */
  readonly changed: number;
  /** Keys of all given channels together. */
  readonly keysBefore: number;
  readonly keysAfter: number;
  /** The largest error for each unit, since angles, lengths and weights can't be compared. */
  readonly largest: Readonly<Partial<Record<DofUnit, WorstChannel>>>;
}

/** The channel of one unit that changed most, by index in the take. */
export interface WorstChannel extends Difference {
  readonly channel: number;
}

/** The result for one channel. */
export interface ChannelResult extends Difference {
  readonly keysBefore: number;
  readonly keysAfter: number;
}

/** Adds the results of several channels up, with the largest error of each unit. */
export function reductionOf(
  results: readonly { readonly index: number; readonly changed: boolean; readonly result: ChannelResult }[],
  unitOf: (channel: number) => DofUnit,
): Reduction {
  let changed = 0;
  let keysBefore = 0;
  let keysAfter = 0;
  const largest: Partial<Record<DofUnit, WorstChannel>> = {};
  for (const { index, changed: isChanged, result } of results) {
    keysBefore += result.keysBefore;
    keysAfter += result.keysAfter;
    if (isChanged) changed++;
    if (result.keysBefore === 0) continue;
    const unit = unitOf(index);
    const worst = largest[unit];
    if (worst && worst.largestError >= result.largestError) continue;
    largest[unit] = { channel: index, largestError: result.largestError, atSeconds: result.atSeconds };
  }
  return { changed, keysBefore, keysAfter, largest };
}
