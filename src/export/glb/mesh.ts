/** A skin as a glTF mesh: attributes that all primitives share, and morph targets as sparse accessors. */
import { normalsOf } from '../../evaluate/skin/normals.ts';
import type { Morph } from '../../model/morph.ts';
import { type Skin, vertexCount } from '../../model/skin.ts';
import type { AttachmentSets } from '../shared/attachments.ts';
import {
  facingNormals,
  type MorphDifferences,
  normalDifferences,
  positionDifferences,
  unitNormals,
} from '../shared/mesh-data.ts';
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
  const sparse = ({ indices, values }: MorphDifferences, bounds: boolean) =>
    chunk.sparse(count, indices, values, bounds);
  const targets = morphs.map((morph) => ({
    POSITION: sparse(positionDifferences(morph, skin), true),
    ...(hasNormals && { NORMAL: sparse(normalDifferences(morph, normals), false) }),
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

/** v runs down in glTF. */
function downwards(texcoords: Float64Array): Float32Array<ArrayBuffer> {
  return Float32Array.from(texcoords, (value, i) => (i % 2 === 0 ? value : 1 - value));
}
