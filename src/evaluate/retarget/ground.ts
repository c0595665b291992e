/**
 * How high the target moves: its soles are as high above the ground as the source's, times the scale.
 *
 * Neither file pose nor joints tell where soles are: file pose may be folded flat, and ankles are 4 to 12 cm above the
 * ground. So both are measured while the take plays, on the poses that rotations alone give. A sole is the lowest of
 * the foot's joints and End Sites. The ground is the scene's on both sides: a take that its space puts too high stays
 * so.
 */

import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import type { Space } from '../../model/space.ts';
import type { Bodies } from './align.ts';
import type { RetargetBody } from './body.ts';
import type { RetargetPlan, SpaceRule } from './plan.ts';
import { solveFreely } from './solve.ts';

/** Points of one foot that may touch the ground. */
export interface Sole {
  /** A joint, and a point in its space, x y z. */
  readonly joints: Int32Array;
  readonly points: Float64Array;
  /** How much lower than these points the foot ends; metres. */
  readonly depth: number;
}

/** A character whose lowest point is within these fractions of its height around the scene's ground stands on it. */
const BELOW = 0.01;
const ABOVE = 0.1;

/**
 * The sole of one foot: the points below the ankle that may touch the ground.
 * @param rest the skeleton in its file pose: without a space of its own it may stand on the ground with its skin, so
 *   that its joints don't reach it
 */
export function soleOf(skeleton: Skeleton, space: Space | undefined, rest: RetargetBody, ankle: number): Sole {
  const joints: number[] = [];
  const points: number[] = [];
  const below = new Set([ankle]);
  skeleton.joints.forEach(({ parent, endSites }, j) => {
    if (j !== ankle && !below.has(parent)) return;
    below.add(j);
    joints.push(j);
    points.push(0, 0, 0);
    for (const end of endSites ?? []) {
      joints.push(j);
      points.push(...end);
    }
  });
  const ys = rest.points.filter((_, i) => i % 3 === 1);
  const low = Math.min(...ys);
  const height = Math.max(...ys) - low;
  const stands = !space && low > -BELOW * height && low < ABOVE * height;
  return { joints: Int32Array.from(joints), points: Float64Array.from(points), depth: stands ? low : 0 };
}

/** Height of the sole in the scene, metres. */
export function soleHeight({ joints, points, depth }: Sole, world: Float64Array, rule: SpaceRule): number {
  const [a, b, c] = [rule.up[1], rule.up[4], rule.up[7]];
  let low = Infinity;
  for (let i = 0; i < joints.length; i++) {
    const o = 16 * joints[i];
    let height = a * world[o + 12] + b * world[o + 13] + c * world[o + 14];
    for (let k = 0; k < 3; k++) {
      const m = o + 4 * k;
      height += points[3 * i + k] * (a * world[m] + b * world[m + 1] + c * world[m + 2]);
    }
    low = Math.min(low, height);
  }
  return rule.metres * low + rule.lift - depth;
}

/** The sole of a foot and that of the foot it follows. */
export interface Soles {
  readonly own: Sole;
  readonly source: Sole;
}

/** Number of times examined, evenly over the take, and the fraction of them that counts: those with the lowest feet. */
const MOMENTS = 128;
const LOWEST = 0.25;

/** How much too low the soles of a plan without a shift are when no foot ever touches the ground: at its lowest. */
export function depthOfLowest(plan: RetargetPlan, soles: readonly Soles[]): number {
  const [start, end] = plan.range;
  const dofs = Float64Array.from(plan.restDofs);
  const count = end > start ? MOMENTS : 1;
  const moments = Array.from({ length: count }, (_, i) => {
    solveFreely(plan, start + ((end - start) * i) / Math.max(1, count - 1), dofs);
    const feet = soles.map(({ own, source }) => {
      const height = soleHeight(source, plan.sourceWorld, plan.sourceSpace);
      return { height, off: plan.scale * height - soleHeight(own, plan.targetWorld, plan.targetSpace) };
    });
    return feet.reduce((a, b) => (b.height < a.height ? b : a));
  });
  moments.sort((a, b) => a.height - b.height);
  return median(moments.slice(0, Math.max(1, Math.round(LOWEST * count))).map(({ off }) => off));
}

/** The middle one of the sorted values, the upper of two; 0 without values. */
export function median(values: readonly number[]): number {
  return [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)] ?? 0;
}

/** Without legs: by the hips, from their position in the reference pose to that at rest. */
export function shiftOfHips(plan: RetargetPlan, { rest, sourceOf }: Bodies, reference: RetargetBody): number {
  const [joint] = plan.carried;
  if (joint === undefined) return 0;
  return rest.points[3 * joint + 1] - plan.scale * reference.points[3 * sourceOf[joint] + 1];
}
