/** Spaces of goals: what a goal is given in another one, so that it stays where it is. */
import { compileChannels } from '../../evaluate/compiled-take.ts';
import { evaluateChannel } from '../../evaluate/curves.ts';
import { compileSkeleton, worldMatrices } from '../../evaluate/kinematics.ts';
import { anglesIn, intoSpace } from '../../evaluate/limbs/match.ts';
import { shownPose } from '../../evaluate/limbs/match-pose.ts';
import { GOAL_OF, type GoalValues, goalValues, hasPole, POLE_OF } from '../../evaluate/limbs/posed.ts';
import { newTarget, writeTarget } from '../../evaluate/limbs/target.ts';
import { writeAnglesNear, writeQuaternion } from '../../evaluate/rotations/euler-orders.ts';
import type { Character } from '../../model/document.ts';
import type { Limb } from '../../model/limbs.ts';
import { jointReferred } from '../../model/skeleton/joint-reference.ts';
import { goalChannel, PARENT_SPACE, spaceAt, spacesOf, WORLD_SPACE, withGoalChannel } from '../../model/takes/goals.ts';
import {
  GOAL_CHANNELS,
  type Goal,
  type GoalChannel,
  keysOf,
  restChannel,
  type SpaceKey,
} from '../../model/takes/take.ts';
import { AUTO_TANGENT, FIXED_TANGENT, FLAT } from '../../model/takes/tangent-kinds.ts';
import { CommandError } from '../command-error.ts';
import { type Key, keyAt, tangent, withKeyList } from '../keys/columns.ts';
import { steppedTo } from '../keys/stepped-to.ts';

/** Seconds before a time at which a curve has the value that it jumps from. */
const JUST_BEFORE = 1e-7;

/** The goal in one space at all times: its keys stay where they are. @param timeSeconds at which one without keys stays */
export function inSpace(character: Character, limb: Limb, goal: Goal, space: string, timeSeconds: number): Goal {
  if (spacesOf(goal).every(([, name]) => name === space)) return goal;
  const at = conversion(character, limb, goal, space);
  const isKeyed = channelsOf(goal).some((name) => goalChannel(goal, name).kind === 'keys');
  if (isKeyed) return { ...withKeysIn(goal, at, -Infinity, Infinity), space };
  const moved = [...at(timeSeconds + character.timeOffsetSeconds)].reduce((now, [name, value]) => {
    return withGoalChannel(now, name, restChannel(value));
  }, goal);
  return { ...moved, space };
}

/** The goal in another space from a time of the transport on, until it is in another one: it doesn't jump. */
export function inSpaceFrom(character: Character, limb: Limb, goal: Goal, space: string, timeSeconds: number): Goal {
  const time = timeSeconds + character.timeOffsetSeconds;
  const before = spaceAt(goal, time);
  if (before === space) return goal;
  const at = conversion(character, limb, goal, space);
  const spaces = spacesOf(goal);
  const until = spaces.find(([from]) => from > time)?.[0] ?? Infinity;
  const later = withKeysIn(goal, at, time, until);
  const stepped = [...at(time)].reduce((now, [name, value]) => {
    return withGoalChannel(now, name, steppedTo(goalChannel(now, name), time, value, 'continues'));
  }, later);
  const first: SpaceKey = [Math.min(spaces[0][0], time - 1), spaces[0][1]];
  const list = [first, ...spaces.slice(1).filter(([from]) => from !== time), [time, space] as const];
  list.sort(([a], [b]) => a - b);
  return { ...stepped, space: list.filter(([, name], k) => k === 0 || name !== list[k - 1][1]) };
}

/** The values of a goal at a time of the take, in the other space. */
type Conversion = (time: number) => GoalValues;

