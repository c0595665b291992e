/** Whether joints stand as a pose of the skeleton can have them, and a point at its target. */
import type { IkPin } from '../../evaluate/ik/pins.ts';
import { ikProblem } from '../../evaluate/ik/problem.ts';
import { solve } from '../../evaluate/ik/solve.ts';
import type { Vec3 } from '../../math/vec3.ts';
import { transformPoint } from '../../math/vec3.ts';
import type { FrameTarget } from '../targets.ts';
import type { SolverStart } from './start.ts';

/** The largest distance that remains of any pin. */
export function remaining({ skeleton, character, pose }: SolverStart, pins: readonly IkPin[]): number {
  const problem = ikProblem(skeleton, pins, pose, { clamps: character.clampsToLimits });
  return Math.max(...solve(problem, Float64Array.from(pose), 'settle').residuals);
}

/** Pins that hold all joints where a dump has them: origins, and of matrices a point on each axis. */
export function pinsOf({ world, positions }: FrameTarget, joints: number, size: number): readonly IkPin[] {
  const points: readonly Vec3[] = [
    [0, 0, 0],
    [size, 0, 0],
    [0, size, 0],
    [0, 0, size],
  ];
  return Array.from({ length: joints }, (_, joint) => joint).flatMap((joint): readonly IkPin[] => {
    if (world) return points.map((point) => ({ joint, point, target: transformPoint(world, point, 16 * joint) }));
    if (!positions) return [];
    const [x, y, z] = positions.subarray(3 * joint, 3 * joint + 3);
    return [{ joint, point: points[0], target: [x, y, z] }];
  });
}
