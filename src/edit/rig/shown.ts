/** A character's displayed pose at a time: what rigging measures and keeps in place. */
import { type CompiledSkeleton, compileSkeleton, worldMatrices } from '../../evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../evaluate/pose.ts';
import type { Character } from '../../model/document.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { CommandError } from '../command-error.ts';

/** A displayed pose with its matrices. */
export interface ShownPose {
  readonly compiled: CompiledSkeleton;
  /** All DOFs of the character, with limits and links applied. */
  readonly dofs: Float64Array;
  /** 16 per joint, in the character's space. */
  readonly world: Float64Array;
}

/** Throws a `CommandError` for a character without a skeleton. */
export function shownAt(character: Character, timeSeconds: number): ShownPose {
  const compiled = compileSkeleton(requireSkeleton(character));
  const dofs = new Float64Array(dofCountOf(character));
  poseAt(character, timeSeconds, dofs);
  const world = new Float64Array(16 * compiled.jointCount);
  worldMatrices(compiled, dofs, world);
  return { compiled, dofs, world };
}

/**
 * The skeleton of a character.
 * @throws CommandError if it has none
 */
export function requireSkeleton({ name, skeleton }: Character): Skeleton {
  if (!skeleton) throw new CommandError(`${name} has no skeleton.`);
  return skeleton;
}

/** Extent of the joints: the largest side of their bounding box; a default for a character of one joint. */
export function skeletonSize(world: Float64Array): number {
  let size = 0;
  for (let k = 12; k < 15; k++) {
    let low = Infinity;
    let high = -Infinity;
    for (let o = k; o < world.length; o += 16) {
      low = Math.min(low, world[o]);
      high = Math.max(high, world[o]);
    }
    size = Math.max(size, high - low);
  }
  return size > 0 && size < Infinity ? size : 1;
}
