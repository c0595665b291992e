/**
 * Parts of a mesh that belong to a leaf joint as a whole: wings, ears, feathers. These are open sheets: there is no
 * inside through which a bone could be seen, and they are closer to the trunk's bones, which they run beside, than to
 * their own base. A sheet starts at the pivot nearest to it, and belongs there if the bone that leads to that pivot
 * approaches it from outside, by more than half its length. Bones inside clothes, or inside a body modelled as an open
 * surface, don't.
 */
import type { Steps } from '../steps.ts';
import { type BoneSegments, endsAt, isPoint } from './bones.ts';
import type { WeldedMesh } from './weld.ts';

/** Distances measured between two yields. */
const A_STEP = 100_000;

/**
 * For each part of the mesh, the bone of length 0 that it belongs to, or -1. Yields its progress.
 * @param sides of each part, 0 for sheets (`surface-sides.ts`)
 */
export function* hangingSheets(mesh: WeldedMesh, sides: Int8Array, { joints, ends }: BoneSegments): Steps<Int32Array> {
  const { parts, partCount, vertexCount } = mesh;
  const step = Math.ceil(A_STEP / joints.length);
  const nearest = new Int32Array(partCount).fill(-1);
  const squares = new Float64Array(partCount).fill(Infinity);
  for (let v = 0; v < vertexCount; v++) {
    if (v % step === 0) yield v / vertexCount;
    const part = parts[v];
    if (sides[part] !== 0) continue;
    for (let b = 0; b < joints.length; b++) {
      const square = squareToPivot(mesh, v, ends, b);
      if (square >= squares[part]) continue;
      squares[part] = square;
      nearest[part] = b;
    }
  }
  /** For each joint that is only a pivot, the bone that leads to it. */
  const leading = Int32Array.from(joints, (_, point) =>
    isPoint(ends, point) ? joints.findIndex((_, b) => endsAt(ends, b, point)) : -1,
  );
  const before = new Float64Array(partCount).fill(Infinity);
  for (let v = 0; v < vertexCount; v++) {
    if (v % A_STEP === 0) yield 1;
    const part = parts[v];
    const lead = nearest[part] < 0 ? -1 : leading[nearest[part]];
    if (lead >= 0) before[part] = Math.min(before[part], squareToPivot(mesh, v, ends, lead));
  }
  return nearest.map((point, part) => {
    const lead = point < 0 ? -1 : leading[point];
    if (lead < 0) return -1;
    const o = 6 * lead;
    const length = Math.hypot(ends[o + 3] - ends[o], ends[o + 4] - ends[o + 1], ends[o + 5] - ends[o + 2]);
    return Math.sqrt(before[part]) - Math.sqrt(squares[part]) > length / 2 ? point : -1;
  });
}

/** Squared distance from a vertex to the start of a bone. */
function squareToPivot({ positions }: WeldedMesh, v: number, ends: Float64Array, bone: number): number {
  const x = positions[3 * v] - ends[6 * bone];
  const y = positions[3 * v + 1] - ends[6 * bone + 1];
  const z = positions[3 * v + 2] - ends[6 * bone + 2];
  return x * x + y * y + z * z;
}
