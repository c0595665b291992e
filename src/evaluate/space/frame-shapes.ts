/** Positions and extents of a character in frames of its take, in its own space; for guesses about the space. */

import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import type { Take } from '../../model/takes/take.ts';
import { forFrames } from '../bare-character.ts';
import { compileSkeleton, worldMatrices } from '../kinematics.ts';

/** A character in one frame: its bounding box with End Sites, and its joints, x y z each. */
export interface FrameShape {
  readonly min: readonly number[];
  readonly max: readonly number[];
  readonly points: Float64Array;
}

/** Frames examined, evenly over the take. */
const MAX_FRAMES = 64;

/** One, of the file pose, without a take. */
export function frameShapes(skeleton: Skeleton, take: Take | undefined): FrameShape[] {
  const compiled = compileSkeleton(skeleton);
  const world = new Float64Array(16 * compiled.jointCount);
  const shapes: FrameShape[] = [];
  forFrames(skeleton, take, MAX_FRAMES, (dofs) => {
    worldMatrices(compiled, dofs, world);
    shapes.push(shapeOf(skeleton, world));
  });
  return shapes;
}

function shapeOf({ joints }: Skeleton, world: Float64Array): FrameShape {
  const points = new Float64Array(3 * joints.length);
  const min = [Infinity, Infinity, Infinity];
  const max = [-Infinity, -Infinity, -Infinity];
  for (let k = 0; k < 3; k++) {
    let least = Infinity;
    let most = -Infinity;
    for (let j = 0; j < joints.length; j++) {
      const o = 16 * j + k;
      const at = world[o + 12];
      points[3 * j + k] = at;
      least = Math.min(least, at);
      most = Math.max(most, at);
      const { endSites } = joints[j];
      if (!endSites) continue;
      for (const [x, y, z] of endSites) {
        const end = world[o] * x + world[o + 4] * y + world[o + 8] * z + at;
        least = Math.min(least, end);
        most = Math.max(most, end);
      }
    }
    min[k] = least;
    max[k] = most;
  }
  return { min, max, points };
}

/** A percentile of the finite numbers; NaN if there are none. */
export function percentile(values: ArrayLike<number>, part: number): number {
  const finite = new Float64Array(values.length);
  let count = 0;
  for (let i = 0; i < values.length; i++) if (Number.isFinite(values[i])) finite[count++] = values[i];
  // Typed arrays are sorted as numbers, without calls.
  const sorted = finite.subarray(0, count).sort();
  return sorted[Math.round(part * (sorted.length - 1))] ?? Number.NaN;
}
