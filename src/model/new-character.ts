/** Creating a character. */
import { type Character, DEFAULT_PLACEMENT } from './document.ts';
import { NO_MARKS } from './part.ts';
import { filePose } from './skeleton/dofs.ts';

/**
 * A character without content, in the scene's origin, with enforced limits.
 * @param id unique in the document
 */
export function newCharacter(id: string, name: string): Character {
  return {
    id,
    name,
    skins: [],
    shownSkin: 0,
    morphs: [],
    textures: [],
    takes: [],
    shownTake: -1,
    pose: filePose(undefined, 0),
    clampsToLimits: true,
    placements: [DEFAULT_PLACEMENT],
    timeOffsetSeconds: 0,
    sources: [],
    parts: NO_MARKS,
  };
}
