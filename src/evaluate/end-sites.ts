/** Where a posed skeleton's bones end: BVH's End Sites, and the tips of bones along +y. */
import type { Vec3 } from '../math/vec3.ts';
import type { Skeleton } from '../model/skeleton.ts';

export interface EndSitePosition {
  /** Index of the joint that it hangs on. */
  readonly joint: number;
  /** In the space of the world matrices. */
  readonly position: readonly [number, number, number];
}

/**
 * In the order of joints, and of the file within each.
 * @param world 16 a joint, column-major (`worldMatrices`)
 */
export function endSitePositions({ joints }: Skeleton, world: Float64Array): EndSitePosition[] {
  return joints.flatMap(({ endSites = [] }, joint) =>
    endSites.map((end) => ({ joint, position: endSitePosition(end, world, joint) })),
  );
}

/**
 * Of one End Site, which is at `end` in its joint's space.
 * @param world as above
 */
export function endSitePosition([x, y, z]: Vec3, world: Float64Array, joint: number): Vec3 {
  const o = 16 * joint;
  const along = (k: number) => world[o + k] * x + world[o + 4 + k] * y + world[o + 8 + k] * z + world[o + 12 + k];
  return [along(0), along(1), along(2)];
}

/**
 * The far end of a joint's own bone, which runs along its +y.
 * @param world as above
 */
export function tipPosition(length: number, world: Float64Array, joint: number): readonly [number, number, number] {
  const along = (k: number) => world[16 * joint + 4 + k] * length + world[16 * joint + 12 + k];
  return [along(0), along(1), along(2)];
}
