/** Where the goals and poles of limbs in IK are, for the handles of the page. */
import type { Vec3 } from '../../math/vec3.ts';
import { type Character, shownTake } from '../../model/document.ts';
import type { GoalPlace } from '../../model/limbs.ts';
import { firstGoalChannel } from '../../model/takes/goals.ts';
import { worldMatrices } from '../kinematics.ts';
import { shownUnkeyed } from '../pose.ts';
import { intoSpace } from './match.ts';
import { spaceJointAt, takeLimbs } from './over-pose.ts';
import { POLE_OF } from './posed.ts';
import { newTarget, PX, writeTarget } from './target.ts';

/**
 * The places of the goals of limbs that are in IK at a time.
 * @param timeSeconds of the transport
 * @param dofs the pose that is displayed then
 */
export function goalPlaces(character: Character, timeSeconds: number, dofs: Float64Array): GoalPlace[] {
  const { skeleton, limbs, driver, timeOffsetSeconds } = character;
  const goals = shownTake(character)?.goals;
  if (!skeleton || !limbs || !goals || driver) return [];
  const all = takeLimbs(goals, limbs, skeleton);
  const { world, values } = all;
  const time = timeSeconds + timeOffsetSeconds;
  all.evaluate(time, dofs.length, shownUnkeyed(character, timeSeconds));
  // Limbs are not solved again: where one is only partly IK's, so would what is in its space be twice.
  worldMatrices(all.compiled, dofs, world);
  return all.limbs.flatMap((one): GoalPlace | [] => {
    if (!(values[one.at] > 0)) return [];
    const space = spaceJointAt(one, time);
    writeTarget(values, one.at, world, space, target);
    const frame = space < 0 ? new Float64Array() : world.slice(16 * space, 16 * space + 16);
    const first = firstGoalChannel(dofs.length, goals.list.indexOf(one.goal)) + PX;
    const poleAt = (point: Vec3) => {
      const own = space < 0 ? point : intoSpace(frame, 0, point);
      return POLE_OF.map((_, k) => ({ index: first + k, value: own[k] }));
    };
    const [x, y, z] = target.point;
    const [px, py, pz] = target.pole;
    return { limb: one.limb, point: [x, y, z], ...(one.hasPole && { pole: [px, py, pz] }), poleAt };
  });
}

/** Scratch; never escapes. */
const target = newTarget();
