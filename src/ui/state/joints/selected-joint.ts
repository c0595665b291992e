/** The selected joints, for menus, tools and panels. */
import { cutName } from '../../../edit/cut-name.ts';
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

/**
 * Those of the active character, for what is for it alone: `leg_l`, `3 joints`, `leg_l of Wasp` if joints of others are
 * selected, too, or `selected joint` if none is.
 */
export function selectedJointsText(wb: Uses<'store'>): string {
  const selected = selectedJoints(wb);
  if (!selected) return 'selected joint';
  const { character, skeleton, joints } = selected;
  const text = jointsText(skeleton, joints);
  return jointsOfParts(wb).length > 1 ? `${text} of ${cutName(character.name)}` : text;
}

/** Those of all characters: `leg_l`, `3 joints`, `3 joints of 2 characters`, or `selected joint` if none is. */
export function allJointsText(wb: Uses<'store'>): string {
  const each = jointsOfParts(wb);
  const { length } = each;
  return length > 1
    ? `${plural(each.flat().length, 'joint')} of ${plural(length, 'character')}`
    : selectedJointsText(wb);
}

function jointsOfParts({ store }: Uses<'store'>): readonly (readonly number[])[] {
  return partsOf(store.selection)
    .map(jointsIn)
    .filter((joints) => joints.length > 0);
}
