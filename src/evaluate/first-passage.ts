/**
 * The middle of what a line of sight passes through first, so that a point picked on a limb is inside of it:
 *
 *     ────┤▓▓▓●▓▓▓├─────┤▓▓▓▓▓▓▓├───→          in through the first surface, out through the next one that faces the other way
 *
 * Which way a surface faces matters, since there may be several in a row: clothes over a body, or two triangles at the
 * edge that the line meets.
 */
import { Hits, hitTriangle, type TriangleMesh } from './skin/triangle-hits.ts';

/** Scratch, never escapes. */
const hits = new Hits();

/**
 * The middle as a part of the way, 0 to 1; undefined if it misses the mesh, or never leaves it: an open surface.
 *
 * @param mesh triangles wound alike, outwards or inwards
 * @param start x y z, outside of the mesh
 * @param way x y z from there to beyond the mesh
 */
export function middleOfFirstPassage(
  mesh: TriangleMesh,
  [ox, oy, oz]: readonly [number, number, number],
  [dx, dy, dz]: readonly [number, number, number],
): number | undefined {
  hits.count = 0;
  const count = mesh.triangles.length / 3;
  for (let t = 0; t < count; t++) hitTriangle(mesh, t, -1, ox, oy, oz, dx, dy, dz, hits);
  for (let h = 1; h < hits.count; h++) {
    if (hits.along[h] !== hits.along[0]) return (hits.times[0] + hits.times[h]) / 2;
  }
  return undefined;
}
