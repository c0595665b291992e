/** The selected joints, for menus, tools and panels. */
import { type Character, findCharacter } from '../../../model/document.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import { jointsIn, partOf, partsOf } from '../../../model/skeleton/selected-joints.ts';
import type { Skeleton } from '../../../model/skeleton/skeleton.ts';
import { plural } from '../../widgets/numbers/number-text.ts';
import type { Uses } from '../workbench.ts';

/** A joint that exists. */
export interface ResolvedJoint {
  readonly character: Character;
  readonly skeleton: Skeleton;
  /** Index. */
  readonly joint: number;
}

/** The active one. */
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

/** Selected joints that exist. */
export interface ResolvedJoints {
  readonly character: Character;
  readonly skeleton: Skeleton;
  /** Indices in the order of selection, the active one last; at least one. */
  readonly joints: readonly number[];
}

/** Those of the active character. */
export function selectedJoints(wb: Uses<'store'>): ResolvedJoints | undefined {
  const active = selectedJoint(wb);
  if (!active) return undefined;
  const { character, skeleton } = active;
  return { character, skeleton, joints: jointsIn(wb.store.selection).filter((j) => skeleton.joints[j]) };
}

/** The indices of those of that character; its active one last. */
export function selectedJointsOf(wb: Uses<'store'>, characterId: string): readonly number[] {
  const part = partOf(wb.store.selection, characterId);
  const active = part && resolvedJoint(wb, characterId, part.joint);
  return active ? jointsIn(part).filter((j) => active.skeleton.joints[j]) : [];
}

/** `leg_l`, or `3 joints`. */
export function jointsText(skeleton: Skeleton | undefined, joints: readonly number[]): string {
  return joints.length === 1 ? jointName(skeleton, joints[0]) : plural(joints.length, 'joint');
}

/** `leg_l`, `3 joints`, `3 joints of 2 characters`, or `selected joint` if none is. */
export function selectedJointsText(wb: Uses<'store'>): string {
  const selected = selectedJoints(wb);
  const each = partsOf(wb.store.selection).map(jointsIn);
  const { length } = each.filter((joints) => joints.length > 0);
  if (length > 1) return `${plural(each.flat().length, 'joint')} of ${plural(length, 'character')}`;
  return selected ? jointsText(selected.skeleton, selected.joints) : 'selected joint';
}
