/**
 * Motion capture from rotations: joints as a `.bvh` has them, turned by angles about z, y and x, of which each frame is
 * near the one before.
 */
import { RADIANS_PER_DEGREE } from '../math/degrees.ts';
import { eulerNear, turnEuler } from '../math/euler.ts';
import type { Vec3 } from '../math/vec3.ts';
import type { Capture } from '../model/files.ts';
import { type BvhChannel, type Joint, NO_BOX, UNLIMITED } from '../model/skeleton/skeleton.ts';
import { rangeOfSamples, type Samples } from '../model/takes/samples.ts';
import { SAMPLED } from '../model/takes/take.ts';

/** Joints in any order, that of the numbers of their frames. */
export interface FrameJoints {
  readonly names: readonly string[];
  /** Index of each parent; -1 for a root. They must be trees. */
  readonly parents: ArrayLike<number>;
  /** x y z each: where a joint is in its parent's space, at rest. */
  readonly offsets: ArrayLike<number>;
  /** Whether a joint moves in its parent's space: it gets position channels. */
  readonly moves: readonly boolean[];
  /** Ends of bones in the spaces of their joints, by the index of the joint. */
  readonly endSites?: ReadonlyMap<number, readonly Vec3[]>;
}

/** The frames of such joints. */
export interface JointFrames {
  readonly frameCount: number;
  readonly framesPerSecond: number;
  /**
   * Writes a frame; they are asked for in order.
   * @param rotations x y z w of each joint, in its parent's space
   * @param places x y z of each joint in its parent's space; those of joints that don't move are ignored
   */
  write(frame: number, rotations: Float64Array, places: Float64Array): void;
}

const TURNS: readonly BvhChannel[] = ['rz', 'ry', 'rx'];
const MOVES: readonly BvhChannel[] = ['tx', 'ty', 'tz', ...TURNS];
/** Degrees per radian. */
const DEGREES = 180 / Math.PI;
/** Frames after which angles are found anew: those in between are found by what has changed, which adds up. */
const EXACT = 64;

/** The roots of the joints, each with all below it and the motion of it, depth first. @param name of skeleton and take */
export function capturesOfFrames(name: string, joints: FrameJoints, frames: JointFrames): readonly Capture[] {
  const trees = depthFirst(joints.parents, joints.names.length);
  const order = trees.flat();
  const values = valuesOf(joints, frames, order);
  const widthOf = (tree: readonly number[]) => tree.reduce((sum, j) => sum + (joints.moves[j] ? 6 : 3), 0);
  const width = widthOf(order);
  let from = 0;
  return trees.map((tree) => {
    const own = trees.length === 1 ? name : `${name} ${joints.names[tree[0]]}`;
    const count = widthOf(tree);
    const columns = count === width ? values : columnsOf(values, frames.frameCount, width, from, count);
    from += count;
    const samples: Samples = {
      frameCount: frames.frameCount,
      frameSeconds: 1 / frames.framesPerSecond,
      startSeconds: 0,
      firstChannel: 0,
      values: columns,
      scales: Float64Array.from(tree.flatMap((j) => (joints.moves[j] ? MOVE_SCALES : TURN_SCALES))),
      interpolation: 'linear',
    };
    return {
      skeleton: { name: own, joints: jointsOf(joints, tree) },
      take: {
        name: own,
        range: rangeOfSamples(samples),
        channels: Array.from({ length: count }, () => SAMPLED),
        samples,
      },
    };
  });
}

const TURN_SCALES = TURNS.map(() => RADIANS_PER_DEGREE);
const MOVE_SCALES = [1, 1, 1, ...TURN_SCALES];

function jointsOf(
  { names, parents, offsets, moves, endSites }: FrameJoints,
  tree: readonly number[],
): readonly Joint[] {
  const index = new Map(tree.map((j, i) => [j, i]));
  return tree.map((j): Joint => {
    const offset: Vec3 = [offsets[3 * j], offsets[3 * j + 1], offsets[3 * j + 2]];
    const channels = moves[j] ? MOVES : TURNS;
    const ends = endSites?.get(j);
    return {
      name: names[j],
      parent: index.get(parents[j]) ?? -1,
      offset,
      box: NO_BOX,
      motion: { kind: 'bvh', channels, positions: 'replace' },
      limits: channels.map(() => UNLIMITED),
      pose: moves[j] ? [...offset, 0, 0, 0] : [0, 0, 0],
      ...(ends && { endSites: ends }),
    };
  });
}

/** A row a frame, of the channels of all joints in that order; degrees and lengths. */
function valuesOf({ names, moves }: FrameJoints, frames: JointFrames, order: readonly number[]): Float64Array {
  const count = names.length;
  const width = order.reduce((sum, j) => sum + (moves[j] ? 6 : 3), 0);
  const values = new Float64Array(frames.frameCount * width);
  const places = new Float64Array(3 * count);
  const angles = new Float64Array(3 * count);
  const [even, odd] = [new Float64Array(4 * count), new Float64Array(4 * count)];
  const joints = Int32Array.from(order);
  const hasPlace = Uint8Array.from(moves, Number);
  let at = 0;
  for (let frame = 0; frame < frames.frameCount; frame++) {
    const q = frame % 2 ? odd : even;
    const p = frame % 2 ? even : odd;
    frames.write(frame, q, places);
    const isExact = frame % EXACT === 0;
    for (let i = 0; i < count; i++) {
      const j = joints[i];
      const a = 3 * j;
      const o = 4 * j;
      // Most joints of hands rest all the time.
      const rests =
        frame > 0 && q[o] === p[o] && q[o + 1] === p[o + 1] && q[o + 2] === p[o + 2] && q[o + 3] === p[o + 3];
      if (!rests && (isExact || !turnEuler(p, o, q, o, angles, a))) eulerNear(q, angles, a, o);
      if (hasPlace[j]) {
        values[at++] = places[a];
        values[at++] = places[a + 1];
        values[at++] = places[a + 2];
      }
      values[at++] = angles[a + 2] * DEGREES;
      values[at++] = angles[a + 1] * DEGREES;
      values[at++] = angles[a] * DEGREES;
    }
  }
  return values;
}

function columnsOf(values: Float64Array, frameCount: number, width: number, from: number, count: number): Float64Array {
  const own = new Float64Array(frameCount * count);
  for (let frame = 0; frame < frameCount; frame++) {
    const at = frame * width + from;
    own.set(values.subarray(at, at + count), frame * count);
  }
  return own;
}

/** Indices of the joints of each root, parents before their children, which keep their order. */
function depthFirst(parents: ArrayLike<number>, count: number): readonly (readonly number[])[] {
  const children = Array.from({ length: count }, (): number[] => []);
  const roots: number[] = [];
  for (let j = count - 1; j >= 0; j--) (parents[j] < 0 ? roots : children[parents[j]]).push(j);
  return roots.reverse().map((root) => {
    const tree: number[] = [];
    const open = [root];
    for (let next = open.pop(); next !== undefined; next = open.pop()) {
      tree.push(next);
      open.push(...children[next]);
    }
    return tree;
  });
}

/** Whether parents are those of trees: of other joints, and nobody's own descendants. */
export function areTrees(parents: ArrayLike<number>): boolean {
  for (let j = 0; j < parents.length; j++) {
    if (!Number.isInteger(parents[j]) || parents[j] >= parents.length) return false;
  }
  return depthFirst(parents, parents.length).reduce((sum, tree) => sum + tree.length, 0) === parents.length;
}
