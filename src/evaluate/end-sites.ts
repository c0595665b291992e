/** Where a posed skeleton's bones end that no joint ends: BVH's End Sites. */
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
    endSites.map(([x, y, z]) => {
      const o = 16 * joint;
      const along = (k: number) => world[o + k] * x + world[o + 4 + k] * y + world[o + 8 + k] * z + world[o + 12 + k];
      return { joint, position: [along(0), along(1), along(2)] as const };
    }),
  );
}
