/**
 * Removes what thinning has left that nothing needs: first whole channels, which become what they were, then single
 * keys.
 *
 * Thinning (`bake.ts`) judges each curve by its own tolerance, the same along all of it. Here the joints and pins
 * themselves are measured, at all frames and halfway between, so that keys remain only where without them something
 * would slide or leave the held pose.
 */
import { pointAt } from '../../evaluate/ik/set-up.ts';
import { compileSkeleton, worldMatrices } from '../../evaluate/kinematics.ts';
import { dofCountOf, poseFrom, poseSource } from '../../evaluate/pose.ts';
import type { Steps } from '../../evaluate/steps.ts';
import { quaternionDofs } from '../../model/skeleton/joint-types.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import type { Take } from '../../model/takes/take.ts';
import { withKeysRemoved } from '../keys/remove.ts';
import { withTake } from '../takes.ts';
import type { Holding } from './held-frames.ts';
import { type MeasuredPoint, measuredPoints, withHalves } from './measure.ts';
import type { HoldWindow } from './window.ts';

/** Keys on either side of a removed one whose slopes may depend on it, with the spans beyond them. */
const AFFECTED = 2;

/**
 * Removes keys that a hold doesn't need; yields its progress.
 * @param takes `original`: the take before the hold; `dense`: with a key on every frame; `thin`: the same with fewer
 *   keys
 * @param changed channels that differ from the original
 * @param tolerance from the dense take, and of pins from their targets while they are held; lengths
 */
export function* pruning(
  holding: Holding,
  { original, dense, thin }: { readonly [take in 'original' | 'dense' | 'thin']: Take },
  window: HoldWindow,
  changed: readonly number[],
  tolerance: number,
): Steps<Take> {
  const measure = new Measure(holding, window, dense, tolerance);
  const [from, to] = [window.times[0], window.times[window.times.length - 1]];
  let take = thin;
  const isKept = (channel: number, by: Take['channels'][number], range: readonly [number, number]) => {
    const channels = [...take.channels];
    channels[channel] = by;
    const pruned = { ...take, channels };
    if (!measure.isWithin(pruned, range)) return false;
    take = pruned;
    return true;
  };
  const keyed = changed.filter((channel) => take.channels[channel].kind === 'keys');
  const isWhole = partsOfQuaternions(holding.skeleton);
  for (const [c, channel] of keyed.entries()) {
    yield c / keyed.length;
    // The other components would no longer fit.
    if (!isWhole.has(channel) && isKept(channel, original.channels[channel], [from, to])) continue;
    for (let k = 1; ; k++) {
      const own = take.channels[channel];
      if (own.kind !== 'keys' || k + 1 >= own.times.length) break;
      const { times } = own;
      // The outer keys lead over to the curve outside.
      if (times[k] <= from || times[k] >= to) continue;
      const span = [times[Math.max(0, k - AFFECTED)], times[Math.min(times.length - 1, k + AFFECTED)]] as const;
      if (isKept(channel, withKeysRemoved(own, [k]), span)) k--;
      yield c / keyed.length;
    }
  }
  return take;
}

/** The DOFs that are components of quaternions. */
function partsOfQuaternions(skeleton: Skeleton): ReadonlySet<number> {
  const { firstDof } = compileSkeleton(skeleton);
  return new Set(skeleton.joints.flatMap(({ motion }, j) => quaternionDofs(motion).map((d) => firstDof[j] + d)));
}

/** Compares takes with the dense one. */
class Measure {
  private readonly times: Float64Array;
  private readonly points: readonly MeasuredPoint[];
  /** Where they must be: x y z each, for each time. */
  private readonly places: Float64Array;
  private readonly dofs: Float64Array;
  private readonly world: Float64Array;

  constructor(
    private readonly holding: Holding,
    { times, firstHeld, lastHeld }: HoldWindow,
    dense: Take,
    private readonly tolerance: number,
  ) {
    const { character, skeleton, pins, targets } = holding;
    this.times = withHalves(times);
    this.points = measuredPoints(skeleton, pins);
    this.dofs = new Float64Array(dofCountOf(character));
    this.world = new Float64Array(16 * skeleton.joints.length);
    this.places = new Float64Array(3 * this.points.length * this.times.length);
    const source = this.sourceOf(dense);
    for (let f = 0; f < this.times.length; f++) {
      this.pose(source, f);
      const isHeld = f >= 2 * firstHeld && f <= 2 * lastHeld;
      this.points.forEach(({ joint, point, pin }, p) => {
        const place = isHeld && pin !== undefined ? targets[pin].position : pointAt(this.world, joint, point);
        this.places.set(place, 3 * (f * this.points.length + p));
      });
    }
  }

  /** Whether everything stays within the tolerance over a range, seconds of the take. */
  isWithin(take: Take, [from, to]: readonly [number, number]): boolean {
    const { times, places, points, tolerance } = this;
    const source = this.sourceOf(take);
    for (let f = 0; f < times.length; f++) {
      if (times[f] < from || times[f] > to) continue;
      this.pose(source, f);
      for (let p = 0; p < points.length; p++) {
        const [x, y, z] = pointAt(this.world, points[p].joint, points[p].point);
        const o = 3 * (f * points.length + p);
        if (Math.hypot(x - places[o], y - places[o + 1], z - places[o + 2]) > tolerance) return false;
      }
    }
    return true;
  }

  private sourceOf(take: Take) {
    const { character } = this.holding;
    return poseSource(withTake(character, character.shownTake, take));
  }

  private pose(source: ReturnType<typeof poseSource>, f: number): void {
    const { character, skeleton } = this.holding;
    poseFrom(source, this.times[f] - character.timeOffsetSeconds, this.dofs);
    worldMatrices(compileSkeleton(skeleton), this.dofs, this.world);
  }
}
