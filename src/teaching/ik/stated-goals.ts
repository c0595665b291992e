/** Targets that a dump states, as points of joints of a skeleton. */
import type { DumpTarget } from '../../model/dump.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { Misfit } from '../dump/entries.ts';
import { JointNames } from '../dump/labels.ts';
import type { Goal } from './goal.ts';

/** A target that a dump states, for all of its numbers or those of one time. */
export interface StatedGoal {
  readonly goal: Goal;
  /** Time of the numbers that it is for; undefined: of all. */
  readonly time?: number;
}

/** Names told of a skeleton. */
const MAX_NAMED = 8;

/** Throws a `Misfit` where a target is of no joint. */
export function goalsOf(targets: readonly DumpTarget[], skeleton: Skeleton | undefined): readonly StatedGoal[] {
  if (targets.length === 0) return [];
  const joints = skeleton?.joints ?? [];
  const names = new JointNames(joints.map(({ name }) => name));
  return targets.map(({ of, point, position, time, line }) => {
    const named = of?.name === undefined ? of?.index : names.placesOf([of])[0];
    const joint = named === undefined ? undefined : joints[named];
    if (named === undefined || !joint) {
      const some = joints.slice(0, MAX_NAMED).map(({ name }, j) => name || String(j));
      const all = joints.length > MAX_NAMED ? `${some.join(', ')} …` : some.join(', ');
      const found = of ? `"${of.name ?? of.index}"` : 'none';
      const message = `Expected the joint that is brought to the target, as in "target ${some.at(-1) ?? 'hand'} 1 2 3"; found ${found}. Joints: ${all}.`;
      throw new Misfit('target-joint', message, line);
    }
    const goal: Goal = { joint: named, point: point ?? [0, joint.length ?? 0, 0], target: position };
    return { goal, ...(time !== undefined && { time }) };
  });
}
