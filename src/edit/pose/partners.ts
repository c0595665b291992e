/**
 * Pairs joints across a plane: by name (`sides.ts`), otherwise by shape. The root is its own partner. Below a joint
 * that is its own partner, children are paired with each other or are in the middle; below a pair, the children of one
 * are paired with those of the other.
 *
 *     cost of c and c′ = |M·p − p′| + |M·m − m′| + size · |n − n′| / (n + n′)
 *
 * with p the pivot, m the centre of the joints from there on, n their number and M the reflection. Each pair's children
 * are compared in turn, without recursion, so that chains may have any length.
 */
import type { Vec3 } from '../../math/vec3.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { partnersByName, plainName, sidedName } from './sides.ts';

/** Fractions of the size: distance from the plane that counts as the middle, and maximum cost of a pair. */
const IN_THE_MIDDLE = 0.1;
const FITS = 0.35;
/** A pair must fit better than this fraction of the cost of each as its own mirror image. */
const BETTER_THAN_SELF = 0.5;
/** With more siblings, only names are used. */
const MAX_SIBLINGS = 400;

/** The counterpart of each joint across a plane; distances are fractions of the skeleton's size. */
export interface Partners {
  /** Each joint's partner, itself in the middle, -1 for none. */
  readonly partner: Int32Array;
  /** Total distance of mirrored joints from their partners; in sizes. */
  readonly asymmetry: number;
  /** Joints that are not their own partner. */
  readonly paired: number;
  /** Total distance between paired joints; in sizes. */
  readonly apart: number;
}

/**
 * Pairs the joints of a skeleton across a plane.
 * @param points x y z per joint
 * @param normal of the plane through the root, normalised
 */
export function partnersAcross(skeleton: Skeleton, points: Float64Array, normal: Vec3): Partners {
  const shape = new Shape(skeleton, points, normal);
  return shape.partners();
}

/** Half the distance of the farthest joint from the root; 1 if all coincide. */
export function halfWidth(points: Float64Array): number {
  let size = 0;
  for (let o = 3; o < points.length; o += 3) {
    size = Math.max(size, Math.hypot(points[o] - points[0], points[o + 1] - points[1], points[o + 2] - points[2]));
  }
  return size || 1;
}

class Shape {
  private readonly partner: Int32Array;
  private readonly children: number[][];
  /** For each joint's subtree: the number of joints and their centre. */
  private readonly counts: Float64Array;
  private readonly middles: Float64Array;
  private readonly size: number;
  private readonly hasNamedSides: boolean;

  constructor(
    private readonly skeleton: Skeleton,
    private readonly points: Float64Array,
    private readonly normal: Vec3,
  ) {
    const { joints } = skeleton;
    this.partner = partnersByName(joints.map(({ name }) => name));
    // The root has no other side, whatever its name.
    if (this.partner[0] >= 0) this.partner[this.partner[0]] = -1;
    this.hasNamedSides = this.partner.some((other) => other >= 0);
    this.partner[0] = 0;
    this.children = joints.map(() => []);
    this.counts = new Float64Array(joints.length).fill(1);
    this.middles = points.slice();
    for (let j = joints.length - 1; j > 0; j--) {
      const { parent } = joints[j];
      this.children[parent].push(j);
      this.counts[parent] += this.counts[j];
      for (let k = 0; k < 3; k++) {
        this.middles[3 * parent + k] += this.middles[3 * j + k];
        this.middles[3 * j + k] /= this.counts[j];
      }
    }
    for (let k = 0; k < 3; k++) this.middles[k] /= this.counts[0];
    for (const list of this.children) list.reverse();
    this.size = halfWidth(points);
  }

  partners(): Partners {
    const { partner, points, size, skeleton } = this;
    for (let j = 0; j < skeleton.joints.length; j++) {
      const other = partner[j];
      if (other === j) this.matchWithin(this.free(j));
      // Once per pair, at the first of the two.
      else if (other > j) this.matchAcross(this.free(j), this.free(other));
    }
    let asymmetry = 0;
    let paired = 0;
    let apart = 0;
    partner.forEach((other, j) => {
      if (other < 0) return;
      asymmetry += this.mirroredDistance(points, j, other) / size;
      if (other === j) return;
      paired++;
      apart += distance(points, j, other) / size;
    });
    return { partner, asymmetry, paired, apart };
  }

