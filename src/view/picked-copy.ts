/**
 * Which copy of a character is worked on: the one that was picked last in the picture. Lists, arrow keys and edits name
 * joints, which all copies share, and leave it as it is; another character begins with its first.
 */
import type { Character } from '../model/document.ts';
import type { Selection } from '../model/session.ts';

export class PickedCopy {
  private characterId: string | undefined;
  private placement = 0;

  /** After each selection. */
  follow({ characterId, placement }: Selection): void {
    if (characterId !== this.characterId) this.placement = 0;
    this.characterId = characterId;
    if (placement !== undefined) this.placement = placement;
  }

  /** Index of its placement; the first where no other was picked, or that is gone. */
  of({ id, placements }: Pick<Character, 'id' | 'placements'>): number {
    return id === this.characterId && this.placement < placements.length ? this.placement : 0;
  }
}
