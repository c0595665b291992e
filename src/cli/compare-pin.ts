/** `marrow compare --pin`: targets of a solver of inverse kinematics, for dumps that state none. */

import type { Skeleton } from '../model/skeleton/skeleton.ts';
import type { SolverTask, Targets } from '../teaching/compare/targets.ts';
import { type AskedPin, resolvePin } from './pin-argument.ts';
import { UsageError } from './usage-error.ts';

/** Numbers that are judged by the pins, and by those that they state. @throws UsageError if these don't fit */
export function withPins(
  targets: Targets,
  skeleton: Skeleton | undefined,
  pins: readonly AskedPin[],
  isOneStep: boolean,
): Targets {
  if (pins.length === 0 && !isOneStep) return targets;
  if (!skeleton) throw new UsageError('--pin needs a file with a skeleton; these have none.');
  const goals = pins.map((pin) => resolvePin(skeleton, pin));
  const frames = targets.frames.map((frame) => {
    const { solver = { goals, isOneStep }, ...numbers } = frame;
    if (solver.goals.length === 0)
      throw new UsageError('--one-step goes with --pin JOINT=x,y,z, or a target in the dump.');
    const task: SolverTask = { goals: solver.goals, isOneStep: solver.isOneStep || isOneStep };
    if (task.isOneStep && task.goals.length > 1)
      throw new UsageError(
        `--one-step takes one pin, since a step is judged for one alone; found ${task.goals.length}.`,
      );
    if (numbers.vertices || numbers.normals)
      throw new UsageError('--pin takes numbers of joints; the dump has vertices or normals.');
    return { ...numbers, solver: task };
  });
  if (frames.length === 0) throw new UsageError('--pin takes numbers of joints; the dump has channels.');
  return { ...targets, frames };
}
