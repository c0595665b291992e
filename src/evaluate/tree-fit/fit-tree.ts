/**
 * Bones of constant length for joints that are given by their positions alone, as from videos: rotations that bring the
 * joints as near to their positions as bones allow.
 *
 *     lengths      the median of each over the frames
 *     root         where it is
 *     one child    the smallest turn from the parent's rotation that aims at the child, from where the joint has come to be
 *     several      the rotation that fits all of them best; their shape is the mean of the frames
 *     leaves       not turned
 *
 * At rest all rotations are 0, and the bones of known trees are in a T-pose (`stance.ts`), others as in the first
 * frame.
 */
import { setIdentity3, swing } from '../../math/mat3.ts';
import { quaternionOfRotation, writeRotation } from '../../math/quaternion.ts';
import { length3 } from '../../math/vec3.ts';
import type { FrameJoints } from '../captured-frames.ts';
import { boneLengths, measuredFrames } from './bones.ts';
import type { JointTree } from './known-trees.ts';
import { clearRotation, nearestRotation } from './nearest-rotation.ts';
import { jointsWriter, type PointPaths } from './point-paths.ts';
import { addProduct, restShape } from './rest-shape.ts';
import { type BodyUp, toStance } from './stance.ts';

/** A tree with bones, and what writes its frames. */
export class FittedTree {
  readonly joints: FrameJoints;
  /** Of a known tree. */
  readonly up: BodyUp | undefined;
  private readonly children: readonly (readonly number[])[];
  private readonly onlyChild: Int32Array;
  private readonly parents: Int32Array;
  private readonly order: Int32Array;
  private readonly read: (frame: number, out: Float64Array, o: number) => void;
  /** x y z of each joint in its parent's space, and the length of that. */
  private readonly offsets: Float64Array;
  private readonly lengths: Float64Array;
  /** Of each joint, the sum of the squares of the lengths of its children. */
  private readonly squares: Float64Array;
  /** Of each joint, in a frame: x y z as given and as fitted, and its rotation in the world, x y z w. */
  private readonly given: Float64Array;
  private readonly fitted: Float64Array;
  private readonly world: Float64Array;
  /** The same as 9 numbers, of joints with several children. */
  private readonly matrices: readonly Float64Array[];
  private sum = 0;
  private count = 0;
  private largest = 0;

  constructor(paths: PointPaths, tree: JointTree) {
    const { names, parents } = tree;
    const count = names.length;
    this.children = names.map((_, j) => parents.flatMap((parent, child) => (parent === j ? [child] : [])));
    this.onlyChild = Int32Array.from(this.children, (own) => (own.length > 1 ? SEVERAL : (own[0] ?? NONE)));
    this.parents = Int32Array.from(parents);
    this.order = Int32Array.from(parentsFirst(this.children, parents));
    this.read = jointsWriter(paths, tree);
    const { offsets, up } = offsetsOf(paths, tree, this.children);
    this.offsets = offsets;
    this.up = up;
    this.lengths = Float64Array.from(names, (_, j) => Math.hypot(...this.offsets.subarray(3 * j, 3 * j + 3)));
    this.squares = Float64Array.from(this.children, (own) =>
      own.reduce((sum, child) => sum + this.lengths[child] * this.lengths[child], 0),
    );
    this.given = new Float64Array(3 * count);
    this.fitted = new Float64Array(3 * count);
    this.world = new Float64Array(4 * count);
    this.matrices = this.children.map(() => IDENTITY.slice());
    this.joints = { names, parents, offsets: this.offsets, moves: parents.map((parent) => parent < 0) };
  }

  /** The mean distance of the joints of all frames so far from where they were given, in the unit of the points. */
  get meanDistance(): number {
    return this.sum / Math.max(1, this.count);
  }

  /** The largest one. */
  get largestDistance(): number {
    return this.largest;
  }

  /** Writes a frame, as `JointFrames` has it. */
  write(frame: number, rotations: Float64Array, places: Float64Array): void {
    const { given, fitted, order, parents, onlyChild } = this;
    this.read(frame, given, 0);
    for (let i = 0; i < order.length; i++) {
      const j = order[i];
      if (parents[j] < 0) for (let k = 3 * j; k < 3 * j + 3; k++) places[k] = fitted[k] = given[k];
      if (onlyChild[j] >= 0) this.aim(j, onlyChild[j], rotations);
      else if (onlyChild[j] === SEVERAL) this.fit(j, rotations);
      else this.keep(j, rotations);
    }
    this.count += order.length;
  }

