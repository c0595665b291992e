/** The limbs of a character at a time: what `marrow pose` and `marrow.limbs()` say of them. */
import type { Character } from '../../model/document.ts';
import { shownTake } from '../../model/document.ts';
import { type LimbInfo, type LimbMatch, type LimbRow, limbsByName } from '../../model/limbs.ts';
import { spaceAt } from '../../model/takes/goals.ts';
import { worldMatrices } from '../kinematics.ts';
import { dofCountOf, poseAt, shownUnkeyed } from '../pose.ts';
import { matchOf } from './match.ts';
import { type CompiledLimb, spaceJointAt, type TakeLimbs, takeLimbs } from './over-pose.ts';
import { newTarget, TX, writeTarget, writeTip } from './target.ts';

/** All limbs of a character at a time of the transport, in their order. */
export function limbRows(character: Character, timeSeconds: number): LimbRow[] {
  const { skeleton, limbs } = character;
  if (!skeleton || !limbs) return [];
  const infos = limbInfos(character, timeSeconds);
  return limbsByName(limbs.list, skeleton).map((row) => ({ ...row, ...infos.find(({ name }) => name === row.name) }));
}

/** The limbs with goals of the take shown, in the order of the character's limbs; none while another's take moves it. */
export function limbInfos(character: Character, timeSeconds: number): LimbInfo[] {
  const { skeleton, limbs, driver, clampsToLimits } = character;
  const take = shownTake(character);
  if (!skeleton || !limbs || !take?.goals || driver) return [];
  const { goals, ...fkTake } = take;
  const dofs = new Float64Array(dofCountOf(character));
  poseAt({ ...character, takes: [fkTake], shownTake: 0 }, timeSeconds, dofs);
  const all = takeLimbs(goals, limbs, skeleton);
  const takeSeconds = timeSeconds + character.timeOffsetSeconds;
  const matches = new Map<CompiledLimb, LimbMatch>();
  all.solve(takeSeconds, dofs, clampsToLimits, dofs.length, shownUnkeyed(character, timeSeconds), (limb, space) => {
    matches.set(limb, matchOf(all, limb, dofs, space));
  });
  const world = new Float64Array(16 * all.compiled.jointCount);
  worldMatrices(all.compiled, dofs, world);
  const infos = [...matches].map(([limb, match]) => infoOf(all, limb, match, world, takeSeconds));
  return limbs.list.flatMap(({ name }) => infos.find((info) => info.name === name) ?? []);
}

function infoOf(
  { values }: TakeLimbs,
  limb: CompiledLimb,
  match: LimbMatch,
  world: Float64Array,
  timeSeconds: number,
): LimbInfo {
  const { at, goal } = limb;
  const { name, joints, tip } = limb.limb;
  const target = newTarget();
  writeTarget(values, at, world, spaceJointAt(limb, timeSeconds), target);
  const end = new Float64Array(3);
  writeTip(tip, world, 16 * joints[joints.length - 1], end);
  const { point } = target;
  return {
    name,
    blend: Math.min(1, Math.max(0, values[at])),
    space: spaceAt(goal, timeSeconds),
    goal: Array.from(values.subarray(at + TX, at + TX + 6)),
    gap: Math.hypot(end[0] - point[0], end[1] - point[1], end[2] - point[2]),
    match,
  };
}
