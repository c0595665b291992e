import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { evaluatePose } from '../../../src/evaluate/ik/forward.ts';
import { stepHome, writeWayHome } from '../../../src/evaluate/ik/homing.ts';
import { ikProblem } from '../../../src/evaluate/ik/problem.ts';
import { DEFAULT_BOX, type Joint, type Skeleton, UNLIMITED } from '../../../src/model/skeleton/skeleton.ts';

/** Three units of chain, each joint a ball; its tip is the last one's pivot. */
const CHAIN: Skeleton = {
  name: 'chain',
  joints: [0, 1, 2, 3].map(
    (j): Joint => ({
      name: `j${j}`,
      parent: j - 1,
      offset: [0, j === 0 ? 0 : 1, 0],
      box: DEFAULT_BOX,
      motion: { kind: 'ball', order: 'xyz' },
      limits: [UNLIMITED, j === 1 ? { min: -0.5, max: 0.5 } : UNLIMITED, UNLIMITED],
      pose: [0, 0, 0],
    }),
  ),
};
const DOFS = 15;
const LIMITED = 3 + 3 + 1;

/** Of a step of a thousandth of the way, the tip may move by its square. */
const PART = 1e-3;
const SECOND_ORDER = 20 * PART * PART;

const pose = fc.array(fc.double({ min: -1, max: 1, noNaN: true }), { minLength: DOFS, maxLength: DOFS }).map((list) => {
  const dofs = Float64Array.from(list);
  dofs.fill(0, 0, 3);
  dofs[LIMITED] = Math.max(-0.5, Math.min(0.5, dofs[LIMITED]));
  return dofs;
});

function problemAt(dofs: Float64Array) {
  const problem = ikProblem(CHAIN, [{ joint: 3, point: [0, 0, 0], target: [0, 3, 0] }], dofs);
  evaluatePose(problem, dofs);
  return problem;
}

const apart = (a: ArrayLike<number>, b: ArrayLike<number>) =>
  Math.sqrt(Array.from(a).reduce((sum, v, d) => sum + (v - b[d]) ** 2, 0));

describe('the way home', () => {
  it('moves no pin, and brings the pose nearer', () => {
    fc.assert(
      fc.property(pose, pose, (dofs, home) => {
        const problem = problemAt(dofs);
        const tip = problem.pins.positions.slice(0, 3);
        const way = writeWayHome(problem, dofs, home);
        const after = dofs.slice();
        stepHome(problem, after, PART);
        evaluatePose(problem, after);
        expect(apart(problem.pins.positions, tip)).toBeLessThan(SECOND_ORDER * (1 + way));
        if (way > 0.05) expect(apart(after, home)).toBeLessThan(apart(dofs, home));
      }),
    );
  });

  it('the way home is zero at home', () => {
    fc.assert(
      fc.property(pose, (dofs) => {
        expect(writeWayHome(problemAt(dofs), dofs, dofs.slice())).toBeLessThan(1e-12);
      }),
    );
  });

  it('the way home stays within limits, and gives up no other DOF for one that is held', () => {
    const dofs = new Float64Array(DOFS);
    dofs[LIMITED] = 0.5;
    const home = dofs.slice();
    home[LIMITED] = 2;
    home[LIMITED + 3] = 1;
    const problem = problemAt(dofs);
    writeWayHome(problem, dofs, home);
    const after = dofs.slice();
    stepHome(problem, after, 1);
    expect(after[LIMITED]).toBe(0.5);
    expect(after[LIMITED + 3]).toBeGreaterThan(0.4);
  });
});
