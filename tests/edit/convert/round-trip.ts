/** Positions of joints, on both sides of a conversion. */
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../../src/evaluate/pose.ts';
import type { Character } from '../../../src/model/document.ts';
import type { Capture } from '../../../src/model/files.ts';
import { filePose } from '../../../src/model/skeleton/dofs.ts';
import { character } from '../../helpers/builders.ts';

/** A character that plays the character's take. */
export function characterOf({ skeleton, take }: Capture): Character {
  return character({
    name: skeleton.name,
    skeleton,
    pose: filePose(skeleton, 0),
    takes: take ? [take] : [],
    shownTake: take ? 0 : -1,
  });
}

/** x y z of every joint at a time, each followed by its End Sites, stored as points or as joints. */
export function positionsAt(who: Character, seconds: number): readonly (readonly number[])[] {
  const { skeleton } = who;
  if (!skeleton) return [];
  const dofs = new Float64Array(dofCountOf(who));
  poseAt(who, seconds, dofs);
  const compiled = compileSkeleton(skeleton);
  const world = new Float64Array(16 * compiled.jointCount);
  worldMatrices(compiled, dofs, world);
  return skeleton.joints.flatMap(({ endSites }, j) => {
    const m = world.subarray(16 * j, 16 * j + 16);
    const at = ([x, y, z]: readonly number[]) =>
      [0, 1, 2].map((k) => m[k] * x + m[4 + k] * y + m[8 + k] * z + m[12 + k]);
    return [at([0, 0, 0]), ...(endSites ?? []).map(at)];
  });
}

/** The longest side of the box around the joints as the skeleton's file poses them. */
export function heightOf({ skeleton }: Capture): number {
  const points = positionsAt({ ...characterOf({ skeleton }), pose: filePose(skeleton, 0) }, 0);
  return Math.max(...[0, 1, 2].map((k) => Math.max(...points.map((p) => p[k])) - Math.min(...points.map((p) => p[k]))));
}

/** The largest distance between the joints of two characters at the given times. */
export function worstDistance(a: Character, b: Character, seconds: readonly number[]): number {
  let worst = 0;
  for (const time of seconds) {
    const [here, there] = [positionsAt(a, time), positionsAt(b, time)];
    if (here.length !== there.length) return Number.POSITIVE_INFINITY;
    here.forEach((p, j) => {
      worst = Math.max(worst, Math.hypot(...p.map((v, k) => v - there[j][k])));
    });
  }
  return worst;
}

/** The times of a take's frames; only frame 0 if it has none. */
export function frameTimes({ take }: Capture): readonly number[] {
  const samples = take?.samples;
  if (!samples) return [0];
  return Array.from({ length: samples.frameCount }, (_, f) => samples.startSeconds + f * samples.frameSeconds);
}
