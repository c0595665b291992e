/** What else the space of a figure could be, where its file doesn't state one, or states what can hardly be. */
import type { ChannelClip } from '../model/clip.ts';
import type { Skeleton } from '../model/skeleton.ts';
import type { Space } from '../model/space.ts';
import { metresPerUnit } from './metres.ts';
import { liftOntoGround } from './space.ts';
import { COMMON_UNITS, figureHeight, metresForPerson, unitsByHeight } from './space-guess.ts';

export interface SpaceChoices {
  /** Of the figure, in its space; metres. */
  readonly height: number;
  /** The most likely first. */
  readonly others: readonly Space[];
}

/** Metres that a stated unit may leave a figure at: people, and anything else, such as an insect or a ship. */
const CREDIBLE = { person: [0.4, 4], other: [0.01, 30] } as const;

/** Relative difference of heights that look the same. */
const SAME_HEIGHT = 0.1;

/** Undefined where there is nothing to choose: nothing to measure, a credible statement, or a space that the user set. */
export function spaceChoices(
  skeleton: Skeleton,
  clip: ChannelClip | undefined,
  space: Space,
): SpaceChoices | undefined {
  const { known, up } = space;
  const { height: own, isPerson } = figureHeight(skeleton, clip, up);
  const height = own * metresPerUnit(space);
  if (known === undefined || !(height > 0 && Number.isFinite(height))) return undefined;
  // Programs that state units write the common ones.
  const [unit] = unitsByHeight(own).flatMap((one) =>
    one.unit === space.unit || (known === 'stated' && !COMMON_UNITS.has(one.unit)) ? [] : [one.unit],
  );
  const inUnit: Space = { up, unit, lift: 0 };
  const asPerson: Space = { up, unit: 'own', metres: metresForPerson(skeleton, clip, up), lift: 0 };
  if (known === 'stated') {
    const [least, most] = CREDIBLE[isPerson ? 'person' : 'other'];
    // The ground is the file's.
    return height < least || height > most ? { height, others: [inUnit, asPerson] } : undefined;
  }
  const { known: _, ...plain } = space;
  const turned: Space = { ...plain, up: up === 'z' ? 'y' : 'z' };
  const isPersonHigh = Math.abs(metresPerUnit(asPerson) / metresPerUnit(space) - 1) < SAME_HEIGHT;
  const others = [turned, inUnit, ...(isPersonHigh ? [] : [asPerson])];
  return { height, others: others.map((one) => ({ ...one, lift: liftOntoGround(skeleton, clip, one) })) };
}
