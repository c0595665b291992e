/** Joints that are given by their positions alone, as joints with bones: fitted, and how well is said. */
import type { FrameJoints, JointFrames } from '../evaluate/captured-frames.ts';
import { FittedTree } from '../evaluate/tree-fit/fit-tree.ts';
import type { JointTree } from '../evaluate/tree-fit/known-trees.ts';
import type { PointPaths } from '../evaluate/tree-fit/point-paths.ts';
import type { Remarks } from './imported.ts';

/** Joints, their frames, and what there is to say once all frames are written. */
export interface Fitted {
  readonly joints: FrameJoints;
  readonly frames: JointFrames;
  /** Whether y points down, as in pictures. */
  readonly isDown: boolean;
  told(): void;
}

/** Bones of a tree for points; the frames are found as they are written. */
export function fitted(paths: PointPaths, tree: JointTree, framesPerSecond: number, remarks: Remarks): Fitted {
  const fit = new FittedTree(paths, tree);
  const { frameCount } = paths;
  return {
    joints: fit.joints,
    isDown: fit.up?.axis === 1 && fit.up.sign < 0,
    frames: { frameCount, framesPerSecond, write: (frame, rotations, places) => fit.write(frame, rotations, places) },
    told() {
      const [mean, largest] = [fit.meanDistance, fit.largestDistance].map((v) => Number(v.toPrecision(3)));
      const message = `Bones of constant length are fitted to the positions: joints are ${mean} off on average, at most ${largest}, in the file’s unit.`;
      remarks.tell('bones-fitted', message, 'used the median lengths');
      if (fit.meanDistance <= MAX_DISTANCE * longestChain(fit.joints)) return;
      const doubt =
        'Joints are farther from a body of bones than noise puts them. Numbers of a network are often normalised: times the standard deviation, plus the mean, they are positions again.';
      remarks.warn('bones-doubtful', doubt, 'used as they are');
    },
  };
}

/** Part of the length of the longest chain of bones. Recorded points are off by less than half of it, normalised ones by more. */
const MAX_DISTANCE = 0.03;

function longestChain({ parents, offsets }: FrameJoints): number {
  const lengths = new Float64Array(parents.length);
  for (let j = 0; j < parents.length; j++) {
    if (parents[j] < 0) continue;
    lengths[j] = lengths[parents[j]] + Math.hypot(offsets[3 * j], offsets[3 * j + 1], offsets[3 * j + 2]);
  }
  return Math.max(...lengths);
}