  /** Leaves a joint turned as its parent is. */
  private keep(j: number, rotations: Float64Array): void {
    const o = 4 * j;
    rotations[o] = rotations[o + 1] = rotations[o + 2] = 0;
    rotations[o + 3] = 1;
    if (this.onlyChild[j] !== NONE) this.carry(j, rotations);
  }

  /** Writes the rotation of a joint in the world, from that of its parent. */
  private carry(j: number, rotations: Float64Array): void {
    const { world, parents } = this;
    const o = 4 * j;
    const x = rotations[o];
    const y = rotations[o + 1];
    const z = rotations[o + 2];
    const w = rotations[o + 3];
    const p = 4 * parents[j];
    if (p < 0) {
      world[o] = x;
      world[o + 1] = y;
      world[o + 2] = z;
      world[o + 3] = w;
      return;
    }
    const a = world[p];
    const b = world[p + 1];
    const c = world[p + 2];
    const d = world[p + 3];
    world[o] = d * x + a * w + b * z - c * y;
    world[o + 1] = d * y - a * z + b * w + c * x;
    world[o + 2] = d * z + a * y - b * x + c * w;
    world[o + 3] = d * w - a * x - b * y - c * z;
  }

  /**
   * Turns a joint from its parent's rotation so that it aims at its only child. The smallest turn that takes o to v is
   * the quaternion along o × v and |o||v| + o·v.
   */
  private aim(j: number, child: number, rotations: Float64Array): void {
    const { world, offsets, given, fitted, parents } = this;
    const a = 3 * j;
    const c = 3 * child;
    let x = given[c] - fitted[a];
    let y = given[c + 1] - fitted[a + 1];
    let z = given[c + 2] - fitted[a + 2];
    const length = this.lengths[child];
    // Those whose squares are too small have no direction either.
    const distance = Math.sqrt(x * x + y * y + z * z);
    const product = length * distance;
    if (!(product > TINY)) {
      this.keep(j, rotations);
      writeRotation(world[4 * j], world[4 * j + 1], world[4 * j + 2], world[4 * j + 3], rotation, 0, 3);
      this.place(rotation, j, child);
      return;
    }
    const part = length / distance;
    fitted[c] = fitted[a] + x * part;
    fitted[c + 1] = fitted[a + 1] + y * part;
    fitted[c + 2] = fitted[a + 2] + z * part;
    this.measure(Math.abs(distance - length));
    const p = 4 * parents[j];
    if (p >= 0) {
      // Into the parent's space.
      const qx = world[p];
      const qy = world[p + 1];
      const qz = world[p + 2];
      const w = 2 * world[p + 3];
      const tx = y * qz - z * qy;
      const ty = z * qx - x * qz;
      const tz = x * qy - y * qx;
      x += w * tx + 2 * (ty * qz - tz * qy);
      y += w * ty + 2 * (tz * qx - tx * qz);
      z += w * tz + 2 * (tx * qy - ty * qx);
    }
    const ox = offsets[c];
    const oy = offsets[c + 1];
    const oz = offsets[c + 2];
    const o = 4 * j;
    const sum = product + ox * x + oy * y + oz * z;
    if (sum < NEARLY_OPPOSITE * product) {
      wanted[0] = x;
      wanted[1] = y;
      wanted[2] = z;
      swing(offsets, c, wanted, 0, rotation, 0);
      quaternionOfRotation(rotation, 0, quaternion);
      for (let k = 0; k < 4; k++) rotations[o + k] = quaternion[k];
    } else {
      const s = 1 / Math.sqrt(2 * product * sum);
      rotations[o] = (oy * z - oz * y) * s;
      rotations[o + 1] = (oz * x - ox * z) * s;
      rotations[o + 2] = (ox * y - oy * x) * s;
      rotations[o + 3] = sum * s;
    }
    // A leaf is at the end of its bone, whichever way that is turned.
    if (this.onlyChild[child] !== NONE) this.carry(j, rotations);
  }

