/**
 * Skin weights by heat equilibrium: I. Baran and J. Popović, "Automatic Rigging and Animation of 3D Characters", ACM
 * Transactions on Graphics 26 (3), 2007, section 4. The surface conducts heat; one joint's bones are held at 1, all
 * others at 0, and the equilibrium temperature of a vertex is its weight for that joint:
 *
 *     −Δw + H·w = H·p             p  1 if the joint's bone is the nearest visible from the vertex (shared among equals)
 *                                 H  1/d², d the distance to it; 0 if no bone is visible
 *
 * that is (L + A·H)·w = A·H·p with cotangents and areas of the welded mesh (`laplacian.ts`), one system per joint. L
 * has no negative weights and its rows sum to 0, so every w lies in 0 … 1 and they sum to 1. Units of length cancel.
 * Visibility: `visible-bones.ts`; ends of leaf bones: `last-bones.ts`.
 *
 * Parts of a mesh that no bone heats, and vertices without triangles, get weights by 1/d² of the bones' distances.
 *
 * Bounded biharmonic weights (Jacobson 2011) are smoother, but need a tetrahedral mesh of the volume, which real files
 * with holes and overlapping parts don't allow.
 */

import type { Attachments, Skin } from '../../model/skin.ts';
import { type Steps, within } from '../steps.ts';
import { type BoneSegments, squareToBone } from './bones.ts';
import { Cholesky } from './cholesky.ts';
import { Influences } from './influences.ts';
import { laplacian } from './laplacian.ts';
import { lastBones } from './last-bones.ts';
import { surfaceSides } from './surface-sides.ts';
import { triangleTree } from './triangle-tree.ts';
import { visibleBones, type Warmth } from './visible-bones.ts';
import { type WeldedMesh, weld } from './weld.ts';

/** The weights of a skin by heat equilibrium. */
export interface HeatWeights {
  readonly attachments: Attachments;
  /** Vertices of the skin that heat did not reach, weighted by distance. */
  readonly byDistance: number;
}

/** Minimum distance to a bone, as a fraction of the mesh's diagonal, so that heat stays finite. */
const NEAREST = 1e-4;
/** Approximate shares of the time. */
const WELD_DONE = 0.02;
const TREE_DONE = 0.08;
const BONES_DONE = 0.25;
const SIGHT_DONE = 0.4;
const SETTLED = 0.98;
/** Shares of the matrix and its factor in the time for the systems. */
const MATRIX_MADE = 0.05;
const FACTORISED = 0.5;
/** Vertices between two yields. */
const VERTICES_A_STEP = 5000;

/**
 * Weights for a mesh around bones, both in the binding pose. Yields its progress every few milliseconds.
 * @param mostInfluences maximum number of joints per vertex; at least 1
 */
export function* heatWeights(
  { positions, triangles }: Pick<Skin, 'positions' | 'triangles'>,
  given: BoneSegments,
  mostInfluences: number,
): Steps<HeatWeights> {
  const mesh = yield* within(weld(positions, triangles), 0, WELD_DONE);
  const influences = new Influences(mesh.vertexCount, mostInfluences);
  const tree = yield* within(triangleTree(mesh), WELD_DONE, TREE_DONE);
  const surface = yield* within(surfaceSides(mesh), TREE_DONE, TREE_DONE);
  const bones = yield* within(lastBones(tree, surface, given), TREE_DONE, BONES_DONE);
  const warmth = yield* within(visibleBones(tree, surface, bones), BONES_DONE, SIGHT_DONE);
  yield* within(equilibria(mesh, warmth, influences), SIGHT_DONE, SETTLED);
  const isCold = new Uint8Array(mesh.vertexCount);
  for (let v = 0; v < mesh.vertexCount; v++) {
    if (influences.has(v)) continue;
    isCold[v] = 1;
    addByDistance(mesh, v, bones, influences);
    if (v % VERTICES_A_STEP === 0) yield SETTLED;
  }
  let byDistance = 0;
  for (const v of mesh.of) byDistance += isCold[v];
  return { attachments: yield* within(influences.attachments(mesh.of), SETTLED, 1), byDistance };
}

/** Solves one system for each joint that heats anything. */
function* equilibria(mesh: WeldedMesh, warmth: Warmth, influences: Influences): Steps<void> {
  const matrix = yield* within(laplacian(mesh), 0, MATRIX_MADE);
  const { squares, start, joints } = warmth;
  const heat = new Float64Array(mesh.vertexCount);
  const isWarm = new Uint8Array(mesh.partCount);
  const least = (NEAREST * mesh.diagonal) ** 2;
  for (let v = 0; v < mesh.vertexCount; v++) {
    if (squares[v] < Infinity) heat[v] = matrix.areas[v] / Math.max(squares[v], least);
    if (heat[v] > 0) isWarm[mesh.parts[v]] = 1;
  }
  // Parts without heat would be singular; with any positive diagonal they stay at 0.
  const added = heat.map((h, v) => (isWarm[mesh.parts[v]] ? h : 1));
  const system = yield* within(Cholesky.of(matrix, added, mesh.positions), MATRIX_MADE, FACTORISED);
  const warming = [...new Set(joints)].sort((a, b) => a - b);
  const right = new Float64Array(mesh.vertexCount);
  const weights = new Float64Array(mesh.vertexCount);
  for (let n = 0; n < warming.length; n++) {
    const joint = warming[n];
    for (let v = 0; v < mesh.vertexCount; v++) {
      weights[v] = partOf(joint, joints, start[v], start[v + 1]);
      right[v] = heat[v] * weights[v];
    }
    const part = FACTORISED + ((1 - FACTORISED) * n) / warming.length;
    for (const _ of system.solve(right, weights)) yield part;
    for (let v = 0; v < mesh.vertexCount; v++) influences.add(v, joint, weights[v]);
    yield part;
  }
}

/** The fraction of a vertex's heat that comes from a joint: shared equally by the nearest ones. */
function partOf(joint: number, joints: Uint32Array, from: number, to: number): number {
  for (let i = from; i < to; i++) if (joints[i] === joint) return 1 / (to - from);
  return 0;
}

function addByDistance(
  { positions, diagonal }: WeldedMesh,
  v: number,
  { joints, ends }: BoneSegments,
  influences: Influences,
): void {
  const least = (NEAREST * diagonal) ** 2 || 1;
  for (let b = 0; b < joints.length; ) {
    const joint = joints[b];
    let square = Infinity;
    for (; b < joints.length && joints[b] === joint; b++) {
      const [x, y, z] = [positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]];
      square = Math.min(square, squareToBone(ends, b, x, y, z));
    }
    influences.add(v, joint, 1 / Math.max(square, least));
  }
}
