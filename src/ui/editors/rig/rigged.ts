/** The character being rigged, at the picked instance, with the matrices to convert scene positions to its space. */
import { parentToScene } from '../../../edit/rig/dragged-places.ts';
import { transformPoint, type Vec3, ZERO } from '../../../math/vec3.ts';
import { type Character, findCharacter } from '../../../model/document.ts';
import type { Skeleton } from '../../../model/skeleton/skeleton.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import { HandEdit } from '../../state/actions/hand-edit.ts';
import type { Uses } from '../../state/workbench.ts';

export interface Rigged {
  readonly character: Character;
  readonly skeleton: Skeleton;
  /** 16 numbers per joint, in the character's space, as shown now; a copy. */
  readonly world: Float64Array;
  /** From the character's space to the scene; a copy. */
  readonly placement: Float64Array;
}

/** Undefined if no skeleton is visible. */
export function riggedNow(wb: Uses<'store' | 'viewport'>): Rigged | undefined {
  const character = currentCharacter(wb);
  if (!character?.skeleton || character.isHidden) return undefined;
  const world = wb.viewport.character(character.id)?.worldMatrices();
  const placement = wb.viewport.placementOf(character.id, wb.viewport.pickedCopy(character))?.slice();
  if (!placement || !world || world.length < 16 * character.skeleton.joints.length) return undefined;
  return { character, skeleton: character.skeleton, world, placement };
}

/** A drag of a joint, which it knows by its index: ends if anything else changes the document. */
export function editOfRig({ store, messages }: Uses<'store' | 'messages'>, { id, skeleton }: Character): HandEdit {
  return new HandEdit(store, messages, () => findCharacter(store.document, id)?.skeleton === skeleton);
}

/** Scene position of a joint's pivot. */
export function scenePivot({ world, placement }: Rigged, joint: number): Vec3 {
  return transformPoint(parentToScene(placement, world, joint), ZERO);
}

/** From the space of a joint's offset to the scene. */
export function spaceOfOffset({ world, placement, skeleton }: Rigged, joint: number): Float64Array {
  return parentToScene(placement, world, skeleton.joints[joint].parent);
}

/** Mean scale of a matrix. */
export function meanScale(m: Float64Array): number {
  const volume = Math.abs(
    m[0] * (m[5] * m[10] - m[6] * m[9]) - m[4] * (m[1] * m[10] - m[2] * m[9]) + m[8] * (m[1] * m[6] - m[2] * m[5]),
  );
  return volume > 0 ? Math.cbrt(volume) : 1;
}
