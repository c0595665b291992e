/**
 * Posing limbs in IK: what sets their DOFs by hand moves their goals instead, so that the pose is shown as it is
 * wanted. Drags, sliders, saved poses, mirroring and pasting need not know of it.
 */
import type { Character } from '../../model/document.ts';
import { shownTake } from '../../model/document.ts';
import type { Limb, LimbMatch } from '../../model/limbs.ts';
import { firstDofs } from '../../model/skeleton/dofs.ts';
import { dofsOf } from '../../model/skeleton/joint-types.ts';
import { restExtent } from '../../model/skeleton/rest-extent.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { firstGoalChannel } from '../../model/takes/goals.ts';
import { GOAL_CHANNELS, type Goal, type GoalChannel } from '../../model/takes/take.ts';
import { applyConstraints, compileSkeleton } from '../kinematics.ts';
import { matchPose, type PoseMatch, shownPose } from './match-pose.ts';

/** A goal that moves less than this, in parts of the size, and radians, holds: a drag of the body leaves feet so near. */
const HOLDS = 1e-5;

/** Curves of a goal's place and rotation. */
export const GOAL_OF = ['tx', 'ty', 'tz', 'rx', 'ry', 'rz'] as const;
/** Curves of its pole. */
export const POLE_OF = ['px', 'py', 'pz'] as const;

/** Values of curves of a goal. */
export type GoalValues = ReadonlyMap<GoalChannel, number>;

/** The values of a list of curves. */
export function goalValues(names: readonly GoalChannel[], values: readonly number[]): GoalValues {
  return new Map(names.map((name, k) => [name, values[k]]));
}

/** Whether a goal says where the limb bends to. */
export function hasPole({ channels }: Goal): boolean {
  return POLE_OF.some((name) => channels[name] !== undefined);
}

/**
 * The values that a match gives a goal. The side of the bend is one of them only where it isn't the goal's already.
 * @param pole whether the goal has one
 */
export function matchValues(
  goal: Goal,
  { bend }: Limb,
  match: LimbMatch & Pick<PoseMatch, 'bends' | 'values'>,
  pole: boolean,
): GoalValues {
  const own = goal.channels.bend ? match.values[GOAL_CHANNELS.indexOf('bend')] : (bend?.sign ?? 1);
  return new Map<GoalChannel, number>([
    ...goalValues(GOAL_OF, match.goal),
    ...(pole ? goalValues(POLE_OF, match.pole) : []),
    ...(match.bends && own >= 0 !== match.bend >= 0 ? ([['bend', match.bend]] as const) : []),
  ]);
}

/** A goal's values now, of what K keys: place and rotation, and the pole if it has one. */
export function currentValues(goal: Goal, { values }: Pick<PoseMatch, 'values'>): GoalValues {
  return goalValues(hasPole(goal) ? [...GOAL_OF, ...POLE_OF] : GOAL_OF, values.slice(1));
}

/** The DOFs of a limb, in order. */
export function dofsOfLimb(skeleton: Skeleton, { joints }: Limb): readonly number[] {
  const first = firstDofs(skeleton);
  return joints.flatMap((j) => dofsOf(skeleton.joints[j].motion).map((_, k) => first[j] + k));
}

/**
 * The values with which goals show what is wanted: those of limbs in IK as values of their goals, by the indices of
 * their channels (`withGoalChannels`). Where the tip stays the goal does, and so the limb.
 *
 * @param values of DOFs, as they should be displayed
 * @param timeSeconds of the transport
 * @param keys whether the pose is as displayed, and goals are given as they are, to be keyed
 */
export function posedByGoals(
  character: Character,
  values: ReadonlyMap<number, number>,
  timeSeconds: number,
  keys: boolean,
): ReadonlyMap<number, number> {
  const { skeleton, limbs, driver, clampsToLimits } = character;
  const goals = shownTake(character)?.goals?.list ?? [];
  if (!skeleton || !limbs || driver) return values;
  const wanted = shownPose(character, timeSeconds);
  for (const [dof, value] of values) if (dof < wanted.length) wanted[dof] = value;
  applyConstraints(compileSkeleton(skeleton), wanted, clampsToLimits);
  const matches = matchPose(character, goals, timeSeconds, wanted);
  const posed = new Map(values);
  goals.forEach((goal, g) => {
    const limb = limbs.list.find(({ name }) => name === goal.limb);
    const match = matches.get(goal.limb);
    if (!limb || !match || !(match.values[0] > 0)) return;
    if (!dofsOfLimb(skeleton, limb).some((dof) => values.has(dof))) return;
    const pole = hasPole(goal);
    // A goal that is out of reach is keyed where it is, not where the limb ends.
    const isMoved = !keys && moves(limb, match, restExtent(skeleton) || 1);
    const set = isMoved ? matchValues(goal, limb, match, pole) : keys ? currentValues(goal, match) : [];
    const first = firstGoalChannel(wanted.length, g);
    for (const [name, value] of set) {
      if (limb.orient || !name.startsWith('r')) posed.set(first + GOAL_CHANNELS.indexOf(name), value);
    }
    // Without a pole, FK says to which side it bends.
    if (match.values[0] >= 1 && match.bends && pole) for (const dof of match.led) posed.delete(dof);
  });
  return posed;
}

function moves({ orient }: Limb, { goal, values }: PoseMatch, size: number): boolean {
  const by = goal.map((value, k) => Math.abs(value - values[k + 1]));
  return by.some((way, k) => way > (k < 3 ? HOLDS * size : orient ? HOLDS : Infinity));
}
