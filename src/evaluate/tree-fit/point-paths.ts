/** Positions of the joints of a tree over time, from those of points. */
import type { JointTree } from './known-trees.ts';

/** Points over time: x y z of each in each frame, all finite. */
export interface PointPaths {
  readonly frameCount: number;
  readonly pointCount: number;
  /** Frame by frame. */
  readonly values: ArrayLike<number>;
  /** Numbers of a point: 3, or more of which the first 3 are its position. */
  readonly width: number;
}

/** Writes x y z of each joint of a tree in a frame, from `out[o]`. */
export function writeJoints(
  paths: PointPaths,
  { points }: JointTree,
  frame: number,
  out: Float64Array,
  o: number,
): void {
  const { values, width, pointCount } = paths;
  const from = frame * pointCount * width;
  for (let j = 0; j < points.length; j++) {
    const [first, second] = points[j];
    const a = from + first * width;
    const at = o + 3 * j;
    if (second === undefined) {
      out[at] = values[a];
      out[at + 1] = values[a + 1];
      out[at + 2] = values[a + 2];
      continue;
    }
    const b = from + second * width;
    out[at] = (values[a] + values[b]) / 2;
    out[at + 1] = (values[a + 1] + values[b + 1]) / 2;
    out[at + 2] = (values[a + 2] + values[b + 2]) / 2;
  }
}

/** The joints of some frames, evenly chosen, one after the other: 3 numbers of each joint. */
export interface JointFrameSet {
  readonly count: number;
  readonly positions: Float64Array;
}

/** As many frames as there are, at most so many, the first among them. */
export function someFrames(paths: PointPaths, tree: JointTree, most: number): JointFrameSet {
  const count = Math.min(paths.frameCount, most);
  const width = 3 * tree.names.length;
  const positions = new Float64Array(count * width);
  for (let i = 0; i < count; i++) {
    writeJoints(paths, tree, Math.floor((i * paths.frameCount) / count), positions, i * width);
  }
  return { count, positions };
}
