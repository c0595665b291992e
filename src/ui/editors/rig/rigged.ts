/** The character that rig mode is about, in the copy that was picked, with what it takes to turn places in the scene into its numbers. */
import { inverseOf, parentToScene } from '../../../edit/rig/dragged-places.ts';
import { transformPoint, type Vec3, ZERO } from '../../../math/vec3.ts';
import type { Character } from '../../../model/document.ts';
import type { Skeleton } from '../../../model/skeleton.ts';
import { currentCharacter } from '../../state/action.ts';
import type { Uses } from '../../state/workbench.ts';

export interface Rigged {
  readonly character: Character;
  readonly skeleton: Skeleton;
  /** 16 a joint, in the character's space, as shown now; a copy. */
  readonly world: Float64Array;
  /** From the character's space to the scene; a copy. */
  readonly placement: Float64Array;
}

/** Undefined where no skeleton is seen. */
export function riggedNow(wb: Uses<'store' | 'viewport'>): Rigged | undefined {
  const character = currentCharacter(wb);
  if (!character?.skeleton || character.isHidden) return undefined;
  const world = wb.viewport.character(character.id)?.worldMatrices();
  const placement = wb.viewport.placementOf(character.id, wb.viewport.pickedCopy(character))?.slice();
  if (!placement || !world || world.length < 16 * character.skeleton.joints.length) return undefined;
  return { character, skeleton: character.skeleton, world, placement };
}

/** Where a joint's pivot is in the scene. */
export function scenePivot({ world, placement }: Rigged, joint: number): Vec3 {
  return transformPoint(parentToScene(placement, world, joint), ZERO);
}

/** From the space that a joint's offset is in to the scene. */
export function spaceOfOffset({ world, placement, skeleton }: Rigged, joint: number): Float64Array {
  return parentToScene(placement, world, skeleton.joints[joint].parent);
}

/** Of a matrix: what it makes of a length, about. */
export function meanScale(m: Float64Array): number {
  const volume = Math.abs(
    m[0] * (m[5] * m[10] - m[6] * m[9]) - m[4] * (m[1] * m[10] - m[2] * m[9]) + m[8] * (m[1] * m[6] - m[2] * m[5]),
  );
  return volume > 0 ? Math.cbrt(volume) : 1;
}

/** A point of the scene in the space that the children of a joint have their offsets in. */
export function inSpaceOf({ world, placement }: Rigged, joint: number, point: Vec3): Vec3 | undefined {
  const inverse = inverseOf(parentToScene(placement, world, joint));
  return inverse && transformPoint(inverse, point);
}
