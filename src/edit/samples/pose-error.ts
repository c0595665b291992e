/**
 * Compares two takes of one skeleton: the largest distance in world position, and the largest angle between world
 * rotations, for each joint over all frames.
 *
 *     distance     |p − p′| of the joint's origin, and of its End Sites
 *     angle        2·asin(‖R − R′‖ / 2√2), ‖·‖ the root of the sum of squares
 *
 * World is the character's own space, before its placement, without limits.
 */

import { compileSkeleton, worldMatrices } from '../../evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../evaluate/pose.ts';
import type { Steps } from '../../evaluate/steps.ts';
import type { Character } from '../../model/document.ts';
import type { Samples } from '../../model/takes/samples.ts';
import type { Take } from '../../model/takes/take.ts';
import { takeAlone } from './take-alone.ts';

/** By joint. */
export interface PoseErrors {
  /** Lengths of the file. */
  readonly distances: Float64Array;
  /** Radians. */
  readonly angles: Float64Array;
  /** The frames in which these occur. */
  readonly distanceFrames: Int32Array;
  readonly angleFrames: Int32Array;
}

/** Frames between two yields. */
const SLICE_FRAMES = 64;

/** Compares every frame of the samples, yielding progress. */
export function* measuringPoses(
  character: Character,
  before: Take,
  after: Take,
  { frameCount, startSeconds, frameSeconds }: Samples,
): Steps<PoseErrors> {
  const { skeleton } = character;
  const count = dofCountOf(character);
  const jointCount = skeleton?.joints.length ?? 0;
  const errors: PoseErrors = {
    distances: new Float64Array(jointCount),
    angles: new Float64Array(jointCount),
    distanceFrames: new Int32Array(jointCount),
    angleFrames: new Int32Array(jointCount),
  };
  if (!skeleton) return errors;
  const compiled = compileSkeleton(skeleton);
  const [a, b] = [takeAlone(character, before), takeAlone(character, after)];
  const dofs = new Float64Array(count);
  const [worldA, worldB] = [new Float64Array(16 * jointCount), new Float64Array(16 * jointCount)];
  const sites = skeleton.joints.map(({ endSites = [] }) => endSites);
  for (let f = 0; f < frameCount; f++) {
    const time = startSeconds + f * frameSeconds;
    poseAt(a, time, dofs);
    worldMatrices(compiled, dofs, worldA);
    poseAt(b, time, dofs);
    worldMatrices(compiled, dofs, worldB);
    for (let j = 0; j < jointCount; j++) {
      const o = 16 * j;
      let turn = 0;
      for (let n = o; n < o + 11; n++) turn += (worldA[n] - worldB[n]) ** 2;
      let distance = apart(worldA, worldB, o, 0, 0, 0);
      for (const [x, y, z] of sites[j]) distance = Math.max(distance, apart(worldA, worldB, o, x, y, z));
      if (distance > errors.distances[j]) {
        errors.distances[j] = distance;
        errors.distanceFrames[j] = f;
      }
      // Squared until the end.
      if (turn > errors.angles[j]) {
        errors.angles[j] = turn;
        errors.angleFrames[j] = f;
      }
    }
    if (f % SLICE_FRAMES === SLICE_FRAMES - 1) yield f / frameCount;
  }
  for (let j = 0; j < jointCount; j++) {
    errors.angles[j] = 2 * Math.asin(Math.min(1, Math.sqrt(errors.angles[j] / 8)));
    errors.distances[j] = Math.sqrt(errors.distances[j]);
  }
  return errors;
}

/** Squared distance of a point transformed by two matrices. */
function apart(a: Float64Array, b: Float64Array, o: number, x: number, y: number, z: number): number {
  let sum = 0;
  for (let r = o; r < o + 3; r++) {
    const d = (a[r] - b[r]) * x + (a[r + 4] - b[r + 4]) * y + (a[r + 8] - b[r + 8]) * z + (a[r + 12] - b[r + 12]);
    sum += d * d;
  }
  return sum;
}
