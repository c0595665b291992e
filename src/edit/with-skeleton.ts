/** Giving a character another skeleton. */
import type { Character } from '../model/document.ts';
import { filePose, rootDofCount } from '../model/skeleton/dofs.ts';
import type { Skeleton } from '../model/skeleton/skeleton.ts';
import { carriedOver } from './carried-over.ts';
import { withoutUnkeyed } from './unkeyed.ts';

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
