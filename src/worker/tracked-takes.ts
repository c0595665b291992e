/**
 * Takes whose channels are yet to be made, between worker and page. A message holds what they are made of: cloning asks
 * for every property, and would make them. What makes them is in `settled-takes.ts`, which the page fetches for them.
 */
import type { FileContent, WholeCharacter } from '../model/files.ts';
import type { Take } from '../model/takes/take.ts';
import { type TrackedTake, trackedOf } from '../model/takes/tracked-take.ts';

/** A take in a message: without channels, if it has tracks. */
export interface PostedTake extends Take, Partial<Pick<TrackedTake, 'tracked' | 'spareKeys'>> {}

/** Whatever has takes. */
export interface HasTakes {
  readonly takes: readonly Take[];
}

/** A character for a message; the same object if it has no such takes. */
export function forMessage<C extends HasTakes>(character: C): C {
  return withTakes(character, (take): PostedTake => {
    const source = trackedOf(take);
    return source ? { ...source, channels: [] } : take;
  });
}

/** Whether a file of a message has a take without its channels: `fromMessage` of `settled-takes.ts` makes it whole. */
export function isIncomplete(file: FileContent): boolean {
  const takes = file.kind === 'character' ? file.characters.flatMap((character) => character.takes) : [];
  return takes.some((take: PostedTake) => take.tracked !== undefined);
}

/** A character with its takes changed; the same object if none is. */
export function withTakes<C extends HasTakes>(character: C, change: (take: Take, index: number) => Take): C {
  const takes = character.takes.map(change);
  return takes.some((take, i) => take !== character.takes[i]) ? { ...character, takes } : character;
}

/** The content of a file with its whole characters changed; the same object if none is. */
export function withCharacters<C extends FileContent>(
  content: C,
  change: (character: WholeCharacter) => WholeCharacter,
): C {
  if (content.kind !== 'character') return content;
  const characters = content.characters.map(change);
  return characters.some((character, i) => character !== content.characters[i]) ? { ...content, characters } : content;
}
