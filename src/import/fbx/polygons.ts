/**
 * Polygons cut into triangles: by ears, so that those with corners turned inwards are right, too. Of a convex one each
 * next corner is an ear, which makes it a fan.
 */
import { length3 } from '../../math/vec3.ts';

/** With more corners a polygon is cut as a fan, since finding ears can take time with the cube of their number. */
const MAX_CORNERS = 400;

/** How many points may be looked at to find ears in all polygons of a file; then they are cut as fans. */
export class Effort {
  left = 2e7;
}

/**
 * Appends three indices of corners per triangle.
 * @param points x y z per point
 * @param corners the points of the polygon in order, at least three
 * @param effort less by what it takes
 */
export function cutPolygon(points: ArrayLike<number>, corners: ArrayLike<number>, out: number[], effort: Effort): void {
  const count = corners.length;
  if (count === 3) {
    out.push(0, 1, 2);
    return;
  }
  const flat = flattened(points, corners);
  if (!flat || count > MAX_CORNERS || effort.left <= 0 || isConvex(flat, count)) {
    for (let i = 2; i < count; i++) out.push(0, i - 1, i);
    return;
  }
  const left = Array.from({ length: count }, (_, i) => i);
  while (left.length > 3) {
    const ear = earOf(flat, left, effort);
    const n = left.length;
    out.push(left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]);
    left.splice(ear, 1);
  }
  out.push(left[0], left[1], left[2]);
}

/** Scratch of `flattened`. */
let plane = new Float64Array(64);

/** x y per corner in the plane of the polygon, counter-clockwise; undefined if it has no area. Scratch. */
function flattened(points: ArrayLike<number>, corners: ArrayLike<number>): Float64Array | undefined {
  let x = 0;
  let y = 0;
  let z = 0;
  const count = corners.length;
  // Newell's method: right for polygons that are not quite flat.
  for (let i = 0; i < count; i++) {
    const a = 3 * corners[i];
    const b = 3 * corners[i + 1 === count ? 0 : i + 1];
    x += (points[a + 1] - points[b + 1]) * (points[a + 2] + points[b + 2]);
    y += (points[a + 2] - points[b + 2]) * (points[a] + points[b]);
    z += (points[a] - points[b]) * (points[a + 1] + points[b + 1]);
  }
  if (!(length3(x, y, z) > 0)) return undefined;
  const [sizeX, sizeY, sizeZ] = [Math.abs(x), Math.abs(y), Math.abs(z)];
  const main = sizeX >= sizeY && sizeX >= sizeZ ? 0 : sizeY >= sizeZ ? 1 : 2;
  const isAhead = (main === 0 ? x : main === 1 ? y : z) > 0;
  const u = (main + (isAhead ? 1 : 2)) % 3;
  const v = (main + (isAhead ? 2 : 1)) % 3;
  if (plane.length < 2 * count) plane = new Float64Array(2 * count);
  for (let i = 0; i < count; i++) {
    plane[2 * i] = points[3 * corners[i] + u];
    plane[2 * i + 1] = points[3 * corners[i] + v];
  }
  return plane;
}

/** Whether it turns left at every corner, and about once in all: then it turns up once and down once. */
function isConvex(flat: Float64Array, count: number): boolean {
  let turns = 0;
  let wasUp = flat[1] > flat[2 * count - 1];
  for (let i = 0; i < count; i++) {
    const next = i + 1 === count ? 0 : i + 1;
    const after = next + 1 === count ? 0 : next + 1;
    if (!(area(flat, i, next, after) > 0)) return false;
    const isUp = flat[2 * next + 1] > flat[2 * i + 1];
    if (isUp !== wasUp) turns++;
    wasUp = isUp;
  }
  return turns <= 2;
}

/** One of the corners left that can be cut off; the first if there is none. */
function earOf(flat: Float64Array, left: readonly number[], effort: Effort): number {
  const n = left.length;
  if (effort.left <= 0) return 1;
  // Quads are cut from their first corner to their third unless one of the others is turned inwards.
  for (let k = 0; k < n; k++) {
    const i = (k + 1) % n;
    const [a, b, c] = [left[(i + n - 1) % n], left[i], left[(i + 1) % n]];
    if (!(area(flat, a, b, c) > 0)) continue;
    effort.left -= n;
    const isEmpty = left.every((p) => p === a || p === b || p === c || !contains(flat, a, b, c, p));
    if (isEmpty) return i;
  }
  return 0;
}

function area(flat: Float64Array, a: number, b: number, c: number): number {
  return (
    (flat[2 * b] - flat[2 * a]) * (flat[2 * c + 1] - flat[2 * a + 1]) -
    (flat[2 * c] - flat[2 * a]) * (flat[2 * b + 1] - flat[2 * a + 1])
  );
}

function contains(flat: Float64Array, a: number, b: number, c: number, p: number): boolean {
  return area(flat, a, b, p) >= 0 && area(flat, b, c, p) >= 0 && area(flat, c, a, p) >= 0;
}
