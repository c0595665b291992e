/** Positions and extents of a figure in frames of its take, in its own space; for guesses about the space. */
import type { Vec3 } from '../math/vec3.ts';
import type { ChannelClip } from '../model/clip.ts';
import type { Skeleton } from '../model/skeleton.ts';
import { forFrames } from './figure-frames.ts';
import { compileSkeleton, worldMatrices } from './kinematics.ts';

/** A figure in one frame: its bounding box with End Sites, and its joints, x y z each. */
export interface FrameShape {
  readonly min: readonly number[];
  readonly max: readonly number[];
  readonly points: Float64Array;
}

/** Frames examined, evenly over the clip. */
const MAX_FRAMES = 64;
const NO_POINTS: readonly Vec3[] = [];

/** One, of the file pose, without a clip. */
export function frameShapes(skeleton: Skeleton, clip: ChannelClip | undefined): FrameShape[] {
  const compiled = compileSkeleton(skeleton);
  const world = new Float64Array(16 * compiled.jointCount);
  const shapes: FrameShape[] = [];
  forFrames(skeleton, clip, MAX_FRAMES, (dofs) => {
    worldMatrices(compiled, dofs, world);
    shapes.push(shapeOf(skeleton, world));
  });
  return shapes;
}

function shapeOf(skeleton: Skeleton, world: Float64Array): FrameShape {
  const min = [Infinity, Infinity, Infinity];
  const max = [-Infinity, -Infinity, -Infinity];
  const points = new Float64Array(3 * skeleton.joints.length);
  skeleton.joints.forEach(({ endSites }, j) => {
    const o = 16 * j;
    for (let k = 0; k < 3; k++) {
      points[3 * j + k] = world[o + 12 + k];
      min[k] = Math.min(min[k], world[o + 12 + k]);
      max[k] = Math.max(max[k], world[o + 12 + k]);
      for (const [x, y, z] of endSites ?? NO_POINTS) {
        const at = world[o + k] * x + world[o + 4 + k] * y + world[o + 8 + k] * z + world[o + 12 + k];
        min[k] = Math.min(min[k], at);
        max[k] = Math.max(max[k], at);
      }
    }
  });
  return { min, max, points };
}

/** Of the finite numbers; NaN if there are none. */
export function percentile(values: readonly number[], part: number): number {
  // Typed arrays are sorted as numbers, without calls.
  const sorted = Float64Array.from(values.filter(Number.isFinite)).sort();
  return sorted[Math.round(part * (sorted.length - 1))] ?? Number.NaN;
}
