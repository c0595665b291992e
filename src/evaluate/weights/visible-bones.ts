/**
 * Which bones heat a vertex: the nearest one that it sees through the inside of the body, and equally near ones. If the
 * nearest is the end of a bone, and a leaf joint's pivot without a bone of its own is there, that joint heats it.
 *
 * Inside is determined along the segment from the vertex to the nearest point of the bone. Every part of the mesh with
 * volume is entered and left through its triangles; a part that is left before it is entered was inside from the start.
 * The segment is in the body while it is inside at least one part: bodies may consist of overlapping parts, and holes
 * let it through. A part without volume (a cape, a membrane) hides nothing.
 *
 * Baran and Popović test this with a distance field of the whole volume, and a vertex whose nearest bone is hidden gets
 * no heat. Here the search continues to the nearest visible one: skeletons placed by eye are off-centre, and the inner
 * side of a leg is often closer to the other leg's bone. If none is visible through the inside, the nearest one not
 * hidden by anything counts: bones may run beside the mesh.
 */

import { Hits } from '../skin/triangle-hits.ts';
import type { Steps } from '../steps.ts';
import { type BoneSegments, endsAt, nearest, squareToBone } from './bones.ts';
import type { SurfaceSides } from './surface-sides.ts';
import { hitsBetween, type TriangleTree } from './triangle-tree.ts';

/** Bones tested per vertex, nearest first. */
const MAX_CANDIDATES = 12;
/** Relative difference below which distances are equal. */
const AS_NEAR = 1e-4;
/** Distances below this fraction of the mesh's diagonal are equal too. */
const AT_BONE = 1e-9;
/** Fraction of the segment that may run outside: pivots may be slightly outside the skin, and meshes have gaps. */
const OUTSIDE = 0.02;
/** Fraction of a bone's length cut at both ends when testing, since bones end at the skin or outside it. */
const END = 0.05;
/** Depth of the starting point below the surface, relative to the distance. */
const BELOW = 2e-3;
/** Vertices between two yields. */
const VERTICES_A_STEP = 50;

/** Which joints heat each vertex, and how strongly. */
export interface Warmth {
  /** Squared distance to the bones that heat a vertex; Infinity if none does. */
  readonly squares: Float64Array;
  /** Joints that heat vertex i, equally: `joints[start[i]]` up to (excluding) `start[i + 1]`; ascending. */
  readonly start: Uint32Array;
  readonly joints: Uint32Array;
}

/** Yields its progress. */
export function* visibleBones(tree: TriangleTree, surface: SurfaceSides, bones: BoneSegments): Steps<Warmth> {
  const { mesh } = tree;
  const sight = new Sight(tree, surface);
  const boneCount = bones.joints.length;
  const distances = new Float64Array(boneCount);
  const along = new Float64Array(boneCount);
  const squares = new Float64Array(mesh.vertexCount).fill(Infinity);
  const start = new Uint32Array(mesh.vertexCount + 1);
  const joints: number[] = [];
  /** Bones as near as the nearest, and equally visible. */
  const equals: number[] = [];
  for (let v = 0; v < mesh.vertexCount; v++) {
    const x = mesh.positions[3 * v];
    const y = mesh.positions[3 * v + 1];
    const z = mesh.positions[3 * v + 2];
    for (let b = 0; b < boneCount; b++) {
      distances[b] = squareToBone(bones.ends, b, x, y, z);
      along[b] = nearest.along;
    }
    let found = -1;
    let through: number = HIDDEN;
    let open = -1;
    let after = -1;
    for (let tried = 0; tried < Math.min(MAX_CANDIDATES, boneCount) && through !== INSIDE; tried++) {
      const b = nextNearest(distances, after);
      after = b;
      through = sight.from(v, bones, b, along[b]);
      if (through === INSIDE) found = b;
      else if (through === OPEN && open < 0) open = b;
    }
    if (found < 0 && open >= 0) {
      found = open;
      through = OPEN;
    }
    if (found >= 0) {
      squares[v] = distances[found];
      const most = distances[found] * (1 + AS_NEAR) ** 2 + (AT_BONE * mesh.diagonal) ** 2;
      const from = joints.length;
      equals.length = 0;
      for (let b = 0; b < boneCount; b++) {
        if (distances[b] > most) continue;
        // A point at the end of a visible bone is visible.
        const isSeen = b === found || endsAt(bones.ends, found, b) || sight.from(v, bones, b, along[b]) === through;
        if (isSeen) equals.push(b);
      }
      for (const b of equals) {
        if (along[b] === 1 && equals.some((other) => endsAt(bones.ends, b, other))) continue;
        // Several bones of one joint are one source, and are consecutive.
        if (joints.length === from || joints[joints.length - 1] !== bones.joints[b]) joints.push(bones.joints[b]);
      }
    }
    start[v + 1] = joints.length;
    if (v % VERTICES_A_STEP === 0) yield v / mesh.vertexCount;
  }
  return { squares, start, joints: Uint32Array.from(joints) };
}

