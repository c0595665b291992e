/**
 * A skin's normals: the file's own, or computed ones.
 *
 *     n = normalised Σ over the vertex's triangles (b − a) × (c − a)
 *
 * The cross product's length is twice the area, so large triangles weigh more.
 */
import { areaNormal } from '../../math/triangle.ts';
import { normalizeAt } from '../../math/vec3.ts';
import { perObject } from '../../model/per-object.ts';
import { type Skin, vertexCount } from '../../model/skin.ts';

const computed = perObject(({ positions, triangles }: Skin) => computeNormals(positions, triangles));

/** x y z per vertex: the file's own, of any length, or computed ones, normalised and cached. */
export function normalsOf(skin: Skin): Float64Array {
  return skin.normals ?? computed(skin);
}

/** Adopts normals that `computeNormals` returned elsewhere, in a worker. */
export function adoptNormals(skin: Skin, normals: Float64Array): void {
  if (normals.length === 3 * vertexCount(skin)) computed.adopt(skin, normals);
}

/** Area-weighted normals. A vertex without triangles, or whose triangles cancel out, points up. */
export function computeNormals(positions: Float64Array, triangles: Uint32Array): Float64Array {
  const normals = new Float64Array(positions.length);
  const area = new Float64Array(3);
  for (let t = 0; t + 2 < triangles.length; t += 3) {
    const a = 3 * triangles[t];
    const b = 3 * triangles[t + 1];
    const c = 3 * triangles[t + 2];
    areaNormal(positions, a, b, c, area);
    const x = area[0];
    const y = area[1];
    const z = area[2];
    normals[a] += x;
    normals[a + 1] += y;
    normals[a + 2] += z;
    normals[b] += x;
    normals[b + 1] += y;
    normals[b + 2] += z;
    normals[c] += x;
    normals[c + 1] += y;
    normals[c + 2] += z;
  }
  for (let o = 0; o < normals.length; o += 3) {
    if (normalizeAt(normals, o)) continue;
    normals[o] = normals[o + 2] = 0;
    normals[o + 1] = 1;
  }
  return normals;
}
