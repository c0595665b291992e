/**
 * DOFs that a retargeted take overrides: `retargetPose` writes these DOFs; the other joints come from the pose, and
 * morphs from the character's own take.
 */
import type { Character, Driver } from '../../model/document.ts';
import { perPair } from '../../model/per-object.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { compileSkeleton } from '../kinematics.ts';
import { retargetCarrier } from '../space/carrier.ts';

const dofsMoved = perPair((driver: Driver, skeleton: Skeleton): ReadonlySet<number> => {
  const { firstDof, travel, slides } = compileSkeleton(skeleton);
  const carrier = retargetCarrier(driver, skeleton);
  const dofs = new Set(carrier > 0 ? slides.subarray(3 * carrier, 3 * carrier + 3) : travel);
  for (const { target } of driver.pairs) {
    for (let d = firstDof[target]; d < firstDof[target + 1]; d++) dofs.add(d);
  }
  return dofs;
});

/**
 * The joint DOFs of a character that a retargeted take drives: those of paired joints, and those that move the
 * character. Undefined if nothing is retargeted to it. Cached per driver.
 */
export function movedDofs({ driver, skeleton }: Character): ReadonlySet<number> | undefined {
  return driver && skeleton && dofsMoved(driver, skeleton);
}

/**
 * Number of leading channels of its own take without effect: those of all joints during retargeting, otherwise none.
 * Keys in them would be invisible.
 */
export function silentChannels({ driver, skeleton }: Character): number {
  return driver && skeleton ? compileSkeleton(skeleton).firstDof[skeleton.joints.length] : 0;
}
