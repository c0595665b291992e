/** A skin's normals, triangles and morphs as other programs expect them. */
import { length3, normalizeAt } from '../../math/vec3.ts';
import type { Morph, MorphRows } from '../../model/morph.ts';
import type { Skin } from '../../model/skin.ts';

/** Normals of length 1; those without a direction point up. */
export function unitNormals(normals: Float64Array): Float32Array<ArrayBuffer> {
  const unit = Float64Array.from(normals);
  for (let o = 0; o < unit.length; o += 3) {
    if (normalizeAt(unit, o)) continue;
    unit[o] = unit[o + 2] = 0;
    unit[o + 1] = 1;
  }
  return Float32Array.from(unit);
}

/**
 * The triangles, each wound so that it faces the way of its normals: here winding has no meaning, but viewers shade the
 * back of a triangle by the reversed normal.
 */
export function facingNormals({ triangles, positions: p }: Skin, n: Float64Array): Uint32Array {
  const out = triangles.slice(0, triangles.length - (triangles.length % 3));
  for (let i = 0; i < out.length; i += 3) {
    const a = 3 * out[i];
    const b = 3 * out[i + 1];
    const c = 3 * out[i + 2];
    const side = (k: number, l: number) =>
      (p[b + k] - p[a + k]) * (p[c + l] - p[a + l]) - (p[b + l] - p[a + l]) * (p[c + k] - p[a + k]);
    const facing =
      side(1, 2) * (n[a] + n[b] + n[c]) +
      side(2, 0) * (n[a + 1] + n[b + 1] + n[c + 1]) +
      side(0, 1) * (n[a + 2] + n[b + 2] + n[c + 2]);
    if (facing < 0) [out[i + 1], out[i + 2]] = [out[i + 2], out[i + 1]];
  }
  return out;
}

/** Numbers that a morph adds to vertices at its full weight. */
export interface MorphDifferences {
  /** Ascending. */
  readonly indices: Uint32Array;
  /** x y z each. */
  readonly values: Float32Array<ArrayBuffer>;
}

/** Differences of a morph from the positions of a skin. */
export function positionDifferences(morph: Morph, skin: Skin): MorphDifferences {
  return differences(morph.positions, skin.positions, () => 1);
}

/**
 * Differences of a morph from the normals of a skin, relative to their lengths, since they are written with length 1.
 * @param normals of the skin, of any length
 */
export function normalDifferences(morph: Morph, normals: Float64Array): MorphDifferences {
  const perLength = (v: number) => 1 / (length3(normals[3 * v], normals[3 * v + 1], normals[3 * v + 2]) || 1);
  return differences(morph.normals, normals, perLength);
}

/** The rows of a morph that differ from the skin, as differences; those beyond its vertices are left out. */
function differences(
  { indices, values }: MorphRows,
  base: Float64Array,
  factor: (vertex: number) => number,
): MorphDifferences {
  const rows = Array.from(indices.keys())
    .filter((row) => 3 * indices[row] < base.length)
    .sort((a, b) => indices[a] - indices[b]);
  const all = rows.map((row) => {
    const v = indices[row];
    return [0, 1, 2].map((k) => Math.fround((values[3 * row + k] - base[3 * v + k]) * factor(v)));
  });
  const moved = rows.flatMap((row, i) => (all[i].some((d) => d !== 0) ? [{ row, by: all[i] }] : []));
  return {
    indices: Uint32Array.from(moved, ({ row }) => indices[row]),
    values: Float32Array.from(moved.flatMap(({ by }) => by)),
  };
}
