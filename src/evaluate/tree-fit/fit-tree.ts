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
 * At rest all rotations are 0, and the bones have the directions of the first frame.
 */
import { backMultiply3, copy3, multiply3, setIdentity3, swing, turnVector } from '../../math/mat3.ts';
import { quaternionOfRotation } from '../../math/quaternion.ts';
import { length3 } from '../../math/vec3.ts';
import type { FrameJoints } from '../captured-frames.ts';
import { boneLengths, measuredFrames } from './bones.ts';
import type { JointTree } from './known-trees.ts';
import { nearestRotation } from './nearest-rotation.ts';
import { type PointPaths, writeJoints } from './point-paths.ts';
import { addProduct, restShape } from './rest-shape.ts';

/** A tree with bones, and what writes its frames. */
export class FittedTree {
  readonly joints: FrameJoints;
  private readonly children: readonly (readonly number[])[];
  /** x y z of each joint in its parent's space. */
  private readonly offsets: Float64Array;
  private readonly order: readonly number[];
  /** Of each joint, in a frame: x y z as given and as fitted, and its rotation in the world, 9 numbers. */
  private readonly given: Float64Array;
  private readonly fitted: Float64Array;
  private readonly world: Float64Array;
  private sum = 0;
  private count = 0;
  private largest = 0;

  constructor(
    private readonly paths: PointPaths,
    private readonly tree: JointTree,
  ) {
    const { names, parents } = tree;
    const count = names.length;
    this.children = names.map((_, j) => parents.flatMap((parent, child) => (parent === j ? [child] : [])));
    this.order = parentsFirst(this.children, parents);
    this.given = new Float64Array(3 * count);
    this.fitted = new Float64Array(3 * count);
    this.world = new Float64Array(9 * count);
    for (let j = 0; j < count; j++) setIdentity3(this.world, 9 * j);
    this.offsets = this.offsetsOf();
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
    const { paths, tree, given, fitted, world, offsets, order } = this;
    const { parents } = tree;
    writeJoints(paths, tree, frame, given, 0);
    for (const j of order) {
      const parent = parents[j];
      if (parent < 0) for (let k = 3 * j; k < 3 * j + 3; k++) places[k] = fitted[k] = given[k];
      else {
        turnVector(world, 9 * parent, offsets, 3 * j, fitted, 3 * j);
        for (let k = 0; k < 3; k++) fitted[3 * j + k] += fitted[3 * parent + k];
      }
      this.turn(j, parent);
      if (parent < 0) copy3(world, 9 * j, local, 0);
      else backMultiply3(world, 9 * parent, world, 9 * j, local, 0);
      quaternionOfRotation(local, 0, quaternion);
      for (let k = 0; k < 4; k++) rotations[4 * j + k] = quaternion[k];
      this.measure(j);
    }
  }

  /** Writes the rotation of a joint whose position and parent are known. */
  private turn(j: number, parent: number): void {
    const { world, offsets, children, given, fitted } = this;
    const own = children[j];
    if (own.length > 1) {
      products.fill(0);
      for (const child of own) {
        for (let k = 0; k < 3; k++) wanted[k] = given[3 * child + k] - fitted[3 * j + k];
        addProduct(wanted, 0, offsets, 3 * child, products);
      }
      // From the frame before.
      copy3(world, 9 * j, rotation, 0);
      if (parent < 0) nearestRotation(products, rotation, IDENTITY);
      else nearestRotation(products, rotation, world, 9 * parent);
      copy3(rotation, 0, world, 9 * j);
      return;
    }
    if (parent < 0) copy3(IDENTITY, 0, rotation, 0);
    else copy3(world, 9 * parent, rotation, 0);
    if (own.length === 0) {
      copy3(rotation, 0, world, 9 * j);
      return;
    }
    const [child] = own;
    for (let k = 0; k < 3; k++) wanted[k] = given[3 * child + k] - fitted[3 * j + k];
    turnVector(rotation, 0, offsets, 3 * child, aimed, 0);
    swing(aimed, 0, wanted, 0, turned, 0);
    multiply3(turned, 0, rotation, 0, world, 9 * j);
  }

  private measure(j: number): void {
    const { given, fitted } = this;
    const distance = length3(
      given[3 * j] - fitted[3 * j],
      given[3 * j + 1] - fitted[3 * j + 1],
      given[3 * j + 2] - fitted[3 * j + 2],
    );
    this.sum += distance;
    this.count++;
    this.largest = Math.max(this.largest, distance);
  }

  private offsetsOf(): Float64Array {
    const { tree, paths, children } = this;
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
    return offsets;
  }
}

function parentsFirst(children: readonly (readonly number[])[], parents: readonly number[]): readonly number[] {
  const order = parents.flatMap((parent, j) => (parent < 0 ? [j] : []));
  for (let i = 0; i < order.length; i++) order.push(...children[order[i]]);
  return order;
}

const IDENTITY = Float64Array.of(1, 0, 0, 0, 1, 0, 0, 0, 1);
/** Scratch; never escapes. */
const products = new Float64Array(9);
const rotation = new Float64Array(9);
const turned = new Float64Array(9);
const local = new Float64Array(9);
const wanted = new Float64Array(3);
const aimed = new Float64Array(3);
const quaternion = new Float64Array(4);
