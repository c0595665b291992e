/**
 * Walking in a circle about the origin: the motion loops, and a planted foot doesn't move in the world.
 *
 *     world = Ry(2π·t / duration) · path        path space: the centre of the circle at the origin, the walker at
 *                                               x = −radius, facing +z (so that it walks counterclockwise)
 *
 * In path space all motion repeats with every stride, so legs are keyed for one stride and cycled; only the root's
 * translation is keyed for the whole circle. Rejected: walking straight, which in a loop either leaves the view or
 * jumps back.
 */
import type { Vec3 } from '../../math/vec3.ts';
import { apply, rotationY } from '../shape/vectors.ts';

export interface Circle {
  readonly radius: number;
  /** Whole strides (two steps each) per circle. */
  readonly strides: number;
  readonly strideSeconds: number;
}

export const roundSeconds = (circle: Circle): number => circle.strides * circle.strideSeconds;

/** Heading in radians about y. */
export const circleHeading = (circle: Circle, seconds: number): number =>
  (2 * Math.PI * seconds) / roundSeconds(circle);

/** World position of a point in path space at a time. */
export function toWorld(circle: Circle, seconds: number, path: Vec3): Vec3 {
  return apply(rotationY(circleHeading(circle, seconds)), path);
}

/** A point fixed in the world, in path space so many strides after it was at `path`. */
export function carriedBack(circle: Circle, strides: number, path: Vec3): Vec3 {
  return apply(rotationY((-2 * Math.PI * strides) / circle.strides), path);
}
