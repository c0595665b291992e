/**
 * Skin weights by the equilibrium of heat: I. Baran and J. Popović, "Automatic Rigging and Animation of 3D Characters",
 * ACM Transactions on Graphics 26 (3), 2007, section 4. The surface is a skin that conducts heat; one joint's bones are
 * held at 1, all others at 0, and the temperature that settles at a vertex is its weight for that joint:
 *
 *     −Δw + H·w = H·p             p  1 where the joint's bone is the nearest that the vertex sees (shared among equals)
 *                                 H  1/d², d the distance to it; 0 where no bone is seen
 *
 * that is (L + A·H)·w = A·H·p with cotangents and areas of the welded mesh (`laplacian.ts`), one system for each joint.
 * L has no negative weights and its rows sum to 0, so every w lies in 0 … 1 and all of them together are 1. Units of
 * length cancel. What is seen: `visible-bones.ts`; where the bones of last joints end: `last-bones.ts`.
 *
 * Parts of a mesh that no bone warms, and vertices in no triangle, get weights by 1/d² of the bones' distances.
 *
 * Bounded biharmonic weights (Jacobson 2011) are smoother, and need the volume filled with tetrahedra, which real files
 * with their holes and overlapping parts do not let one do.
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

export interface HeatWeights {
  readonly attachments: Attachments;
  /** Vertices of the skin that heat did not reach: by distance alone. */
  readonly byDistance: number;
}

/** Nearer to a bone than this part of the mesh's diagonal is no nearer: heat stays finite. */
const NEAREST = 1e-4;
/** How the time goes, about. */
const WELD_DONE = 0.02;
const TREE_DONE = 0.08;
const BONES_DONE = 0.25;
const SIGHT_DONE = 0.4;
const SETTLED = 0.98;
/** Of the systems' time, what their matrix and its factor take. */
const MATRIX_MADE = 0.05;
const FACTORISED = 0.5;
/** Vertices between two pauses. */
const VERTICES_A_STEP = 5000;

/**
 * Weights for a mesh around bones, both as they are bound. Pauses every few milliseconds with the part that is done.
 * @param mostInfluences joints that move a vertex, at most; at least 1
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

/** One system for each joint that warms anything. */
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
  // Parts without heat would be singular; with any on the diagonal they stay at 0.
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

/** What of a vertex's heat comes from a joint: it has as much as any other that is as near. */
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
