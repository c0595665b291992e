/** The selected joint, for menus, tools and panels. */
import { type Character, findCharacter } from '../../model/document.ts';
import type { Skeleton } from '../../model/skeleton.ts';
import type { Uses } from './workbench.ts';

/** A selected joint that exists. */
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

/** Its index, if it belongs to that character. */
export function selectedJointOf(wb: Uses<'store'>, characterId: string): number | undefined {
  const selected = selectedJoint(wb);
  return selected?.character.id === characterId ? selected.joint : undefined;
}
