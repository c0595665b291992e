/** Finds the outside of a mesh. */

import { areaNormal } from '../../math/triangle.ts';
import { normalizeAt } from '../../math/vec3.ts';
import type { Steps } from '../steps.ts';
import type { WeldedMesh } from './weld.ts';

/** Which way the normals of a mesh point, part by part. */
export interface SurfaceSides {
  /** Normals by winding: area-weighted, normalised, or 0 for a vertex without any; x y z per vertex. */
  readonly normals: Float64Array;
  /** For each part: 1 if these point outwards, -1 inwards, 0 if it has no volume: a sheet. */
  readonly sides: Int8Array;
  /** Three times the area around each vertex: the sum of its triangles' areas. */
  readonly areas: Float64Array;
}

/**
 * Volume² of a part relative to area³; below it is a sheet. A ball has 9·10⁻³, a tube 100 times as long as thick
 * 4·10⁻⁴.
 */
const SHEET = 4e-6;
/** Corners between two yields; a multiple of 3. */
const A_STEP = 30000;

/**
 * By the sign of each part's volume about its centre, since files wind triangles either way. Yields every few
 * milliseconds.
 */
export function* surfaceSides(mesh: WeldedMesh): Steps<SurfaceSides> {
  const { positions: p, triangles, parts, partCount, vertexCount } = mesh;
  const normals = new Float64Array(3 * vertexCount);
  const middles = middlesOf(mesh);
  const volumes = new Float64Array(partCount);
  const partAreas = new Float64Array(partCount);
  const areas = new Float64Array(vertexCount);
  const normal = new Float64Array(3);
  for (let t = 0; t < triangles.length; t += 3) {
    if (t % A_STEP === 0) yield 0;
    const a = 3 * triangles[t];
    const b = 3 * triangles[t + 1];
    const c = 3 * triangles[t + 2];
    areaNormal(p, a, b, c, normal);
    const x = normal[0];
    const y = normal[1];
    const z = normal[2];
    const part = parts[triangles[t]];
    const m = 3 * part;
    volumes[part] += ((p[a] - middles[m]) * x + (p[a + 1] - middles[m + 1]) * y + (p[a + 2] - middles[m + 2]) * z) / 6;
    const area = Math.sqrt(x * x + y * y + z * z) / 2;
    partAreas[part] += area;
    for (let corner = 0; corner < 3; corner++) {
      areas[triangles[t + corner]] += area;
      const o = 3 * triangles[t + corner];
      normals[o] += x;
      normals[o + 1] += y;
      normals[o + 2] += z;
    }
  }
  for (let o = 0; o < normals.length; o += 3) normalizeAt(normals, o);
  return {
    normals,
    sides: Int8Array.from(volumes, (volume, part) =>
      volume ** 2 > SHEET * partAreas[part] ** 3 ? Math.sign(volume) : 0,
    ),
    areas,
  };
}

/** Centres of the corners of each part's triangles; x y z per part. */
function middlesOf({ positions, triangles, parts, partCount }: WeldedMesh): Float64Array {
  const middles = new Float64Array(3 * partCount);
  const counts = new Uint32Array(partCount);
  for (let t = 0; t < triangles.length; t++) {
    const part = parts[triangles[t]];
    counts[part]++;
    for (let k = 0; k < 3; k++) middles[3 * part + k] += positions[3 * triangles[t] + k];
  }
  for (let part = 0; part < partCount; part++) {
    for (let k = 0; k < 3; k++) middles[3 * part + k] /= counts[part] || 1;
  }
  return middles;
}