/** The next bone by distance, then by index; -1 starts. */
function nextNearest(distances: Float64Array, after: number): number {
  const least = after < 0 ? -1 : distances[after];
  let best = -1;
  for (let b = 0; b < distances.length; b++) {
    const d = distances[b];
    const isLater = d > least || (d === least && b > after);
    if (isLater && (best < 0 || d < distances[best])) best = b;
  }
  return best;
}

/** No vertex. */
const NONE = 0xffffffff;
const HIDDEN = 0;
/** Outside, with nothing in between. */
const OPEN = 1;
const INSIDE = 2;

class Sight {
  private readonly hits = new Hits();
  private readonly normals: Float64Array;
  private readonly sides: Int8Array;
  private readonly origin = new Float64Array(3);
  private readonly target = new Float64Array(3);
  /** Parts that the segment meets, and whether it is inside each. */
  private readonly met: number[] = [];
  private readonly isIn: boolean[] = [];

  constructor(
    private readonly tree: TriangleTree,
    { normals, sides }: SurfaceSides,
  ) {
    this.normals = normals;
    this.sides = sides;
  }

  /** Whether a vertex sees the point of a bone nearest to it. */
  from(vertex: number, { ends }: BoneSegments, bone: number, along: number): number {
    const { mesh } = this.tree;
    const { origin, target, normals, hits } = this;
    let square = 0;
    let out = 0;
    const t = Math.min(1 - END, Math.max(END, along));
    for (let k = 0; k < 3; k++) {
      origin[k] = mesh.positions[3 * vertex + k];
      target[k] = ends[6 * bone + k] + t * (ends[6 * bone + 3 + k] - ends[6 * bone + k]);
      const d = target[k] - origin[k];
      square += d * d;
      out += d * normals[3 * vertex + k];
    }
    const distance = Math.sqrt(square);
    if (distance <= 1e-9 * mesh.diagonal) return INSIDE;
    const own = mesh.parts[vertex];
    const side = this.sides[own];
    if (side === 0) {
      hitsBetween(this.tree, origin, target, vertex, hits);
      return this.isInside(own, true) ? INSIDE : this.orOpen();
    }
    // From slightly below the surface, to detect that it leaves through the triangles at the vertex itself.
    for (let k = 0; k < 3; k++) origin[k] -= side * BELOW * distance * normals[3 * vertex + k];
    hitsBetween(this.tree, origin, target, NONE, hits);
    if (this.isInside(own, side * out <= 0)) return INSIDE;
    return this.orOpen();
  }

  /** Through its own surface and nothing else. */
  private orOpen(): number {
    return this.hits.count <= 1 ? OPEN : HIDDEN;
  }

  /**
   * @param own the part that the segment starts at
   * @param sinks whether it starts into that part according to the normal; triangles of the part met on the way tell
   * more reliably
   */
  private isInside(own: number, sinks: boolean): boolean {
    const { hits, met, isIn, sides } = this;
    const { mesh } = this.tree;
    met.length = isIn.length = 0;
    let inside = 0;
    // A part that is left first was inside from the start.
    for (let h = 0; h < hits.count; h++) {
      const part = mesh.parts[mesh.triangles[3 * hits.triangles[h]]];
      if (sides[part] === 0 || met.includes(part)) continue;
      const leaves = (hits.along[h] === 1) === sides[part] > 0;
      met.push(part);
      isIn.push(leaves);
      if (leaves) inside++;
    }
    // Without crossings the segment is inside all the way, or not at all.
    if (sinks && !met.includes(own)) return true;
    let outside = 0;
    let before = 0;
    for (let h = 0; h < hits.count; h++) {
      if (inside === 0) outside += hits.times[h] - before;
      before = hits.times[h];
      const part = mesh.parts[mesh.triangles[3 * hits.triangles[h]]];
      if (sides[part] === 0) continue;
      const slot = met.indexOf(part);
      const leaves = (hits.along[h] === 1) === sides[part] > 0;
      // Counted twice if two triangles share an edge.
      if (isIn[slot] !== leaves) continue;
      isIn[slot] = !leaves;
      inside += leaves ? -1 : 1;
    }
    if (inside === 0) outside += 1 - before;
    return outside <= OUTSIDE;
  }
}
