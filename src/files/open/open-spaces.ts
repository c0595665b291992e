/** The spaces of characters that are opened. */
import type { Character } from '../../model/document.ts';
import type { ParsedFile, WholeCharacter } from '../../model/files.ts';
import { skeletonKey } from '../../model/skeleton/skeleton-key.ts';
import type { FileSpace, Space } from '../../model/space.ts';
import { charactersIn } from './contents.ts';

/**
 * Motion capture does not say how its space is oriented, scaled and grounded. Takes of one skeleton share what is known
 * of one that is open already, or else the guess for the one that stands most. What a file states counts, unless the
 * user has set another space for that skeleton.
 */
export class OpenSpaces {
  /** Spaces of characters from before, by skeleton. */
  private readonly known = new Map<string, Space>();
  /** The surest spaces of the characters in the files whose space was guessed, by skeleton. */
  private readonly surest = new Map<string, FileSpace>();

  /** @param characters from before */
  constructor(characters: readonly Character[], files: readonly ParsedFile[]) {
    for (const { space, skeleton } of characters) {
      const key = space && skeleton && skeletonKey(skeleton);
      if (space && key !== undefined && !this.known.has(key)) this.known.set(key, space);
    }
    for (const { skeleton, space } of files.flatMap(charactersIn)) {
      if (space?.space.known !== 'guessed') continue;
      const key = skeletonKey(skeleton);
      if (!(space.standing <= (this.surest.get(key)?.standing ?? -1))) this.surest.set(key, space);
    }
  }

  /** Space of a character in the files; undefined if it says none and none is guessed. */
  of({ skeleton, space }: WholeCharacter): Space | undefined {
    if (!space) return undefined;
    const key = skeletonKey(skeleton);
    const open = this.known.get(key);
    if (space.space.known === 'stated') return open && open.known === undefined ? open : space.space;
    return open ?? (this.surest.get(key) ?? space).space;
  }
}
