/** How near a point can come to its target. */
import type { IkPin } from '../../evaluate/ik/pins.ts';
import { ikProblem } from '../../evaluate/ik/problem.ts';
import { solve } from '../../evaluate/ik/solve.ts';
import type { SolverStart } from './start.ts';

/** The distance that remains. */
export function remaining({ skeleton, character, pose }: SolverStart, pin: IkPin): number {
  const problem = ikProblem(skeleton, [pin], pose, { clamps: character.clampsToLimits });
  return solve(problem, Float64Array.from(pose), 'settle').residuals[0];
}
