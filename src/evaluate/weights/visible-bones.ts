/**
 * Which bones warm a vertex: the nearest one that it sees through the inside of the body, and those just as near. Where
 * the nearest is the end of a bone, and a last joint's pivot stands there without a bone of its own, it is that joint's.
 *
 * Inside is told along the segment from the vertex to the nearest point of the bone. Every part of the mesh that has a
 * volume is entered and left by its triangles' sides; a part is also inside at the start where it is left before it is
 * entered. While one part at least is inside, the segment is in the body: bodies may be put together from parts that
 * overlap, and holes let it through. A part without a volume (a cape, a membrane) hides nothing.
 *
 * Baran and Popović ask the same of a distance field of the whole volume, and take a vertex whose nearest bone is hidden
 * for warmed by none. Here it looks further, for the nearest that is not: a skeleton that a person has put in by eye lies
 * out of the middle, and the inner side of a leg is often nearer to the other leg's bone. Where none is seen through the
 * inside, the nearest that nothing at all hides counts: bones may run beside the mesh.
 */
import type { Steps } from '../steps.ts';
import { type BoneSegments, endsAt, nearest, squareToBone } from './bones.ts';
import type { SurfaceSides } from './surface-sides.ts';
import { Hits, hitsBetween, type TriangleTree } from './triangle-tree.ts';

/** Bones looked at for each vertex, nearest first. */
const MAX_CANDIDATES = 12;
/** Distances that differ by a smaller part are the same. */
const AS_NEAR = 1e-4;
/** Nearer than this part of the mesh's diagonal, they are the same, too. */
const AT_BONE = 1e-9;
/** A part of the segment that may run outside: pivots stand a hair out of the skin, and meshes have gaps. */
const OUTSIDE = 0.02;
/** Of a bone's length, at both ends: looked for a little inside of them, since bones end at the skin, or stand out of it. */
const END = 0.05;
/** How far below the surface it looks from, beside the distance. */
const BELOW = 2e-3;
/** Vertices between two pauses. */
const VERTICES_A_STEP = 50;

export interface Warmth {
  /** The square of the distance to the bones that warm a vertex; Infinity where none does. */
  readonly squares: Float64Array;
  /** Joints that warm vertex i, alike: `joints[start[i]]` up to, not including, `start[i + 1]`; ascending. */
  readonly start: Uint32Array;
  readonly joints: Uint32Array;
}

/** Pauses with the part that is done. */
export function* visibleBones(tree: TriangleTree, surface: SurfaceSides, bones: BoneSegments): Steps<Warmth> {
  const { mesh } = tree;
  const sight = new Sight(tree, surface);
  const boneCount = bones.joints.length;
  const distances = new Float64Array(boneCount);
  const along = new Float64Array(boneCount);
  const squares = new Float64Array(mesh.vertexCount).fill(Infinity);
  const start = new Uint32Array(mesh.vertexCount + 1);
  const joints: number[] = [];
  /** Bones as near as the nearest, and as well seen. */
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
        // What stands at the end of one is seen where that is.
        const isSeen = b === found || endsAt(bones.ends, found, b) || sight.from(v, bones, b, along[b]) === through;
        if (isSeen) equals.push(b);
      }
      for (const b of equals) {
        if (along[b] === 1 && equals.some((other) => endsAt(bones.ends, b, other))) continue;
        // Several bones of one joint are one source, and come one after another.
        if (joints.length === from || joints[joints.length - 1] !== bones.joints[b]) joints.push(bones.joints[b]);
      }
    }
    start[v + 1] = joints.length;
    if (v % VERTICES_A_STEP === 0) yield v / mesh.vertexCount;
  }
  return { squares, start, joints: Uint32Array.from(joints) };
}

/** The bone that comes after another by distance, then by number; -1 begins. */
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
/** Through the open, with nothing between. */
const OPEN = 1;
const INSIDE = 2;

class Sight {
  private readonly hits = new Hits();
  private readonly normals: Float64Array;
  private readonly sides: Int8Array;
  private readonly origin = new Float64Array(3);
  private readonly target = new Float64Array(3);
  /** Parts that the segment meets, and whether it is inside of each. */
  private readonly met: number[] = [];
  private readonly isIn: boolean[] = [];

  constructor(
    private readonly tree: TriangleTree,
    { normals, sides }: SurfaceSides,
  ) {
    this.normals = normals;
    this.sides = sides;
  }

  /** Whether a vertex sees the point of a bone that is nearest to it. */
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
    // From a little below the surface: whether it goes out by the very triangles at the vertex is seen then.
    for (let k = 0; k < 3; k++) origin[k] -= side * BELOW * distance * normals[3 * vertex + k];
    hitsBetween(this.tree, origin, target, NONE, hits);
    if (this.isInside(own, side * out <= 0)) return INSIDE;
    return this.orOpen();
  }

  /** Out of its own skin, and through nothing else. */
  private orOpen(): number {
    return this.hits.count <= 1 ? OPEN : HIDDEN;
  }

  /**
   * @param own the part that the segment begins at
   * @param sinks whether it sets out into that, as far as the normal tells; where triangles of the part are met on the
   * way they tell better
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
    // What is nowhere met is inside all the way, or nowhere.
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
      // Met twice where two triangles share an edge.
      if (isIn[slot] !== leaves) continue;
      isIn[slot] = !leaves;
      inside += leaves ? -1 : 1;
    }
    if (inside === 0) outside += 1 - before;
    return outside <= OUTSIDE;
  }
}
