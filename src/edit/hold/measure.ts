/** Measures joints and pins during a hold, to judge its result. */
import { type PinTarget, pointAt, reachOfSkeleton } from '../../evaluate/ik/set-up.ts';
import { compileSkeleton, worldMatrices } from '../../evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../evaluate/pose.ts';
import { type Vec3, ZERO } from '../../math/vec3.ts';
import type { Character } from '../../model/document.ts';
import type { Pin } from '../../model/ik.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import type { Take } from '../../model/takes/take.ts';
import { withTake } from '../takes.ts';

/** Calls back with a character's world matrices at each of the times, seconds of the take; the array is reused. */
function eachPose(
  character: Character,
  skeleton: Skeleton,
  times: Float64Array,
  see: (world: Float64Array, at: number) => void,
): void {
  const compiled = compileSkeleton(skeleton);
  const dofs = new Float64Array(dofCountOf(character));
  const world = new Float64Array(16 * compiled.jointCount);
  for (let f = 0; f < times.length; f++) {
    poseAt(character, times[f] - character.timeOffsetSeconds, dofs);
    worldMatrices(compiled, dofs, world);
    see(world, f);
  }
}

/** The times and their midpoints. */
export function withHalves(times: Float64Array): Float64Array {
  const out = new Float64Array(Math.max(0, 2 * times.length - 1));
  for (let i = 0; i < out.length; i++) {
    const f = i >> 1;
    out[i] = i % 2 === 0 ? times[f] : times[f] + (times[f + 1] - times[f]) / 2;
  }
  return out;
}

/** By pin, its point's largest distance from the target over these times; the character's lengths. */
export function slides(
  character: Character,
  skeleton: Skeleton,
  pins: readonly Pin[],
  targets: readonly PinTarget[],
  times: Float64Array,
): number[] {
  const worst = pins.map(() => 0);
  eachPose(character, skeleton, times, (world) => {
    pins.forEach(({ joint, point }, p) => {
      const [x, y, z] = pointAt(world, joint, point);
      const [tx, ty, tz] = targets[p].position;
      worst[p] = Math.max(worst[p], Math.hypot(x - tx, y - ty, z - tz));
    });
  });
  return worst;
}

/** A point that a hold must not move without need. */
export interface MeasuredPoint {
  readonly joint: number;
  /** In the joint's space. */
  readonly point: Vec3;
  /** Index of the pin whose point it is, if any. */
  readonly pin?: number;
}

/**
 * Length of the arms that show a held orientation; fraction of the reach. With the default tolerance it is kept within
 * a quarter of a degree.
 */
const ARM = 0.25;

/** The origin of each joint, the point of each pin, and three more around it if the pin holds the orientation. */
export function measuredPoints(skeleton: Skeleton, pins: readonly Pin[]): readonly MeasuredPoint[] {
  const arm = armOf(skeleton);
  return [
    ...skeleton.joints.map((_, joint) => ({ joint, point: ZERO })),
    ...pins.map(({ joint, point }, pin) => ({ joint, point, pin })),
    ...pins.flatMap(({ joint, point: [x, y, z], holdsOrientation }) => {
      const ends: readonly Vec3[] = [
        [x + arm, y, z],
        [x, y + arm, z],
        [x, y, z + arm],
      ];
      return holdsOrientation ? ends.map((point) => ({ joint, point })) : [];
    }),
  ];
}

/**
 * The length of the lever by which a rotation is compared with a displacement, in lengths: a fixed part of the
 * skeleton's reach.
 */
export function armOf(skeleton: Skeleton): number {
  return ARM * reachOfSkeleton(skeleton);
}

/** By joint, the distance between its positions in two takes of a character, its measured points included. */
export function distances(
  character: Character,
  skeleton: Skeleton,
  pins: readonly Pin[],
  [a, b]: readonly [Take, Take],
  times: Float64Array,
): Float64Array {
  const points = measuredPoints(skeleton, pins);
  const seen = new Float64Array(3 * points.length * times.length);
  const worst = new Float64Array(skeleton.joints.length);
  eachPose(withTake(character, character.shownTake, a), skeleton, times, (world, f) => {
    points.forEach(({ joint, point }, i) => {
      seen.set(pointAt(world, joint, point), 3 * (f * points.length + i));
    });
  });
  eachPose(withTake(character, character.shownTake, b), skeleton, times, (world, f) => {
    points.forEach(({ joint, point }, i) => {
      const o = 3 * (f * points.length + i);
      const [x, y, z] = pointAt(world, joint, point);
      worst[joint] = Math.max(worst[joint], Math.hypot(x - seen[o], y - seen[o + 1], z - seen[o + 2]));
    });
  });
  return worst;
}
