import { describe, expect, it } from 'vitest';
import { ikProblem, movePin } from '../../../src/evaluate/ik/problem.ts';
import { solve } from '../../../src/evaluate/ik/solve.ts';
import { filePose } from '../../../src/model/skeleton/dofs.ts';
import type { Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import { joint } from '../../helpers/builders.ts';

/** Five bones of length 1 that turn about z and y by turns, bent. */
const arm: Skeleton = {
  name: 'arm',
  joints: Array.from({ length: 5 }, (_, j) =>
    joint(j - 1, {
      offset: j === 0 ? [0, 0, 0] : [0, 1, 0],
      motion: { kind: 'hinge', axis: j % 2 === 0 ? [0, 0, 1] : [1, 0, 0] },
      pose: [0.4],
      length: 1,
    }),
  ),
};

/** Iterations that each step of a drag takes, of the tip of the arm around a circle and back, and the largest miss. */
function drag(angles: readonly number[]): { iterations: number[]; miss: number } {
  const pose = Float64Array.from(filePose(arm, 0));
  const problem = ikProblem(arm, [{ joint: 4, point: [0, 1, 0], target: [0, 0, 0] }], pose);
  const at = (angle: number) => movePin(problem, 0, -1 + Math.sin(angle), 2.5 + Math.cos(angle), 1);
  at(angles[0]);
  solve(problem, pose, 'settle');
  let miss = 0;
  const iterations = angles.slice(1).map((angle) => {
    at(angle);
    const result = solve(problem, pose, 'drag');
    miss = Math.max(miss, result.residuals[0]);
    return result.iterations;
  });
  return { iterations, miss };
}

const turn = (i: number) => (i * Math.PI) / 45;

describe('what a drag foresees', () => {
  it('lets one iteration do for each step of a steady hand, once there was one', () => {
    const { iterations, miss } = drag(Array.from({ length: 121 }, (_, i) => turn(i)));
    expect(iterations[0]).toBeGreaterThan(1);
    expect(iterations.slice(1).filter((count) => count > 1)).toEqual([]);
    expect(miss).toBeLessThan(1e-4 * 5);
  });

  it('what a drag foresees does no harm if the hand turns back, jumps or stops', () => {
    const back = Array.from({ length: 61 }, (_, i) => turn(30 - Math.abs(30 - i)));
    const jumps = Array.from({ length: 60 }, (_, i) => turn((i * 37) % 120));
    const stands = [0, 1, 1, 1, 2, 2, 3].map(turn);
    for (const path of [back, jumps, stands]) expect(drag(path).miss).toBeLessThan(1e-4 * 5);
    expect(drag(back).iterations.filter((count) => count > 1).length).toBeLessThan(4);
    expect(drag(stands).iterations.slice(1, 3)).toEqual([0, 0]);
  });

  it('what a drag foresees is nothing if the hand is out of reach: a resting hand costs no more iterations than one', () => {
    const pose = Float64Array.from(filePose(arm, 0));
    const problem = ikProblem(
      arm,
      [
        { joint: 4, point: [0, 1, 0], target: [0, 0, 0] },
        { joint: 2, point: [0, 1, 0], target: [2, 2, 0], holds: true },
      ],
      pose,
    );
    const counts = Array.from({ length: 12 }, (_, i) => {
      movePin(problem, 0, 6 + Math.min(i, 6) / 10, -3, 1);
      const { iterations } = solve(problem, pose, 'drag');
      expect(problem.foresight.isMet).toBe(false);
      return iterations;
    });
    expect(Math.max(...counts.slice(8))).toBeLessThanOrEqual(3);
  });
});
