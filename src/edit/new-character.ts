/** Creating a character, and giving one another skeleton. */
import { type Character, DEFAULT_PLACEMENT } from '../model/document.ts';
import { NO_MARKS } from '../model/part.ts';
import { filePose, rootDofCount } from '../model/skeleton/dofs.ts';
import type { Skeleton } from '../model/skeleton/skeleton.ts';
import { carriedOver } from './carried-over.ts';
import { withoutUnkeyed } from './unkeyed.ts';

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

/**
 * Takes the new skeleton's file pose; root translation and morph weights are kept, and what refers to joints is carried
 * over.
 */
export function withSkeleton(character: Character, skeleton: Skeleton): Character {
  const weights = character.morphs.length ? character.pose.slice(-character.morphs.length) : [];
  const kept = rootDofCount(skeleton) === rootDofCount(character.skeleton) ? rootDofCount(skeleton) : 0;
  const pose = [...character.pose.slice(0, kept), ...filePose(skeleton, 0).slice(kept), ...weights];
  return carriedOver(character, { ...withoutUnkeyed(character), skeleton, pose });
}
