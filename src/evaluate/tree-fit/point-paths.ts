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

/** Makes what writes x y z of each joint of a tree in a frame, from `out[o]`. */
export function jointsWriter(
  { values, width, pointCount }: PointPaths,
  { points }: JointTree,
): (frame: number, out: Float64Array, o: number) => void {
  const firsts = Int32Array.from(points, ([first]) => width * first);
  const seconds = Int32Array.from(points, ([first, second = first]) => width * second);
  return (frame, out, o) => {
    const from = frame * pointCount * width;
    for (let j = 0, at = o; j < firsts.length; j++, at += 3) {
      const a = from + firsts[j];
      const b = from + seconds[j];
      if (a === b) {
        out[at] = values[a];
        out[at + 1] = values[a + 1];
        out[at + 2] = values[a + 2];
        continue;
      }
      out[at] = (values[a] + values[b]) / 2;
      out[at + 1] = (values[a + 1] + values[b + 1]) / 2;
      out[at + 2] = (values[a + 2] + values[b + 2]) / 2;
    }
  };
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
  const write = jointsWriter(paths, tree);
  for (let i = 0; i < count; i++) write(Math.floor((i * paths.frameCount) / count), positions, i * width);
  return { count, positions };
}
