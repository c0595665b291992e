/**
 * Which instance of a character is edited: the last one picked in the viewport. Lists, arrow keys and edits name
 * joints, which all instances share, and don't change it; another character starts with its first.
 */
import type { Character } from '../model/document.ts';
import type { Selection } from '../model/session.ts';

export class PickedCopy {
  private characterId: string | undefined;
  private placement = 0;

  /** Call after each selection. */
  follow({ characterId, placement }: Selection): void {
    if (characterId !== this.characterId) this.placement = 0;
    this.characterId = characterId;
    if (placement !== undefined) this.placement = placement;
  }

  /** Index of the placement; 0 if none was picked, or it no longer exists. */
  of({ id, placements }: Pick<Character, 'id' | 'placements'>): number {
    return id === this.characterId && this.placement < placements.length ? this.placement : 0;
  }
}