  /** Turns a joint so that its children are as near as they can be to where they are given. */
  private fit(j: number, rotations: Float64Array): void {
    const { world, matrices, offsets, children, given, fitted, parents } = this;
    const own = children[j];
    const turned = matrices[j];
    const a = 3 * j;
    for (let k = 0; k < 9; k++) products[k] = 0;
    let wantedSquares = 0;
    for (let i = 0; i < own.length; i++) {
      const c = 3 * own[i];
      const x = given[c] - fitted[a];
      const y = given[c + 1] - fitted[a + 1];
      const z = given[c + 2] - fitted[a + 2];
      wanted[0] = x;
      wanted[1] = y;
      wanted[2] = z;
      addProduct(wanted, 0, offsets, c, products);
      wantedSquares += x * x + y * y + z * z;
    }
    const p = 4 * parents[j];
    if (!clearRotation(products, Math.sqrt(this.squares[j] * wantedSquares), turned)) {
      if (p < 0) setIdentity3(near);
      else writeRotation(world[p], world[p + 1], world[p + 2], world[p + 3], near, 0, 3);
      // From the frame before.
      nearestRotation(products, turned, near);
    }
    quaternionOfRotation(turned, 0, quaternion);
    const o = 4 * j;
    for (let k = 0; k < 4; k++) world[o + k] = quaternion[k];
    const x = quaternion[0];
    const y = quaternion[1];
    const z = quaternion[2];
    const w = quaternion[3];
    // Into the parent's space.
    const px = p < 0 ? 0 : world[p];
    const py = p < 0 ? 0 : world[p + 1];
    const pz = p < 0 ? 0 : world[p + 2];
    const pw = p < 0 ? 1 : world[p + 3];
    rotations[o] = pw * x - px * w - py * z + pz * y;
    rotations[o + 1] = pw * y - py * w - pz * x + px * z;
    rotations[o + 2] = pw * z - pz * w - px * y + py * x;
    rotations[o + 3] = pw * w + px * x + py * y + pz * z;
    for (let i = 0; i < own.length; i++) this.place(turned, j, own[i]);
  }

  /** Puts a child to the end of its bone, from a joint with that rotation in the world. */
  private place(m: Float64Array, j: number, child: number): void {
    const { offsets, given, fitted } = this;
    const a = 3 * j;
    const c = 3 * child;
    const u = offsets[c];
    const v = offsets[c + 1];
    const w = offsets[c + 2];
    const x = fitted[a] + m[0] * u + m[3] * v + m[6] * w;
    const y = fitted[a + 1] + m[1] * u + m[4] * v + m[7] * w;
    const z = fitted[a + 2] + m[2] * u + m[5] * v + m[8] * w;
    fitted[c] = x;
    fitted[c + 1] = y;
    fitted[c + 2] = z;
    this.measure(length3(given[c] - x, given[c + 1] - y, given[c + 2] - z));
  }

  private measure(distance: number): void {
    this.sum += distance;
    if (distance > this.largest) this.largest = distance;
  }
}

/** Instead of an only child. */
const [NONE, SEVERAL] = [-1, -2];
/** Vectors whose lengths have a smaller product have no direction: its square would be 0. */
const TINY = 1e-140;
/** Of the largest sum: below it, a quaternion has lost digits. */
const NEARLY_OPPOSITE = 1e-3;

/** The median lengths, in a T-pose if the tree is a known one, else in the directions of the first frame. */
function offsetsOf(paths: PointPaths, tree: JointTree, children: readonly (readonly number[])[]) {
  const { parents } = tree;
  const frames = measuredFrames(paths, tree);
  const lengths = boneLengths(tree, frames);
  const offsets = new Float64Array(3 * parents.length);
  parents.forEach((parent, j) => {
    if (parent < 0) for (let k = 3 * j; k < 3 * j + 3; k++) offsets[k] = frames.positions[k];
  });
  children.forEach((own, j) => {
    if (own.length === 0) return;
    const shape = restShape(frames, parents.length, j, own);
    own.forEach((child, c) => {
      const length = Math.hypot(shape[3 * c], shape[3 * c + 1], shape[3 * c + 2]);
      // One that is where its parent is in most frames has no direction.
      for (let k = 0; k < 3; k++)
        offsets[3 * child + k] = length > 0 ? (shape[3 * c + k] * lengths[child]) / length : 0;
    });
  });
  return { offsets, up: tree.isKnown ? toStance(tree.names, children, frames, offsets) : undefined };
}

function parentsFirst(children: readonly (readonly number[])[], parents: readonly number[]): readonly number[] {
  const order = parents.flatMap((parent, j) => (parent < 0 ? [j] : []));
  for (let i = 0; i < order.length; i++) order.push(...children[order[i]]);
  return order;
}

const IDENTITY = Float64Array.of(1, 0, 0, 0, 1, 0, 0, 0, 1);
/** Scratch; never escapes. */
const products = new Float64Array(9);
const near = new Float64Array(9);
const rotation = new Float64Array(9);
const wanted = new Float64Array(3);
const quaternion = new Float64Array(4);
