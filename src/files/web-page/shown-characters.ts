/** How characters are shown, as far as their files don't say: kept in a page that is saved with them. */
import type { Character } from '../../model/document.ts';
import { type Positions, positionsTaken } from '../../model/skeleton/position-channels.ts';

/** Whatever is no content of files. */
type Kept = Pick<
  Character,
  | 'name'
  | 'shownTake'
  | 'shownSkin'
  | 'pose'
  | 'clampsToLimits'
  | 'placements'
  | 'timeOffsetSeconds'
  | 'space'
  | 'isHidden'
>;

/** How a character is shown. */
export interface Shown extends Kept {
  /** Of its files. */
  readonly folder: string;
  /** What position channels of a `.bvh` mean; absent if there are none. */
  readonly positions?: Positions;
}

/** How a character is shown whose files are in a folder. */
export function shownOf(character: Character, folder: string): Shown {
  const { name, shownTake, shownSkin, pose, clampsToLimits, placements, timeOffsetSeconds, skeleton } = character;
  const { space, isHidden } = character;
  const positions = skeleton && positionsTaken(skeleton);
  return {
    ...{ folder, name, shownTake, shownSkin, pose, clampsToLimits, placements, timeOffsetSeconds },
    ...(space && { space }),
    ...(isHidden && { isHidden }),
    ...(positions && { positions }),
  };
}
