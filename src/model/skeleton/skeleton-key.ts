/** Tells whether skeletons are the same: of one person, as takes of one session are. */
import { perSkeleton } from './per-skeleton.ts';

/** Digits of lengths that count. */
const DIGITS = 4;

/** Equal for skeletons with the same joints and bones; where the root is doesn't count. Cached. */
export const skeletonKey = perSkeleton(({ joints }): string =>
  joints
    .map(
      ({ name, parent, offset }) => `${parent} ${name} ${parent < 0 ? '' : offset.map((v) => v.toPrecision(DIGITS))}`,
    )
    .join('\n'),
);
