/** Ends of a posed skeleton's bones: BVH's End Sites, and the tips of bones along +y. */
import { transformPoint, type Vec3 } from '../math/vec3.ts';
import type { Skeleton } from '../model/skeleton/skeleton.ts';

/** Where the end of a bone is in a pose. */
export interface EndSitePosition {
  /** Index of its joint. */
  readonly joint: number;
  /** In the space of the world matrices. */
  readonly position: readonly [number, number, number];
}

/**
 * In joint order, and in file order within each joint.
 * @param world 16 per joint, column-major (`worldMatrices`)
 */
export function endSitePositions({ joints }: Skeleton, world: Float64Array): EndSitePosition[] {
  return joints.flatMap(({ endSites = [] }, joint) =>
    endSites.map((end) => ({ joint, position: endSitePosition(end, world, joint) })),
  );
}

/**
 * The position of an End Site that is at `end` in its joint's space.
 * @param world as above
 */
export function endSitePosition(end: Vec3, world: Float64Array, joint: number): Vec3 {
  return transformPoint(world, end, 16 * joint);
}

/**
 * The far end of a joint's own bone, along its +y.
 * @param world as above
 */
export function tipPosition(length: number, world: Float64Array, joint: number): readonly [number, number, number] {
  const along = (k: number) => world[16 * joint + 4 + k] * length + world[16 * joint + 12 + k];
  return [along(0), along(1), along(2)];
}
