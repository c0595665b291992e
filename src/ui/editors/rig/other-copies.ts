/**
 * Joints of a character's other instances: pressing one moves the handles there. Only visible ones; on an instance
 * whose skin hides them, the press goes to the camera.
 */
import { transformPoint } from '../../../math/vec3.ts';
import type { Character } from '../../../model/document.ts';
import type { Uses } from '../../state/workbench.ts';
import type { CanvasPointer } from '../viewport/canvas-tools.ts';
import { NEAR_JOINT } from './hits.ts';

export interface JointOfCopy {
  readonly joint: number;
  readonly placement: number;
}

export function jointOfOtherCopy(
  { viewport }: Uses<'viewport'>,
  character: Character,
  at: CanvasPointer,
): JointOfCopy | undefined {
  if (character.placements.length < 2 || character.isHidden) return undefined;
  const hit = viewport.pointing.pick(at.clientX, at.clientY);
  if (!hit || hit.vertex !== undefined || hit.characterId !== character.id) return undefined;
  const { placement } = hit;
  const toScene = viewport.placementOf(character.id, placement);
  const world = viewport.character(character.id)?.worlds;
  if (placement === viewport.pickedCopy(character) || toScene?.length !== 16 || !world) return undefined;
  // A bone or box may have been hit, far from its joint's pivot.
  let joint = -1;
  let least = at.pointerType === 'touch' ? 2 * NEAR_JOINT : NEAR_JOINT;
  for (let j = 0; 16 * j < world.length; j++) {
    const seen = viewport.eye.toScreen(
      transformPoint(toScene, [world[16 * j + 12], world[16 * j + 13], world[16 * j + 14]]),
    );
    const distance = Math.hypot(seen.x - at.clientX, seen.y - at.clientY);
    // Skips NaN, behind the camera.
    if (!(distance <= least)) continue;
    least = distance;
    joint = j;
  }
  return joint < 0 ? undefined : { joint, placement };
}