function conversion(character: Character, limb: Limb, goal: Goal, space: string): Conversion {
  const { skeleton } = character;
  if (!skeleton) throw new CommandError(`${character.name} has no skeleton.`);
  const compiled = compileSkeleton(skeleton);
  const curves = compileChannels(GOAL_CHANNELS.map((name) => goalChannel(goal, name)));
  const jointOf = (name: string): number => {
    if (name === WORLD_SPACE) return -1;
    const joint = name === PARENT_SPACE ? skeleton.joints[limb.joints[0]].parent : jointReferred(skeleton.joints)(name);
    if (joint === undefined) throw new CommandError(`${character.name} has no joint "${name}".`);
    return joint;
  };
  const to = jointOf(space);
  const names = channelsOf(goal);
  const target = newTarget();
  const matrix = new Float64Array(16);
  const angles = new Float64Array(3);
  const quaternion = new Float64Array(4);
  return (time) => {
    const world = new Float64Array(16 * compiled.jointCount);
    worldMatrices(compiled, shownPose(character, time - character.timeOffsetSeconds), world);
    const values = Float64Array.from(GOAL_CHANNELS, (_, k) => evaluateChannel(curves, k, time));
    writeTarget(values, 0, world, jointOf(spaceAt(goal, time)), target);
    for (let k = 0; k < 9; k++) matrix[4 * Math.floor(k / 3) + (k % 3)] = target.turn[k];
    writeQuaternion('xyz', anglesIn(world, to, matrix), quaternion);
    writeAnglesNear('xyz', quaternion, angles);
    const goalNow = [...intoSpace(world, to, target.point), ...angles];
    const all = new Map([...goalValues(GOAL_OF, goalNow), ...goalValues(POLE_OF, intoSpace(world, to, target.pole))]);
    return new Map([...all].filter(([name]) => names.includes(name)));
  };
}

/** The curves that are in a space. */
function channelsOf(goal: Goal): readonly GoalChannel[] {
  return hasPole(goal) ? [...GOAL_OF, ...POLE_OF] : GOAL_OF;
}

/**
 * The goal with all keys after a time, and up to another one, in the other space; every curve has a key wherever one of
 * them has.
 */
function withKeysIn(goal: Goal, at: Conversion, after: number, until: number): Goal {
  const names = channelsOf(goal);
  const channels = names.map((name) => goalChannel(goal, name));
  const isStep = (time: number) =>
    channels.some((channel) => keysOf(channel).times.filter((t) => t === time).length > 1);
  const all = [...new Set(channels.flatMap((channel) => [...keysOf(channel).times]))].sort((a, b) => a - b);
  // Where the space changes next, only what comes before it.
  const times = all.filter((time) => time > after && (time < until || (time === until && isStep(time))));
  const rows = times.map((time) => ({
    time,
    before: isStep(time) ? at(time - JUST_BEFORE) : undefined,
    here: time < until ? at(time) : undefined,
  }));
  return names.reduce((now, name, n) => {
    const channel = channels[n];
    const keys = Array.from(keysOf(channel).times, (_, k) =>
      channel.kind === 'keys' ? [keyAt(channel, k)] : [],
    ).flat();
    const kept = keys.filter(({ time }) => !times.includes(time));
    const made = rows.flatMap(({ time, before, here }): Key[] => {
      const own = keys.filter((key) => key.time === time);
      const [first, last] = [own[0], own[own.length - 1]];
      const flat = tangent(FLAT);
      const auto = tangent(AUTO_TANGENT);
      const left = before?.get(name);
      const right = here?.get(name);
      return [
        ...(left === undefined ? [] : [{ time, value: left, in: adaptive(first?.in) ?? auto, out: flat }]),
        ...(right === undefined
          ? own.slice(1)
          : [
              {
                time,
                value: right,
                in: before ? flat : (adaptive(first?.in) ?? auto),
                out: adaptive(last?.out) ?? auto,
              },
            ]),
      ];
    });
    const list = [...kept, ...made].sort((a, b) => a.time - b.time);
    return list.length > 0 ? withGoalChannel(now, name, withKeyList(channel, list)) : now;
  }, goal);
}

/** A slope is none in another space. */
function adaptive(own: Key['in'] | undefined): Key['in'] | undefined {
  return own?.kind === FIXED_TANGENT ? undefined : own;
}
