/**
 * Goals of limbs: where the tips of a character's limbs (`../limbs.ts`) go while a take plays. They come after its
 * channels and layers, and are evaluated by `evaluate/limbs/`.
 */
import { perObject } from '../per-object.ts';
import { jointReferences, jointReferred } from '../skeleton/joint-reference.ts';
import type { Skeleton } from '../skeleton/skeleton.ts';
import {
  type Channel,
  GOAL_CHANNELS,
  type Goal,
  type GoalChannel,
  type GoalCurve,
  type KeyedChannel,
  restChannel,
  type SpaceKey,
  type Take,
} from './take.ts';

/** The character's own space, as the name of a goal's space. */
export const WORLD_SPACE = 'world';
/** The space of the joint that a limb is attached to, as the name of a goal's space. */
export const PARENT_SPACE = 'parent';

/** A goal's spaces with their times; the first applies before its time, too. */
export function spacesOf({ space }: Goal): readonly SpaceKey[] {
  return typeof space === 'string' ? [[0, space]] : space;
}

/** The name of a goal's space at a time. */
export function spaceAt(goal: Goal, timeSeconds: number): string {
  const spaces = spacesOf(goal);
  const [, name] = spaces.findLast(([time]) => time <= timeSeconds) ?? spaces[0] ?? [0, WORLD_SPACE];
  return name;
}

/** Curves with keys of a take's goals. */
export function goalCurves({ goals }: Take): readonly KeyedChannel[] {
  return (goals?.list ?? []).flatMap(({ channels }) =>
    Object.values(channels).flatMap(({ curve }) => (typeof curve === 'number' ? [] : [curve])),
  );
}

/** A curve of a goal as a channel: at rest if it is constant or missing. The same object for the same curve. */
export function goalChannel({ channels }: Goal, name: GoalChannel): Channel {
  const given = channels[name];
  return given ? channelOf(given) : name === 'blend' ? FULL : NOTHING;
}

const FULL = restChannel(1);
const NOTHING = restChannel(0);
const channelOf = perObject(
  ({ curve }: GoalCurve): Channel => (typeof curve === 'number' ? restChannel(curve) : curve),
);

/** The goal with another curve; the same object if it is the same. */
export function withGoalChannel(goal: Goal, name: GoalChannel, channel: Channel): Goal {
  if (channel === goalChannel(goal, name)) return goal;
  const curve: GoalCurve['curve'] = channel.kind === 'keys' ? channel : channel.kind === 'rest' ? channel.value : 0;
  if (curve === goal.channels[name]?.curve) return goal;
  const channels = { ...goal.channels, [name]: { ...goal.channels[name], curve } };
  // In the order in which a file has them.
  const inOrder = GOAL_CHANNELS.flatMap((each) => (channels[each] ? [[each, channels[each]] as const] : []));
  return { ...goal, channels: Object.fromEntries(inOrder) };
}

/** The take with other goals. What else its file says goes with the last of them, as with the last layer. */
export function withGoals(take: Take, list: readonly Goal[]): Take {
  const { goals, ...rest } = take;
  return list.length > 0 ? { ...rest, goals: { ...goals, list } } : rest;
}

/** The index of a goal's first channel among those of `withGoalChannels`. */
export function firstGoalChannel(dofCount: number, goal: number): number {
  return dofCount + GOAL_CHANNELS.length * goal;
}

const extended = perObject((_take: Take) => new Map<number, Take>());

/**
 * The take with the curves of its goals as channels after those of all DOFs, so that keys are edited in one way
 * wherever they are. Channels beyond the DOFs, which move nothing, are not among them. Cached; the take itself without
 * goals.
 * @param dofCount of the character
 */
export function withGoalChannels(take: Take, dofCount: number): Take {
  const { goals } = take;
  if (!goals) return take;
  const known = extended(take);
  const found = known.get(dofCount);
  if (found) return found;
  const ofDofs = Array.from({ length: dofCount }, (_, dof) => take.channels[dof] ?? NOTHING);
  const ofGoals = goals.list.flatMap((goal) => GOAL_CHANNELS.map((name) => goalChannel(goal, name)));
  const all = { ...take, channels: [...ofDofs, ...ofGoals] };
  known.set(dofCount, all);
  return all;
}

/** The take with the channels that `withGoalChannels` has, after an edit of them; the same object if nothing changes. */
export function takeOfChannels(take: Take, channels: readonly Channel[], dofCount: number): Take {
  const { goals } = take;
  const before = withGoalChannels(take, dofCount).channels;
  if (!goals || channels.every((channel, i) => channel === before[i])) return goals ? take : { ...take, channels };
  const list = goals.list.map((goal, g) =>
    GOAL_CHANNELS.reduce((now, name, k) => {
      return withGoalChannel(now, name, channels[firstGoalChannel(dofCount, g) + k]);
    }, goal),
  );
  // Channels that the take lacks are none of it as long as nothing is in them.
  const missing = channels.slice(take.channels.length, dofCount);
  const known = Math.min(take.channels.length, dofCount);
  const end = missing.some((channel) => channel !== NOTHING) ? dofCount : known;
  const own = [...channels.slice(0, end), ...take.channels.slice(dofCount)];
  const isSame = own.length === take.channels.length && own.every((channel, i) => channel === take.channels[i]);
  return {
    ...take,
    ...(!isSame && { channels: own }),
    goals: list.every((goal, g) => goal === goals.list[g]) ? goals : { ...goals, list },
  };
}

/**
 * The take with goals in spaces of the joints after a change; the same object if nothing changes. Goals in spaces of
 * removed joints are dropped.
 * @param to for each old joint its new index; -1 if removed
 */
export function remapGoals(take: Take, before: Skeleton, after: Skeleton, to: ArrayLike<number>): Take {
  if (!take.goals) return take;
  const { list } = take.goals;
  const indexOf = jointReferred(before.joints);
  const names = jointReferences(after.joints);
  const moved = (name: string) => {
    const joint = name === WORLD_SPACE || name === PARENT_SPACE ? undefined : indexOf(name);
    if (joint === undefined) return name;
    const now = to[joint];
    return now >= 0 ? names[now] : undefined;
  };
  const kept = list.flatMap((goal): Goal[] => {
    const spaces = spacesOf(goal).map(([time, name]) => [time, moved(name)] as const);
    if (spaces.every(([, name], k) => name === spacesOf(goal)[k][1])) return [goal];
    const known = spaces.flatMap(([time, name]): SpaceKey[] => (name === undefined ? [] : [[time, name]]));
    if (known.length < spaces.length) return [];
    return [{ ...goal, space: typeof goal.space === 'string' ? known[0][1] : known }];
  });
  return kept.every((goal, i) => goal === list[i]) && kept.length === list.length ? take : withGoals(take, kept);
}
