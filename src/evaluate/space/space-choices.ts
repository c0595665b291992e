/** Other spaces that a character could have, where its file doesn't state one, or states what can hardly be. */

import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import type { Space } from '../../model/space.ts';
import type { Take } from '../../model/takes/take.ts';
import { metresPerUnit } from './metres.ts';
import { liftOntoGround } from './space.ts';
import { COMMON_UNITS, guessedHeight, metresForPerson, unitsByHeight } from './space-guess.ts';

/** The height of a character in its space, and what its space could be instead. */
export interface SpaceChoices {
  /** Height of the character, in its space; metres. */
  readonly height: number;
  /** The most likely first; other units leave it at a credible height only. */
  readonly others: readonly Space[];
}

/** Metres that a unit may leave a character at: people, and anything else, such as an insect or a ship. */
const CREDIBLE = { person: [0.4, 4], other: [0.01, 30] } as const;

/** Relative difference of heights that look the same. */
const SAME_HEIGHT = 0.1;

/** Undefined where there is nothing to choose: nothing to measure, a credible statement, or a space that the user set. */
export function spaceChoices(skeleton: Skeleton, take: Take | undefined, space: Space): SpaceChoices | undefined {
  const { known, up } = space;
  const isStated = known === 'stated';
  const { height: own, isPerson } = guessedHeight(skeleton, take, up, isStated);
  const height = own * metresPerUnit(space);
  if (known === undefined || !(height > 0 && Number.isFinite(height))) return undefined;
  const [least, most] = CREDIBLE[isPerson ? 'person' : 'other'];
  const isCredible = (one: Space) => own * metresPerUnit(one) >= least && own * metresPerUnit(one) <= most;
  if (isStated && isCredible(space)) return undefined;
  const units = unitsByHeight(own).flatMap(({ unit }): Space[] =>
    // Programs that state units write the common ones.
    unit === space.unit || (isStated && !COMMON_UNITS.has(unit)) ? [] : [{ up, unit, lift: 0 }],
  );
  const inUnit = [...units, ...(isStated ? mistaken(space) : [])].find(isCredible);
  const asPerson: Space = { up, unit: 'own', metres: metresForPerson(skeleton, take, up, isStated), lift: 0 };
  const isPersonHigh = (one: Space) => Math.abs(metresPerUnit(asPerson) / metresPerUnit(one) - 1) < SAME_HEIGHT;
  if (isStated) {
    // The ground is the file's.
    if (!inUnit) return { height, others: [asPerson] };
    return { height, others: isPersonHigh(inUnit) ? [inUnit] : [inUnit, asPerson] };
  }
  const { known: _, ...plain } = space;
  const turned: Space = { ...plain, up: up === 'y' ? 'z' : 'y' };
  const others = [turned, ...(inUnit ? [inUnit] : []), ...(isPersonHigh(space) ? [] : [asPerson])];
  return { height, others: others.map((one) => ({ ...one, lift: liftOntoGround(skeleton, take, one) })) };
}

/**
 * Programs that take metres for centimetres, or the other way round, write lengths that are 100 times too large or
 * small.
 */
function mistaken(space: Space): readonly Space[] {
  const metres = metresPerUnit(space);
  return [metres / 100, metres * 100].map((one): Space => ({ up: space.up, unit: 'own', metres: one, lift: 0 }));
}
