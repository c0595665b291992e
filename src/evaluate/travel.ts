/** How far a character has moved over the ground, for display "in place". */
import { type Character, shownTake } from '../model/document.ts';
import type { Space } from '../model/space.ts';
import type { CompiledSkeleton } from './kinematics.ts';
import { carrierIn, retargetCarrier } from './space/carrier.ts';
import { upAxis } from './space/space.ts';

/** Index of the joint that moves the character in its shown take; cached per take and skeleton. */
export function carrierOf(character: Character): number {
  const { skeleton, driver } = character;
  const take = shownTake(character);
  if (driver && skeleton) return retargetCarrier(driver, skeleton);
  return skeleton && take ? carrierIn(skeleton, take) : 0;
}

/**
 * Writes how far the character has moved over the ground, x y z in its own space; 0 along its up axis.
 * @param carrier from `carrierOf`; its position, or for the root what its DOFs add to its offset
 * @param world its joints' matrices, 16 each
 */
export function groundTravel(
  { travel }: CompiledSkeleton,
  space: Space | undefined,
  carrier: number,
  dofs: Float64Array,
  world: Float64Array,
  out: Float64Array,
): void {
  const up = upAxis(space);
  for (let k = 0; k < 3; k++) {
    if (k === up) out[k] = 0;
    else if (carrier > 0) out[k] = world[16 * carrier + 12 + k];
    else out[k] = travel[k] < 0 ? 0 : dofs[travel[k]];
  }
}
