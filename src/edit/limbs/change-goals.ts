/** Changes to the goals of a character's shown take: keys, and switches between FK and IK. */
import { matchPose, type PoseMatch, shownPose } from '../../evaluate/limbs/match-pose.ts';
import { currentValues, dofsOfLimb, GOAL_OF, type GoalValues, matchValues } from '../../evaluate/limbs/posed.ts';
import { type Character, shownTake } from '../../model/document.ts';
import type { Limb } from '../../model/limbs.ts';
import { goalChannel, WORLD_SPACE, withGoalChannel, withGoals } from '../../model/takes/goals.ts';
import type { Channel, Goal, Take } from '../../model/takes/take.ts';
import { AUTO_TANGENT } from '../../model/takes/tangent-kinds.ts';
import { CommandError } from '../command-error.ts';
import { putKeyAt } from '../keys/put-key.ts';
import { keptAt, steppedTo } from '../keys/stepped-to.ts';
import { layerValues } from '../layers/layer-values.ts';
import { requireTake, withTake } from '../takes.ts';
import { unkeyedAt, withUnkeyed } from '../unkeyed.ts';

/** Angles and lengths this near to those of samples are those. */
const SAME = 1e-9;

/** The goal of a limb in a take; undefined if it is FK there. */
export function goalOfLimb({ goals }: Take, { name }: Limb): Goal | undefined {
  return goals?.list.find((goal) => goal.limb === name);
}

/** A goal in the character's space, without curves. */
export function newGoal({ name }: Limb): Goal {
  return { limb: name, space: WORLD_SPACE, channels: {} };
}

/** The character with a goal in its shown take, in place of the one that its limb had; the same object if it is that. */
export function withGoal(character: Character, goal: Goal): Character {
  const take = requireTake(character);
  const list = take.goals?.list ?? [];
  const at = list.findIndex(({ limb }) => limb === goal.limb);
  if (list[at] === goal) return character;
  return withTake(character, character.shownTake, withGoals(take, at < 0 ? [...list, goal] : list.with(at, goal)));
}

/** A goal with keys at a time of the take; existing keys there keep their tangents, new ones are `auto`. */
export function keyedGoal(goal: Goal, values: GoalValues, time: number): Goal {
  return changed(goal, values, (channel, value) => putKeyAt(channel, time, value, AUTO_TANGENT, {}).channel);
}

function changed(goal: Goal, values: GoalValues, change: (channel: Channel, value: number) => Channel): Goal {
  return [...values].reduce((now, [name, value]) => {
    return withGoalChannel(now, name, change(goalChannel(now, name), value));
  }, goal);
}

/** The goal of a limb as the pose that is shown has it. */
export function matchOfLimb(character: Character, limb: Limb, goal: Goal, timeSeconds: number): PoseMatch {
  const own = shownTake(character)?.goals?.list ?? [];
  const goals = own.includes(goal) ? own : [goal];
  const match = matchPose(character, goals, timeSeconds, shownPose(character, timeSeconds)).get(limb.name);
  if (!match)
    throw new CommandError(`The goal of ${limb.name} is not reached: a joint or limb that it needs is missing.`);
  return match;
}

/**
 * Switches a limb at a time without a jump: IK continues from the pose that is shown, and so does FK. What moved it
 * before that time stays as it is.
 */
export function switched(character: Character, limb: Limb, to: 'ik' | 'fk', timeSeconds: number): Character {
  const take = requireTake(character);
  const time = timeSeconds + character.timeOffsetSeconds;
  const before = goalOfLimb(take, limb) ?? { ...newGoal(limb), channels: { blend: { curve: 0 } } };
  const match = matchOfLimb(character, limb, before, timeSeconds);
  const blend = to === 'ik' ? 1 : 0;
  if (match.values[0] === blend) return character;
  const values = to === 'ik' ? matchValues(before, limb, match, match.bends) : currentValues(before, match);
  const placed = changed(before, values, (channel, value) =>
    to === 'ik' ? firstOr(channel, before, time, value) : keptAt(channel, time),
  );
  const step = steppedTo(goalChannel(placed, 'blend'), time, blend, 'holds');
  return withGoal(to === 'ik' ? withFkKept(character, limb, time) : withFkAt(character, limb, timeSeconds), {
    ...withGoalChannel(placed, 'blend', step),
  });
}

/** Of a goal that is new, the value is its first key. */
function firstOr(channel: Channel, goal: Goal, time: number, value: number): Channel {
  const isNew = channel.kind === 'rest' && !hasKeys(goal);
  return isNew
    ? putKeyAt(channel, time, value, AUTO_TANGENT, {}).channel
    : steppedTo(channel, time, value, 'continues');
}

function hasKeys({ channels }: Goal): boolean {
  return GOAL_OF.some((name) => channels[name] !== undefined);
}

function dofsOf({ skeleton }: Character, limb: Limb): readonly number[] {
  return skeleton ? dofsOfLimb(skeleton, limb) : [];
}

/** FK's curves with a key where IK begins. */
function withFkKept(character: Character, limb: Limb, time: number): Character {
  const take = requireTake(character);
  const channels = [...take.channels];
  for (const dof of dofsOf(character, limb)) if (channels[dof]) channels[dof] = keptAt(channels[dof], time);
  return withOwnChannels(character, channels);
}

/** FK's DOFs as they are shown, from a time on. */
function withFkAt(character: Character, limb: Limb, timeSeconds: number): Character {
  const take = requireTake(character);
  const shown = shownPose(character, timeSeconds);
  const time = timeSeconds + character.timeOffsetSeconds;
  const channels = [...take.channels];
  const { goals: _goals, ...alone } = take;
  const fk = shownPose({ ...withTake(character, character.shownTake, alone) }, timeSeconds);
  const dofs = dofsOf(character, limb);
  const sampled = dofs.filter((dof) => channels[dof]?.kind === 'samples' && Math.abs(shown[dof] - fk[dof]) > SAME);
  if (sampled.length > 0) {
    throw new CommandError(
      `${limb.name} follows samples in FK, so it can’t stay where IK has it. Add a layer first: Keys > Layers > Add layer.`,
    );
  }
  const keyable = dofs.filter((dof) => channels[dof] && channels[dof].kind !== 'samples');
  const wanted = layerValues(character, new Map(keyable.map((dof) => [dof, shown[dof]])), timeSeconds);
  for (const [dof, value] of wanted) channels[dof] = steppedTo(channels[dof], time, value, 'continues');
  const byHand = unkeyedAt(character, timeSeconds);
  for (const dof of dofs) byHand.delete(dof);
  return withUnkeyed(withOwnChannels(character, channels), timeSeconds, byHand);
}

function withOwnChannels(character: Character, channels: readonly Channel[]): Character {
  const take = requireTake(character);
  if (channels.every((channel, i) => channel === take.channels[i])) return character;
  return withTake(character, character.shownTake, { ...take, channels });
}
