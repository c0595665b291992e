/** The joint that is selected: what menus, tools and panels are about alike. */
import { type Character, findCharacter } from '../../model/document.ts';
import type { Skeleton } from '../../model/skeleton.ts';
import type { Uses } from './workbench.ts';

/** A joint that is selected, of a character that has it. */
export interface ResolvedJoint {
  readonly character: Character;
  readonly skeleton: Skeleton;
  /** Index. */
  readonly joint: number;
}

export function selectedJoint({ store }: Uses<'store'>): ResolvedJoint | undefined {
  const { document, selection } = store;
  const character = findCharacter(document, selection.characterId);
  const skeleton = character?.skeleton;
  const { joint } = selection;
  if (!character || !skeleton || joint === undefined || !skeleton.joints[joint]) return undefined;
  return { character, skeleton, joint };
}

/** Its index, where it is one of that character's. */
export function selectedJointOf(wb: Uses<'store'>, characterId: string): number | undefined {
  const selected = selectedJoint(wb);
  return selected?.character.id === characterId ? selected.joint : undefined;
}
