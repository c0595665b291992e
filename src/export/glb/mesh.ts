/** A skin as a glTF mesh: attributes that all primitives share, and morph targets as sparse accessors. */
import { normalsOf } from '../../evaluate/skin/normals.ts';
import { length3, normalizeAt } from '../../math/vec3.ts';
import type { Morph, MorphRows } from '../../model/morph.ts';
import { type Skin, vertexCount } from '../../model/skin.ts';
import type { AttachmentSets } from '../shared/attachments.ts';
import { type BinaryChunk, INDICES, type Json, VERTICES } from './container.ts';

/** The parts that a mesh is made of. */
export interface MeshParts {
  readonly skin: Skin;
  readonly morphs: readonly Morph[];
  /** Absent for a mesh that no joints move. */
  readonly sets?: AttachmentSets;
  /** Weights of the morphs in the pose of the file. */
  readonly morphWeights: readonly number[];
}

/** Adds a skin; returns the mesh for the JSON, whose materials are those of the skin's surfaces. */
export function addMesh(chunk: BinaryChunk, { skin, morphs, sets, morphWeights }: MeshParts): Json {
  const count = vertexCount(skin);
  const attributes: Record<string, number> = {
    POSITION: chunk.accessor('VEC3', Float32Array.from(skin.positions), { target: VERTICES, bounds: true }),
    NORMAL: chunk.accessor('VEC3', unitNormals(normalsOf(skin)), { target: VERTICES }),
  };
  if (skin.texcoords) attributes.TEXCOORD_0 = chunk.accessor('VEC2', downwards(skin.texcoords), { target: VERTICES });
  sets?.joints.forEach((joints, set) => {
    attributes[`JOINTS_${set}`] = chunk.accessor('VEC4', joints, { target: VERTICES });
    attributes[`WEIGHTS_${set}`] = chunk.accessor('VEC4', sets.weights[set], { target: VERTICES });
  });
  const hasNormals = morphs.some((morph) => morph.normals.indices.length > 0);
  const normals = normalsOf(skin);
  const perLength = (v: number) => 1 / (length3(normals[3 * v], normals[3 * v + 1], normals[3 * v + 2]) || 1);
  const targets = morphs.map((morph) => ({
    POSITION: addDifferences(chunk, morph.positions, skin.positions, count, () => 1, true),
    // Relative to the skin's normals, which are written with length 1.
    ...(hasNormals && { NORMAL: addDifferences(chunk, morph.normals, normals, count, perLength, false) }),
  }));
  const triangles = facingNormals(skin, normals);
  const shared = { attributes, ...(targets.length && { targets }) };
  const primitives = skin.surfaces.flatMap(({ triangleStart, triangleCount }, material) => {
    if (triangleCount === 0) return [];
    const part = triangles.subarray(3 * triangleStart, 3 * (triangleStart + triangleCount));
    const indices = count <= 65535 ? Uint16Array.from(part) : Uint32Array.from(part);
    return { ...shared, indices: chunk.accessor('SCALAR', indices, { target: INDICES }), material };
  });
  return {
    name: skin.name,
    // Without triangles: points.
    primitives: primitives.length ? primitives : [{ ...shared, mode: 0 }],
    ...(targets.length && {
      weights: morphWeights,
      extras: { targetNames: morphs.map(({ name }) => name) },
    }),
  };
}

function unitNormals(normals: Float64Array): Float32Array<ArrayBuffer> {
  const unit = Float64Array.from(normals);
  for (let o = 0; o < unit.length; o += 3) {
    if (normalizeAt(unit, o)) continue;
    unit[o] = unit[o + 2] = 0;
    unit[o + 1] = 1;
  }
  return Float32Array.from(unit);
}

/** v runs down in glTF. */
function downwards(texcoords: Float64Array): Float32Array<ArrayBuffer> {
  return Float32Array.from(texcoords, (value, i) => (i % 2 === 0 ? value : 1 - value));
}

/**
 * The triangles, each wound so that it faces the way of its normals: here winding has no meaning, but viewers shade the
 * back of a triangle by the reversed normal.
 */
function facingNormals({ triangles, positions: p }: Skin, n: Float64Array): Uint32Array {
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

/** The rows of a morph that differ from the skin, as differences; those beyond its vertices are left out. */
function addDifferences(
  chunk: BinaryChunk,
  { indices, values }: MorphRows,
  base: Float64Array,
  count: number,
  factor: (vertex: number) => number,
  bounds: boolean,
): number {
  const rows = Array.from(indices.keys())
    .filter((row) => indices[row] < count)
    .sort((a, b) => indices[a] - indices[b]);
  const differences = rows.map((row) => {
    const v = indices[row];
    return [0, 1, 2].map((k) => Math.fround((values[3 * row + k] - base[3 * v + k]) * factor(v)));
  });
  const moved = rows.flatMap((row, i) => (differences[i].some((d) => d !== 0) ? [{ row, by: differences[i] }] : []));
  return chunk.sparse(
    count,
    Uint32Array.from(moved, ({ row }) => indices[row]),
    Float32Array.from(moved.flatMap(({ by }) => by)),
    bounds,
  );
}
