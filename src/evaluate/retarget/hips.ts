/**
 * How hips follow feet. Legs of other proportions don't reach the places of their feet with the source's rotations.
 * Legs that bend for it point elsewhere; hips that move for it, by a few centimetres, are seen by nobody. So they are
 * where both feet on the ground are nearest to their places, and what is left is for the legs (`legs.ts`). In time they
 * move smoothly, whatever begins and ends under them:
 *
 *     moved(t) = Σ cₖ · B((t − tₖ) / h)        cₖ = Σ B · w · d  /  Σ B · w        over both feet, around tₖ
 *
 * with B the uniform cubic B-spline, d the way of a foot to its place by rotations alone, and w 1 in contact, nearly 0
 * in the air.
 */
import { riseAt, standing } from './contacts.ts';
import { wayOfFoot } from './places.ts';
import type { HipsTrack, RetargetPlan } from './plan.ts';
import { solveFreely } from './solve.ts';

/** Seconds between knots, and samples in one such time. */
const BETWEEN = 0.1;
const SAMPLES = 2;
const MAX_KNOTS = 6000;
/** A knot weighs samples that are nearer than two knots. */
const REACH = 2;
/** Weight of a foot in the air beside one that stands. */
const IN_THE_AIR = 0.01;

/** The track of a plan whose feet are known. */
export function hipsTrack(plan: RetargetPlan): HipsTrack {
  const [start, end] = plan.range;
  const spaces = Math.max(1, Math.min(MAX_KNOTS, Math.ceil((end - start) / BETWEEN)));
  const step = (end - start) / spaces || 1;
  // One more knot on either side.
  const count = spaces + 3;
  const knots = new Float64Array(3 * count);
  const weights = new Float64Array(count);
  const dofs = Float64Array.from(plan.restDofs);
  const way = new Float64Array(3);
  for (let i = 0; i <= SAMPLES * spaces; i++) {
    const at = i / SAMPLES;
    const seconds = start + at * step;
    solveFreely(plan, seconds, dofs);
    const rise = commonRise(plan, seconds);
    for (const foot of plan.feet) {
      wayOfFoot(plan, foot, seconds, rise, way);
      const stands = Math.max(IN_THE_AIR, standing(foot, seconds));
      for (let k = Math.max(0, Math.ceil(at + 1 - REACH)); k < Math.min(count, at + 1 + REACH); k++) {
        const weight = stands * cubic(at + 1 - k);
        weights[k] += weight;
        for (let c = 0; c < 3; c++) knots[3 * k + c] += weight * way[c];
      }
    }
  }
  for (let k = 0; k < count; k++) for (let c = 0; c < 3; c++) knots[3 * k + c] /= weights[k];
  return { start, step, knots };
}

/** Feet that stand too low lift the hips as far as they all do; a leg bends for what one alone stands lower. */
function commonRise({ feet }: RetargetPlan, seconds: number): number {
  const rises = feet.flatMap((foot) => (standing(foot, seconds) > 0 ? [riseAt(foot, seconds)] : []));
  return rises.length > 0 ? Math.min(...rises) : 0;
}

/** Writes how far the hips are moved at a time, x y z in the target's own axes and unit. */
export function hipsMovedAt({ start, step, knots }: HipsTrack, seconds: number, out: Float64Array): void {
  const last = knots.length / 3 - 2;
  const at = Math.min(last, Math.max(1, (seconds - start) / step + 1));
  out.fill(0);
  for (let k = Math.max(0, Math.ceil(at - REACH)); k <= Math.min(last + 1, at + REACH); k++) {
    const weight = cubic(at - k);
    for (let c = 0; c < 3; c++) out[c] += weight * knots[3 * k + c];
  }
}

/** The uniform cubic B-spline: 2/3 at 0, 0 from ±2 on. */
function cubic(x: number): number {
  const far = Math.abs(x);
  if (far >= REACH) return 0;
  return far < 1 ? 2 / 3 - far * far * (1 - far / 2) : (2 - far) ** 3 / 6;
}
