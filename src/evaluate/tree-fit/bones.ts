/** Bones of a tree whose joints are given by their positions: how long they are, and which tree they are those of. */
import { length3 } from '../../math/vec3.ts';
import type { JointTree } from './known-trees.ts';
import { type JointFrameSet, type PointPaths, someFrames } from './point-paths.ts';

/** Frames that lengths are measured in. */
const MEASURED = 8192;

/** The frames that a tree is measured in. */
export function measuredFrames(paths: PointPaths, tree: JointTree): JointFrameSet {
  return someFrames(paths, tree, MEASURED);
}

/** The median length of the bone from each joint's parent to it; 0 of a root. */
export function boneLengths({ parents }: JointTree, frames: JointFrameSet): Float64Array {
  const lengths = new Float64Array(frames.count);
  return Float64Array.from(parents, (parent, j) => {
    if (parent < 0) return 0;
    writeLengths(frames, parents.length, j, parent, lengths);
    return median(lengths);
  });
}

/** The tree whose bones vary least in length, of some. @throws Error without any */
export function steadiestTree(paths: PointPaths, trees: readonly JointTree[]): JointTree {
  if (trees.length === 1) return trees[0];
  const varied = trees.map((tree) => ({ tree, variation: variation(tree, measuredFrames(paths, tree)) }));
  return varied.reduce((best, one) => (one.variation < best.variation ? one : best)).tree;
}

/** The mean over the bones of the deviation of their lengths, each by its mean length. */
function variation({ parents }: JointTree, frames: JointFrameSet): number {
  const lengths = new Float64Array(frames.count);
  let [sum, count] = [0, 0];
  parents.forEach((parent, j) => {
    if (parent < 0) return;
    writeLengths(frames, parents.length, j, parent, lengths);
    let total = 0;
    for (const length of lengths) total += length;
    const mean = total / lengths.length;
    let squares = 0;
    for (const length of lengths) squares += (length - mean) * (length - mean);
    if (mean > 0) sum += Math.sqrt(squares / lengths.length) / mean;
    count++;
  });
  return sum / Math.max(1, count);
}

function writeLengths({ count, positions }: JointFrameSet, joints: number, a: number, b: number, out: Float64Array) {
  for (let i = 0; i < count; i++) {
    const [p, q] = [3 * (i * joints + a), 3 * (i * joints + b)];
    out[i] = length3(
      positions[p] - positions[q],
      positions[p + 1] - positions[q + 1],
      positions[p + 2] - positions[q + 2],
    );
  }
}

/** Changes the order of the values. Of an even number it is the mean of the two in the middle. */
export function median(values: Float64Array): number {
  const half = values.length >> 1;
  const upper = selected(values, half);
  if (values.length % 2) return upper;
  let lower = values[0];
  for (let i = 1; i < half; i++) lower = Math.max(lower, values[i]);
  return (lower + upper) / 2;
}

/** The value that would be at an index if they were sorted: those before it are no larger then (Hoare's selection). */
function selected(values: Float64Array, index: number): number {
  let [low, high] = [0, values.length - 1];
  while (low < high) {
    const pivot = values[(low + high) >> 1];
    let [i, j] = [low, high];
    while (i <= j) {
      while (values[i] < pivot) i++;
      while (values[j] > pivot) j--;
      if (i > j) break;
      const value = values[i];
      values[i++] = values[j];
      values[j--] = value;
    }
    if (index <= j) high = j;
    else if (index >= i) low = i;
    else break;
  }
  return values[index];
}
