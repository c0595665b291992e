/**
 * What of a mesh hangs on a last joint as a whole: wings, ears, feathers. These are sheets: they have no inside through
 * which a bone could be seen, and lie nearer to the trunk's bones, which they run beside, than to where they begin. Such a
 * sheet begins at the pivot that is the nearest to it, and hangs there if the bone that leads to that pivot comes from
 * away: it nears the sheet by more than half of its length. A bone that runs within clothes, or within a body that is
 * modelled as an open surface, does not.
 */
import type { Steps } from '../steps.ts';
import { type BoneSegments, endsAt, isPoint } from './bones.ts';
import type { WeldedMesh } from './weld.ts';

/** Distances measured between two pauses. */
const A_STEP = 100_000;

/**
 * Of each part of the mesh, the bone without length that it hangs on, or -1. Pauses with the part that is done.
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
  /** The bone that leads to each pivot that is all of its joint's bone. */
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

/** The square of the distance from a vertex to where a bone begins. */
function squareToPivot({ positions }: WeldedMesh, v: number, ends: Float64Array, bone: number): number {
  const x = positions[3 * v] - ends[6 * bone];
  const y = positions[3 * v + 1] - ends[6 * bone + 1];
  const z = positions[3 * v + 2] - ends[6 * bone + 2];
  return x * x + y * y + z * z;
}
