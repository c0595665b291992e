/** The selected joint, for menus, tools and panels. */
import { type Character, findCharacter } from '../../model/document.ts';
import type { Skeleton } from '../../model/skeleton.ts';
import type { Uses } from './workbench.ts';

/** A joint that exists. */
export interface ResolvedJoint {
  readonly character: Character;
  readonly skeleton: Skeleton;
  /** Index. */
  readonly joint: number;
}

export function selectedJoint(wb: Uses<'store'>): ResolvedJoint | undefined {
  const { characterId, joint } = wb.store.selection;
  return resolvedJoint(wb, characterId, joint);
}

/** A joint by ids; undefined if there is none (any more). */
export function resolvedJoint(
  { store }: Uses<'store'>,
  characterId: string | undefined,
  joint: number | undefined,
): ResolvedJoint | undefined {
  const character = findCharacter(store.document, characterId);
  const skeleton = character?.skeleton;
  if (!character || !skeleton || joint === undefined || !skeleton.joints[joint]) return undefined;
  return { character, skeleton, joint };
}

/** Its index, if it belongs to that character. */
export function selectedJointOf(wb: Uses<'store'>, characterId: string): number | undefined {
  const selected = selectedJoint(wb);
  return selected?.character.id === characterId ? selected.joint : undefined;
}
