/** Characters that are points of a capture, without bones. */
import type { Character } from './document.ts';
import { arePoints } from './skeleton/joint-types.ts';

/** Why a character can't be written in formats of joints and bones, as a sentence; undefined if it has some. */
export function bonesObstacle({ skeleton, name }: Pick<Character, 'skeleton' | 'name'>): string | undefined {
  if (!arePoints(skeleton)) return undefined;
  return `${name} is points without bones, which this needs: no tree that Marrow knows has its labels. Points are saved as .trc.`;
}
