/**
 * The skins of an FBX mesh: clusters, each with a joint, weights of points, and two matrices of the moment when it was
 * bound: from the mesh to the joint (Transform), and from the joint to the world (TransformLink).
 */
import { invertAffine, isSingular, multiplyAffine, setIdentity } from '../../math/mat4.ts';
import { type FbxDocument, type FbxObject, partsOfKind } from './document.ts';
import { childOf, numbersOf, textAt } from './records/record.ts';

/** The weights of one joint, with the matrices of its binding. */
export interface FbxCluster {
  /** Index of the node. */
  readonly node: number;
  readonly points: ArrayLike<number>;
  readonly weights: ArrayLike<number>;
  /** From the model of the mesh to the joint, at `[0]`; undefined if the file doesn't say. */
  readonly toJoint: Float64Array | undefined;
  /** From the joint to the world. */
  readonly link: Float64Array | undefined;
}

/** A skin: the clusters of a mesh. */
export interface FbxSkin {
  readonly clusters: readonly FbxCluster[];
  /** `Linear`, `Rigid`, `DualQuaternion` or `Blend`. */
  readonly method: string;
}

/**
 * The skins of a geometry.
 * @param nodeOf the index of a model; -1 for one that is not in the scene
 */
export function skinsOf(document: FbxDocument, geometry: FbxObject, nodeOf: (id: number) => number): FbxSkin[] {
  return partsOfKind(document, geometry, 'Deformer', 'Skin').map((skin) => ({
    method: textAt(childOf(skin.record, 'SkinningType')) ?? 'Linear',
    clusters: partsOfKind(document, skin, 'Deformer', 'Cluster').flatMap((cluster) => {
      const node = partsOfKind(document, cluster, 'Model')
        .map(({ id }) => nodeOf(id))
        .find((index) => index >= 0);
      if (node === undefined) return [];
      const { record } = cluster;
      return [
        {
          node,
          points: numbersOf(childOf(record, 'Indexes')),
          weights: numbersOf(childOf(record, 'Weights')),
          toJoint: matrixOf(numbersOf(childOf(record, 'Transform'))),
          link: matrixOf(numbersOf(childOf(record, 'TransformLink'))),
        },
      ];
    }),
  }));
}

function matrixOf(numbers: ArrayLike<number>): Float64Array | undefined {
  if (numbers.length < 16) return undefined;
  const matrix = Float64Array.from({ length: 16 }, (_, i) => numbers[i]);
  return matrix.every(Number.isFinite) && !isSingular(matrix) ? matrix : undefined;
}

/** How vertices of a skinned mesh are placed, and from there to each joint. */
export interface Bound {
  /** From the model of the mesh to the space of the vertices: the world when the skin was bound. */
  readonly place: Float64Array;
  /** 16 numbers per cluster, from the space of the vertices to the joint. */
  readonly inverses: Float64Array;
}

/** Matrices that differ by no more are the same. */
const SAME = 1e-5;

/**
 * Vertices are placed in the world of the moment of binding, which is the same for all clusters of most files, so that
 * meshes share joints.
 * @param worlds 16 numbers per node at rest
 */
export function boundOf(clusters: readonly FbxCluster[], meshNode: number, worlds: Float64Array): Bound {
  const inverse = new Float64Array(16);
  const toJoints = clusters.map(({ toJoint, link, node }) => {
    if (toJoint) return toJoint;
    const own = new Float64Array(16);
    const joint = link ?? worlds.slice(16 * node, 16 * node + 16);
    if (isSingular(joint)) {
      setIdentity(own);
      return own;
    }
    invertAffine(joint, 0, inverse, 0);
    multiplyAffine(inverse, 0, worlds, 16 * meshNode, own, 0);
    return own;
  });
  const place = new Float64Array(16);
  const first = clusters.findIndex(({ link }) => link !== undefined);
  const link = clusters[first]?.link;
  if (link) multiplyAffine(link, 0, toJoints[first], 0, place, 0);
  if (!link || isSingular(place)) setIdentity(place);
  const back = new Float64Array(16);
  invertAffine(place, 0, back, 0);
  const inverses = new Float64Array(16 * clusters.length);
  for (const [i, cluster] of clusters.entries()) {
    multiplyAffine(toJoints[i], 0, back, 0, inverses, 16 * i);
    if (!cluster.link) continue;
    // Without the rounding of two multiplications, so that it is the same for all meshes.
    invertAffine(cluster.link, 0, inverse, 0);
    if (isNear(inverse, inverses.subarray(16 * i, 16 * i + 16))) inverses.set(inverse, 16 * i);
  }
  return { place, inverses };
}

/** Whether two matrices are the same but for rounding. */
export function isNear(a: Float64Array, b: Float64Array): boolean {
  const size = a.reduce((most, value) => Math.max(most, Math.abs(value)), 1);
  return a.every((value, i) => Math.abs(value - b[i]) <= SAME * size);
}
