/**
 * Goals of limbs: where the tips of a character's limbs (`../limbs.ts`) go while a take plays. They come after its
 * channels and layers, and are evaluated by `evaluate/limbs/`.
 */
import { jointReferences, jointReferred } from '../skeleton/joint-reference.ts';
import type { Skeleton } from '../skeleton/skeleton.ts';
import type { Goal, KeyedChannel, SpaceKey, Take } from './take.ts';

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

/** The take with other goals; without any if there are none and nothing else of its file is known. */
export function withGoals(take: Take, list: readonly Goal[]): Take {
  const { goals, ...rest } = take;
  return list.length > 0 ? { ...rest, goals: { ...goals, list } } : rest;
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
