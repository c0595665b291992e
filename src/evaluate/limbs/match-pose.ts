/** The goals of limbs that a pose reaches, for posing in IK and for switching to it. */
import { type Character, shownTake } from '../../model/document.ts';
import type { LimbMatch } from '../../model/limbs.ts';
import { perObject } from '../../model/per-object.ts';
import type { Goal, Goals } from '../../model/takes/take.ts';
import { worldMatrices } from '../kinematics.ts';
import { dofCountOf, poseAt, shownUnkeyed } from '../pose.ts';
import { writeAnglesNear, writeQuaternion } from '../rotations/euler-orders.ts';
import { matchOf } from './match.ts';
import { spaceJointAt, takeLimbs } from './over-pose.ts';
import { RX } from './target.ts';

/** A goal's values for a pose. */
export interface PoseMatch extends LimbMatch {
  /** Whether the limb has a closed form, and so a pole. */
  readonly bends: boolean;
  /** The DOFs that IK sets. */
  readonly led: readonly number[];
  /** What the goal's channels have at that time: 11 numbers. */
  readonly values: readonly number[];
}

/**
 * Matches goals to a pose, by the limb's name: its angles are those nearest to the goal's own. Goals that are not
 * reached, for want of a limb or a joint, are left out.
 *
 * @param goals of the shown take, or others in their place
 * @param timeSeconds of the transport
 * @param pose of all DOFs, as it is displayed
 */
export function matchPose(
  character: Character,
  goals: readonly Goal[],
  timeSeconds: number,
  pose: Float64Array,
): ReadonlyMap<string, PoseMatch> {
  const { skeleton, limbs, timeOffsetSeconds } = character;
  const found = new Map<string, PoseMatch>();
  if (!skeleton || !limbs) return found;
  const all = takeLimbs(goalsOf(goals), limbs, skeleton);
  const time = timeSeconds + timeOffsetSeconds;
  const byHand = goals === shownTake(character)?.goals?.list ? shownUnkeyed(character, timeSeconds) : undefined;
  all.evaluate(time, pose.length, byHand);
  worldMatrices(all.compiled, pose, all.world);
  for (const limb of all.limbs) {
    const match = matchOf(all, limb, pose, spaceJointAt(limb, time));
    const values = Array.from(all.values.subarray(limb.at, limb.at + 11));
    const [x, y, z, ...angles] = match.goal;
    writeQuaternion('xyz', angles, quaternion);
    const near = Float64Array.from(values.slice(RX, RX + 3));
    writeAnglesNear('xyz', quaternion, near);
    const { chain, dofs } = limb;
    const led = chain ? [...chain.turnsFirst.dofs, chain.dof, ...(chain.turnsLast?.dofs ?? [])] : [...dofs];
    found.set(limb.limb.name, { ...match, goal: [x, y, z, ...near], bends: chain !== undefined, led, values });
  }
  return found;
}

/** Compiled once for a list of goals: a drag asks at every move of the pointer. */
const goalsOf = perObject((list: readonly Goal[]): Goals => ({ list }));

/** The displayed pose of a character. @param timeSeconds of the transport */
export function shownPose(character: Character, timeSeconds: number): Float64Array {
  const dofs = new Float64Array(dofCountOf(character));
  poseAt(character, timeSeconds, dofs);
  return dofs;
}

/** Scratch; never escapes. */
const quaternion = new Float64Array(4);
