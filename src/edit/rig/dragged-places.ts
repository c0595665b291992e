/**
 * Converts drags in rig mode to values of the skeleton. A point in the scene becomes an offset through
 *
 *     scene ← placement ← character's space ← matrix of the parent ← offset
 *
 * A joint's own DOFs may move its pivot too (a prismatic joint's), so an offset is changed by the pivot's displacement,
 * never recomputed.
 */
import { invertAffine, isSingular, multiplyAffine } from '../../math/mat4.ts';
import { add, dot, subtract, transformVector, type Vec3 } from '../../math/vec3.ts';
import type { Box } from '../../model/skeleton/skeleton.ts';

/** Undefined if the matrix is singular. */
export function inverseOf(m: Float64Array, o = 0): Float64Array | undefined {
  if (isSingular(m, o)) return undefined;
  const inverse = new Float64Array(16);
  invertAffine(m, o, inverse, 0);
  return inverse;
}

/**
 * From a parent's space to the scene. The root's parent is the character's space.
 * @param world 16 per joint, in the character's space
 * @param parent index; -1 above the root
 */
export function parentToScene(placement: Float64Array, world: Float64Array, parent: number): Float64Array {
  if (parent < 0) return placement.slice(0, 16);
  const matrix = new Float64Array(16);
  multiplyAffine(placement, 0, world, 16 * parent, matrix, 0);
  return matrix;
}

/**
 * The offset that moves a pivot from one position in the scene to another; undefined if the parent's matrix is
 * singular.
 * @param parent from the parent's space to the scene
 */
export function offsetMoved(offset: Vec3, parent: Float64Array, from: Vec3, to: Vec3): Vec3 | undefined {
  const inverse = inverseOf(parent);
  return inverse && add(offset, transformVector(inverse, subtract(to, from)));
}

/**
 * Parameter of the point on a line nearest to a ray; undefined if they are nearly parallel.
 * @param direction of the line, of any length: the unit of the result
 */
export function alongLine(
  anchor: Vec3,
  direction: Vec3,
  ray: { readonly origin: Vec3; readonly direction: Vec3 },
): number | undefined {
  // At the nearest points of two lines their difference is perpendicular to both.
  const w = subtract(anchor, ray.origin);
  const a = dot(direction, direction);
  const b = dot(direction, ray.direction);
  const c = dot(ray.direction, ray.direction);
  const d = dot(direction, w);
  const e = dot(ray.direction, w);
  const denominator = a * c - b * b;
  return denominator > 1e-6 * a * c ? (b * e - c * d) / denominator : undefined;
}

/** The nearest multiple of a step. */
export function snapped(value: number, step: number): number {
  return tidy(Math.round(value / step) * step) + 0;
}

/** The nearest point of the grid whose lines are `step` apart. */
export function snappedPoint([x, y, z]: Vec3, step: number): Vec3 {
  return [snapped(x, step), snapped(y, step), snapped(z, step)];
}

/**
 * The nearest point of the grid. Only coordinates that differ from `from` are snapped: in a front view the depth stays.
 *
 * @param step spacing of the grid's lines
 */
export function ontoGrid(point: Vec3, from: Vec3, step: number): Vec3 {
  const at = (k: 0 | 1 | 2) => (Math.abs(point[k] - from[k]) > SAME_PLACE * step ? snapped(point[k], step) : from[k]);
  return [at(0), at(1), at(2)];
}
/** Fraction of a step: the noise of projecting to the screen and back. */
const SAME_PLACE = 1e-3;

/** Removes rounding errors in the last digits: 3 steps of 0.1 are 0.3. */
function tidy(value: number): number {
  return Number(value.toPrecision(12));
}

/** Rounded to the precision of a drag: a tenth of a pixel. */
export function withoutDust(point: Vec3, unitsPerPixel: number): Vec3 {
  return snappedPoint(point, dustOf(unitsPerPixel));
}

function dustOf(unitsPerPixel: number): number {
  return 10 ** Math.floor(Math.log10(Math.max(unitsPerPixel, 1e-12) / 10));
}

/** The lower or the upper side of a joint's box on an axis. */
export type BoxSide = 'min' | 'max';

/**
 * A box with one face moved. A face stops at the opposite one; in files min may exceed max, and such a box's faces move
 * freely.
 * @param by in the box's space, along the axis; 0 changes nothing
 * @param options `both` moves the opposite face the other way; `step`: what the face's position snaps to;
 *   `unitsPerPixel`, in the box's space: changed numbers are rounded to the precision of a drag
 */
export function boxWithFace(
  { min, max }: Box,
  axis: 0 | 1 | 2,
  side: BoxSide,
  by: number,
  {
    both = false,
    step,
    unitsPerPixel,
  }: { readonly both?: boolean; readonly step?: number; readonly unitsPerPixel?: number } = {},
): Box {
  const own = side === 'min' ? min[axis] : max[axis];
  const across = side === 'min' ? max[axis] : min[axis];
  const isCrossed = min[axis] > max[axis];
  const middle = (own + across) / 2;
  const clean = (value: number) => (unitsPerPixel === undefined ? value : snapped(value, dustOf(unitsPerPixel)));
  let face = by === 0 ? own : step === undefined ? clean(own + by) : snapped(own + by, step);
  const stop = both ? middle : across;
  if (!isCrossed) face = side === 'min' ? Math.min(face, stop) : Math.max(face, stop);
  const goesAlong = both && face !== own;
  const other = goesAlong ? (face === stop ? stop : clean(across - (face - own))) : across;
  const put = (corner: Vec3, value: number): Vec3 => {
    const next: [number, number, number] = [...corner];
    next[axis] = value;
    return next;
  };
  return side === 'min' ? { min: put(min, face), max: put(max, other) } : { min: put(min, other), max: put(max, face) };
}

/** The mirrored position across x = 0 of the character's space. */
export function opposite([x, y, z]: Vec3): Vec3 {
  return [-x + 0, y, z];
}
