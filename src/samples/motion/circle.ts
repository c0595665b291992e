/**
 * Walking in a circle about the origin: the loop closes on itself, and a planted foot stays where it is in the world.
 *
 *     world = Ry(2π·t / duration) · path        path space: the centre of the circle at the origin, the walker at
 *                                               x = −radius, facing +z (so that it turns left, round the centre)
 *
 * In path space all motion repeats with every stride, so legs are keyed for one stride and cycled; only the root's
 * translation is keyed all the way round. Walking straight on was the alternative: played in a loop it either leaves
 * the picture or jumps back.
 */
import type { Vec3 } from '../../math/vec3.ts';
import { apply, rotationY } from '../shape/vectors.ts';

export interface Circle {
  readonly radius: number;
  /** Whole strides (two steps each) in one round. */
  readonly strides: number;
  readonly strideSeconds: number;
}

export const roundSeconds = (circle: Circle): number => circle.strides * circle.strideSeconds;

/** Heading in radians about y. */
export const circleHeading = (circle: Circle, seconds: number): number =>
  (2 * Math.PI * seconds) / roundSeconds(circle);

/** Where a point of path space is in the world at a time. */
export function toWorld(circle: Circle, seconds: number, path: Vec3): Vec3 {
  return apply(rotationY(circleHeading(circle, seconds)), path);
}

/** A point that stays in the world, seen from path space so many strides after it lay at `path`. */
export function carriedBack(circle: Circle, strides: number, path: Vec3): Vec3 {
  return apply(rotationY((-2 * Math.PI * strides) / circle.strides), path);
}
