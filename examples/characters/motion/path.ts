/**
 * Where a gait leads. In path space all motion repeats with every stride, so legs are keyed for one stride and cycled;
 * a planted foot doesn't move in the world:
 *
 *     circle     world = Ry(2π·t / duration) · path     the centre of the circle at the origin, the walker at
 *                                                       x = −radius, facing +z (so that it walks counterclockwise)
 *     straight   world = path + (0, 0, speed · t)       the walker at x = 0, facing +z
 */
import type { Vec3 } from '../../../src/math/vec3.ts';
import { apply, rotationY } from '../shape/vectors.ts';

export interface WalkPath {
  /** Whole strides (two steps each) until the take repeats. */
  readonly strides: number;
  readonly strideSeconds: number;
  /** x of the walker's middle in path space. */
  readonly middle: number;
  /** Whether the root's way over the ground repeats with each stride, but for how far it came. */
  readonly isStraight: boolean;
  /** Radians about y. */
  heading(seconds: number): number;
  /** World position of a point in path space at a time. */
  toWorld(seconds: number, path: Vec3): Vec3;
  /** A point fixed in the world, in path space so many strides after it was at `path`. */
  carriedBack(strides: number, path: Vec3): Vec3;
}

/** Seconds until the take repeats. */
export const pathSeconds = ({ strides, strideSeconds }: WalkPath): number => strides * strideSeconds;

export function circlePath(radius: number, strides: number, strideSeconds: number): WalkPath {
  const heading = (seconds: number) => (2 * Math.PI * seconds) / (strides * strideSeconds);
  return {
    strides,
    strideSeconds,
    middle: -radius,
    isStraight: false,
    heading,
    toWorld: (seconds, path) => apply(rotationY(heading(seconds)), path),
    carriedBack: (after, path) => apply(rotationY(-heading(after * strideSeconds)), path),
  };
}

/** @param metres of all strides together */
export function straightPath(metres: number, strides: number, strideSeconds: number): WalkPath {
  const stride = metres / strides;
  return {
    strides,
    strideSeconds,
    middle: 0,
    isStraight: true,
    heading: () => 0,
    toWorld: (seconds, [x, y, z]) => [x, y, z + (stride * seconds) / strideSeconds],
    carriedBack: (after, [x, y, z]) => [x, y, z - stride * after],
  };
}