  private free(joint: number): number[] {
    return this.children[joint].filter((c) => this.partner[c] < 0);
  }

  /** Among the children of a joint that is its own partner. */
  private matchWithin(children: readonly number[]): void {
    const { partner, size } = this;
    const self = children.map((c) => this.cost(c, c));
    const candidates: { readonly a: number; readonly b: number; readonly cost: number }[] = [];
    if (children.length <= MAX_SIBLINGS) {
      children.forEach((a, i) => {
        for (let k = i + 1; k < children.length; k++) {
          const cost = this.cost(a, children[k]);
          const isBetter = cost < BETTER_THAN_SELF * Math.min(self[i], self[k]);
          if (cost < FITS * size && isBetter) candidates.push({ a, b: children[k], cost });
        }
      });
    }
    this.take(candidates);
    for (const c of children) {
      if (partner[c] >= 0 || sidedName(this.skeleton.joints[c].name)) continue;
      // If names give sides, those without one are in the middle. An only child can only be its own image.
      const isMiddle = this.hasNamedSides || this.children[this.skeleton.joints[c].parent].length === 1;
      if (isMiddle || this.distanceToPlane(c) < IN_THE_MIDDLE * size) partner[c] = c;
    }
  }

  /** Between the children of two partners. */
  private matchAcross(children: readonly number[], others: readonly number[]): void {
    const { joints } = this.skeleton;
    const { partner, size } = this;
    const byName = new Map<string, number[]>();
    for (const o of others) {
      const key = plainName(joints[o].name);
      if (key) byName.set(key, [...(byName.get(key) ?? []), o]);
    }
    for (const c of children) {
      const found = byName.get(plainName(joints[c].name))?.shift();
      if (found !== undefined) this.pair(c, found);
    }
    const [rest, otherRest] = [children, others].map((list) => list.filter((c) => partner[c] < 0));
    if (rest.length === 1 && otherRest.length === 1) this.pair(rest[0], otherRest[0]);
    if (rest.length * otherRest.length > MAX_SIBLINGS ** 2) return;
    this.take(
      rest.flatMap((a) => otherRest.map((b) => ({ a, b, cost: this.cost(a, b) })).filter((c) => c.cost < FITS * size)),
    );
  }

  /** The cheapest first, each joint once. */
  private take(candidates: readonly { readonly a: number; readonly b: number; readonly cost: number }[]): void {
    for (const { a, b } of [...candidates].sort((x, y) => x.cost - y.cost)) {
      if (this.partner[a] < 0 && this.partner[b] < 0) this.pair(a, b);
    }
  }

  private pair(a: number, b: number): void {
    this.partner[a] = b;
    this.partner[b] = a;
  }

  private cost(a: number, b: number): number {
    const { counts, points, middles, size } = this;
    const counted = Math.abs(counts[a] - counts[b]) / (counts[a] + counts[b]);
    return this.mirroredDistance(points, a, b) + this.mirroredDistance(middles, a, b) + size * counted;
  }

  /** From the mirror image of one to the other. */
  private mirroredDistance(points: Float64Array, a: number, b: number): number {
    const [nx, ny, nz] = this.normal;
    const [x, y, z] = [
      points[3 * a] - this.points[0],
      points[3 * a + 1] - this.points[1],
      points[3 * a + 2] - this.points[2],
    ];
    const d = 2 * (nx * x + ny * y + nz * z);
    return Math.hypot(
      points[3 * a] - d * nx - points[3 * b],
      points[3 * a + 1] - d * ny - points[3 * b + 1],
      points[3 * a + 2] - d * nz - points[3 * b + 2],
    );
  }

  private distanceToPlane(joint: number): number {
    return this.mirroredDistance(this.points, joint, joint) / 2;
  }
}

function distance(points: Float64Array, a: number, b: number): number {
  return Math.hypot(
    points[3 * a] - points[3 * b],
    points[3 * a + 1] - points[3 * b + 1],
    points[3 * a + 2] - points[3 * b + 2],
  );
}
