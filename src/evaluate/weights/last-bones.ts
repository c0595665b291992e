/**
 * Finds the length of leaf bones that the skeleton only has as points, without child, box, length or End Site, such as
 * the last joint of a leg without feet. The mesh determines it. To such a joint belong the vertices for which its pivot
 * is the nearest visible bone, and sheets attached to it (`hanging-sheets.ts`). With c the centroid of that surface by
 * area and r its extent along c, both relative to the pivot, the bone goes from there to
 *
 *     min(2 |c|, r) · c / |c|
 *
 * the far end of a limb, whose centroid is half way. Around a pivot in the middle c is 0, and the bone stays a point.
 * Using only the farthest vertex works as well for limbs, but a stray one would turn the bone.
 *
 * Baran and Popović (`heat-weights.ts`) have no such joints: their skeletons are their own, and all bones have two
 * ends.
 */
import { type Steps, within } from '../steps.ts';
import { type BoneSegments, isPoint } from './bones.ts';
import { hangingSheets } from './hanging-sheets.ts';
import type { SurfaceSides } from './surface-sides.ts';
import type { TriangleTree } from './triangle-tree.ts';
import { visibleBones } from './visible-bones.ts';

/** Approximate share of the time. */
const SEEN = 0.9;
/** Shorter bones, relative to the mesh's diagonal, stay points. */
const SHORTEST = 1e-4;
/** Vertices between two yields. */
const A_STEP = 15000;

/** The bones, in the same order, extended where they were points. Yields its progress. */
export function* lastBones(tree: TriangleTree, surface: SurfaceSides, bones: BoneSegments): Steps<BoneSegments> {
  const points = [...bones.joints.keys()].filter((bone) => isPoint(bones.ends, bone));
  if (points.length === 0) return bones;
  const { mesh } = tree;
  const warmth = yield* within(visibleBones(tree, surface, bones), 0, SEEN);
  const sheets = yield* within(hangingSheets(mesh, surface.sides, bones), SEEN, 1);
  const { areas } = surface;
  const pointOf = new Map(points.map((point) => [bones.joints[point], point]));
  /** Visits every vertex with each point that it belongs to. */
  const each = function* (visit: (v: number, point: number) => void): Steps<void> {
    for (let v = 0; v < mesh.vertexCount; v++) {
      if (v % A_STEP === 0) yield 1;
      const sheet = sheets[mesh.parts[v]];
      if (sheet >= 0) visit(v, sheet);
      for (let i = warmth.start[v]; sheet < 0 && i < warmth.start[v + 1]; i++) {
        const point = pointOf.get(warmth.joints[i]);
        if (point !== undefined) visit(v, point);
      }
    }
  };
  const { ends } = bones;
  const from = (v: number, point: number, k: number) => mesh.positions[3 * v + k] - ends[6 * point + k];
  /** c of each bone. */
  const middles = new Float64Array(3 * bones.joints.length);
  const all = new Float64Array(bones.joints.length);
  yield* each((v, point) => {
    for (let k = 0; k < 3; k++) middles[3 * point + k] += areas[v] * from(v, point, k);
    all[point] += areas[v];
  });
  for (const point of points) {
    for (let k = 0; k < 3; k++) middles[3 * point + k] /= all[point] || 1;
  }
  /** r · |c| */
  const reaches = new Float64Array(bones.joints.length);
  yield* each((v, point) => {
    let dot = 0;
    for (let k = 0; k < 3; k++) dot += middles[3 * point + k] * from(v, point, k);
    reaches[point] = Math.max(reaches[point], dot);
  });
  const grown = ends.slice();
  for (const point of points) {
    const middle = middles.subarray(3 * point, 3 * point + 3);
    const length = Math.hypot(...middle);
    if (2 * length <= SHORTEST * mesh.diagonal) continue;
    // In units of |c|, along c.
    const times = Math.min(2, reaches[point] / length ** 2);
    for (let k = 0; k < 3; k++) grown[6 * point + 3 + k] += times * middle[k];
  }
  return { joints: bones.joints, ends: grown };
}
