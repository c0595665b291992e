/**
 * What another character's take has the say over while it moves this one: `retargetPose` writes these DOFs, the pose has
 * the other joints, and the character's own take the morphs.
 */
import type { Character, Driver } from '../../model/document.ts';
import { perPair } from '../../model/per-object.ts';
import type { Skeleton } from '../../model/skeleton.ts';
import { compileSkeleton } from '../kinematics.ts';

const dofsMoved = perPair(({ pairs }: Driver, skeleton: Skeleton): ReadonlySet<number> => {
  const { firstDof, travel } = compileSkeleton(skeleton);
  const dofs = new Set(travel);
  for (const { target } of pairs) {
    for (let d = firstDof[target]; d < firstDof[target + 1]; d++) dofs.add(d);
  }
  return dofs;
});

/**
 * Which of a character's joint DOFs another's take moves: those of joints that follow one, and those that carry the
 * character. Undefined where nothing else moves the character. Made once for a driver.
 */
export function movedDofs({ driver, skeleton }: Character): ReadonlySet<number> | undefined {
  return driver && skeleton && dofsMoved(driver, skeleton);
}

/**
 * How many channels of its own take, from the first on, have no say: those of all joints, while another's take moves
 * them; none otherwise. Keys in them would be keys that nobody sees.
 */
export function silentChannels({ driver, skeleton }: Character): number {
  return driver && skeleton ? compileSkeleton(skeleton).firstDof[skeleton.joints.length] : 0;
}
