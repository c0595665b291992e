import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { evaluatePose } from '../../../src/evaluate/ik/forward.ts';
import { writeJacobian } from '../../../src/evaluate/ik/jacobian.ts';
import { type Descent, descend, writeStep } from '../../../src/evaluate/ik/levenberg.ts';
import { orientationAt } from '../../../src/evaluate/ik/orientation.ts';
import { IkError, type IkPin, ikStiffness } from '../../../src/evaluate/ik/pins.ts';
import { ikProblem, movePin, turnPin } from '../../../src/evaluate/ik/problem.ts';
import { aimPins } from '../../../src/evaluate/ik/reach.ts';
import { solve } from '../../../src/evaluate/ik/solve.ts';
import { applyConstraints, clampDofs, compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { characterDofs, filePose } from '../../../src/model/skeleton/dofs.ts';
import { type Joint, type Skeleton, UNLIMITED } from '../../../src/model/skeleton/skeleton.ts';
import { joint } from '../../helpers/builders.ts';
import { expectClose } from '../../helpers/close.ts';
import { type AnyProblem, anyProblem } from './any-problem.ts';

const hinge = (parent: number, more: Partial<Joint> = {}) =>
  joint(parent, { motion: { kind: 'hinge', axis: [1, 0, 0] }, limits: [UNLIMITED], pose: [0], ...more });

/** Hinges about x, bones of 1 along y, and a pin at the end of the last bone. */
function chain(bones: number, more: Partial<Joint> = {}): Skeleton {
  return {
    name: 'chain',
    joints: Array.from({ length: bones }, (_, j) => hinge(j - 1, j ? more : { ...more, offset: [0, 0, 0] })),
  };
}
const endPin = (bones: number, y: number, z: number): IkPin => ({
  joint: bones - 1,
  point: [0, 1, 0],
  target: [0, y, z],
});
const poseOf = (skeleton: Skeleton) => Float64Array.from(filePose(skeleton, 0));

function worldOf(skeleton: Skeleton, dofs: Float64Array): Float64Array {
  const compiled = compileSkeleton(skeleton);
  const world = new Float64Array(16 * compiled.jointCount);
  worldMatrices(compiled, dofs, world);
  return world;
}

function distanceOf({ joint: j, point: [x, y, z], target }: IkPin, world: Float64Array): number {
  const w = world.subarray(16 * j, 16 * j + 16);
  return Math.hypot(...target.map((t, k) => w[k] * x + w[4 + k] * y + w[8 + k] * z + w[12 + k] - t));
}

const mode = fc.constantFrom('drag' as const, 'settle' as const);

describe('a solution of any problem', () => {
  it('a solution of any problem stays within the limits and finite, at every iteration', () => {
    fc.assert(
      fc.property(anyProblem(true), fc.nat(12), ({ skeleton, pins }: AnyProblem, iterations) => {
        const dofs = poseOf(skeleton);
        const problem = ikProblem(skeleton, pins, dofs, { stiffness: ikStiffness(skeleton, true) });
        applyConstraints(problem.skeleton, dofs, true);
        evaluatePose(problem, dofs);
        aimPins(problem.balls, problem.pins, problem.slots);
        const descent: Descent = { iterations: 0, error: 0, isThere: false, isFlat: false };
        descend(problem, dofs, { aim: 1e-6, iterations, leastGain: 0 }, descent);
        expect(descent.iterations).toBeLessThanOrEqual(iterations);
        expect(dofs.every(Number.isFinite)).toBe(true);
        const clamped = dofs.slice();
        clampDofs(problem.skeleton, clamped);
        expect(clamped).toEqual(dofs);
        solve(problem, dofs, 'drag');
        const settled = dofs.slice();
        applyConstraints(problem.skeleton, settled, true);
        expect(settled).toEqual(dofs);
      }),
      { numRuns: 100 },
    );
  });

  it('says how far off each pin is, never goes further away, and begun anew is the same every time', () => {
    fc.assert(
      fc.property(anyProblem(true), mode, ({ skeleton, pins }: AnyProblem, how) => {
        const dofs = poseOf(skeleton);
        const problem = ikProblem(skeleton, pins, dofs);
        applyConstraints(problem.skeleton, dofs, true);
        evaluatePose(problem, dofs);
        aimPins(problem.balls, problem.pins, problem.slots);
        const before = evaluatePose(problem, dofs);
        const start = dofs.slice();
        const { residuals } = solve(problem, dofs, how);
        const world = worldOf(skeleton, dofs);
        expectClose(
          residuals,
          pins.map((pin) => distanceOf(pin, world)),
          1e-9,
        );
        expect(evaluatePose(problem, dofs)).toBeLessThanOrEqual(before * (1 + 1e-9) + 1e-12);
        solve(ikProblem(skeleton, pins, poseOf(skeleton)), start, how);
        expect(start).toEqual(dofs);
      }),
      { numRuns: 60 },
    );
  });

  it('moves nothing that is locked or on no way to a pin', () => {
    fc.assert(
      fc.property(anyProblem(false), fc.nat(), mode, ({ skeleton, pins }: AnyProblem, lock, how) => {
        const dofs = poseOf(skeleton);
        const stiffness = ikStiffness(skeleton, true);
        const locked = lock % dofs.length;
        if (dofs.length > 0) stiffness[locked] = Infinity;
        const problem = ikProblem(skeleton, pins, dofs, { stiffness });
        applyConstraints(problem.skeleton, dofs, true);
        const start = dofs.slice();
        solve(problem, dofs, how);
        const { ofDof } = problem.variables;
        const follows = new Set(problem.skeleton.couples.map((couple) => couple.dof));
        dofs.forEach((value, dof) => {
          if (!follows.has(dof) && (dof === locked || ofDof[dof] < 0)) expect(value).toBe(start[dof]);
        });
      }),
      { numRuns: 60 },
    );
  });
});

describe('a target', () => {
  it('a target that is a pose of limited joints of all kinds is found', () => {
    let solved = 0;
    let count = 0;
    fc.assert(
      fc.property(
        anyProblem(true),
        fc.array(fc.double({ min: 0, max: 1, noNaN: true }), { minLength: 40, maxLength: 40 }),
        ({ skeleton, pins }, parts) => {
          const dofs = poseOf(skeleton);
          const goal = dofs.slice();
          const { firstDof, lower, upper } = compileSkeleton(skeleton);
          lower.forEach((low, d) => {
            if (low > -Infinity) goal[firstDof[0] + d] = low + parts[d % parts.length] * (upper[d] - low);
          });
          applyConstraints(compileSkeleton(skeleton), goal, true);
          const world = worldOf(skeleton, goal);
          const reached = pins.map(({ orientation: _, ...pin }) => ({ ...pin, target: pointAt(pin, world) }));
          const stiffness = ikStiffness(skeleton, true).fill(1);
          const problem = ikProblem(skeleton, reached, dofs, { stiffness });
          const { residuals } = solve(problem, dofs, 'settle');
          count++;
          if (residuals.every((off) => off <= 1e-3 * problem.reach)) solved++;
        },
      ),
      { numRuns: 60 },
    );
    expect(solved).toBeGreaterThanOrEqual(0.98 * count);
  });

  it('along a straight chain bends it', () => {
    const skeleton = chain(4);
    const dofs = poseOf(skeleton);
    const problem = ikProblem(skeleton, [endPin(4, 3.5, 0)], dofs);
    expect(solve(problem, dofs, 'drag').residuals[0]).toBeLessThan(1e-3);
  });

  it('out of reach stretches the chain towards it, and the pose comes to rest', () => {
    const skeleton = chain(5);
    const dofs = poseOf(skeleton);
    dofs[3] = 0.3;
    const problem = ikProblem(skeleton, [endPin(5, 30, 40)], dofs);
    for (let frame = 0; frame < 10; frame++) solve(problem, dofs, 'drag');
    const rest = dofs.slice();
    expect(solve(problem, dofs, 'drag').residuals[0]).toBeLessThan(45 + 5e-3);
    expect(dofs).toEqual(rest);
    expect(problem.result.isSolved).toBe(false);
  });

  it('a target that a limit forbids is approached, and the limit is named', () => {
    const skeleton = chain(2, { limits: [{ min: 0, max: 0.5 }] });
    const dofs = poseOf(skeleton);
    const problem = ikProblem(skeleton, [endPin(2, -1, 1.5)], dofs);
    const result = solve(problem, dofs, 'settle');
    expect([...dofs.subarray(3)]).toEqual([0.5, 0.5]);
    expect([...result.binding.subarray(0, result.bindingCount)]).toEqual([3, 4]);
    const free = ikProblem(skeleton, [endPin(2, -1, 1.5)], dofs, { clamps: false });
    expect(solve(free, dofs, 'settle').isSolved).toBe(true);
  });

  it('a target that is met already moves nothing', () => {
    const skeleton = chain(3);
    const dofs = poseOf(skeleton);
    const problem = ikProblem(skeleton, [endPin(3, 3, 0)], dofs);
    expect(solve(problem, dofs, 'settle').iterations).toBe(0);
    expect(dofs).toEqual(poseOf(skeleton));
  });

  it('a target can be how a joint stands, half a turn away too', () => {
    const skeleton: Skeleton = { name: 'balls', joints: [joint(-1), joint(0), joint(1)] };
    for (const goal of [
      [0.4, -0.8, 1.2],
      [Math.PI, 0, 0],
      [0, 0, 3.1],
    ]) {
      const dofs = poseOf(skeleton);
      const posed = dofs.slice();
      posed.set(goal, 6);
      posed.set([0.5, 0.2, -0.4], 9);
      const world = worldOf(skeleton, posed);
      const pin: IkPin = {
        joint: 2,
        point: [0, 1, 0],
        target: pointAt({ joint: 2, point: [0, 1, 0] }, world),
        orientation: orientationAt(world, 2),
      };
      const { residuals, turns } = solve(ikProblem(skeleton, [pin], dofs), dofs, 'settle');
      expect(residuals[0]).toBeLessThan(1e-4);
      expect(turns[0]).toBeLessThan(1e-4);
      expectClose(worldOf(skeleton, dofs).subarray(32, 48), world.subarray(32, 48), 1e-3);
    }
  });
});

function pointAt({ joint: j, point: [x, y, z] }: Pick<IkPin, 'joint' | 'point'>, world: Float64Array) {
  const at = (k: number) =>
    world[16 * j + k] * x + world[16 * j + 4 + k] * y + world[16 * j + 8 + k] * z + world[16 * j + 12 + k];
  return [at(0), at(1), at(2)] as const;
}

describe('what may move', () => {
  it('what may move is less, the stiffer it is', () => {
    const skeleton = chain(3);
    const turned = (stiffness: number) => {
      const dofs = poseOf(skeleton);
      const stiff = ikStiffness(skeleton, false);
      stiff[3] = stiffness;
      solve(ikProblem(skeleton, [endPin(3, 2.5, 1)], dofs, { stiffness: stiff }), dofs, 'drag');
      return Math.abs(dofs[3]);
    };
    expect(turned(100)).toBeLessThan(turned(1) / 4);
    expect(turned(Infinity)).toBe(0);
  });

  it('what may move is told by no step where the system can’t be solved at its damping, and more damping is tried', () => {
    // All in one plane: nothing moves the pin out of it, and without damping that is 0 = 0.
    const skeleton = chain(4);
    const dofs = poseOf(skeleton).fill(0.3, -4);
    const problem = ikProblem(skeleton, [endPin(4, 1, 2)], dofs);
    evaluatePose(problem, dofs);
    writeJacobian(problem, dofs);
    problem.scratch.before.set(dofs.subarray(-4));
    expect(writeStep(problem, problem.errors, 0, true)).toBeNaN();
    expect([...problem.scratch.step]).toEqual([0, 0, 0, 0]);
    expect(writeStep(problem, problem.errors, 1e-3, false)).toBeGreaterThan(0);
  });

  it('what may move is the root too, where it is free', () => {
    const skeleton = chain(2);
    const dofs = poseOf(skeleton);
    const problem = ikProblem(skeleton, [endPin(2, 10, 0)], dofs, { stiffness: ikStiffness(skeleton, true) });
    expect(solve(problem, dofs, 'settle').isSolved).toBe(true);
    expectClose(dofs.subarray(0, 3), [0, 8, 0], 1e-3);
  });

  it('what may move is no bone of BVH: positions stay, but for those of a free root', () => {
    const bvh = { kind: 'bvh', channels: ['tx', 'ty', 'tz', 'rz', 'rx', 'ry'], positions: 'replace' } as const;
    const six = new Array(6).fill(UNLIMITED);
    const skeleton: Skeleton = {
      name: 'bvh',
      joints: [0, 1, 2].map((j) => joint(j - 1, { motion: bvh, limits: six, pose: [0, j ? 1 : 0, 0, 0, 0, 0] })),
    };
    const lengths = (freeRoot: boolean) =>
      [...ikStiffness(skeleton, freeRoot)].flatMap((stiffness, dof) => (stiffness === Infinity ? [dof] : []));
    expect(lengths(false)).toEqual([0, 1, 2, 6, 7, 8, 12, 13, 14]);
    expect(lengths(true)).toEqual([6, 7, 8, 12, 13, 14]);
    expect(characterDofs(skeleton, [])).toHaveLength(18);
    const dofs = poseOf(skeleton);
    const pin: IkPin = { joint: 2, point: [0, 1, 0], target: [1, 1.5, 1] };
    const problem = ikProblem(skeleton, [pin], dofs);
    // Positions say where the bones end, whatever OFFSETs say.
    expect(problem.reach).toBe(3);
    expect(solve(problem, dofs, 'settle').isSolved).toBe(true);
    expect([dofs.subarray(0, 3), dofs.subarray(6, 9), dofs.subarray(12, 15)]).toEqual([
      Float64Array.of(0, 0, 0),
      Float64Array.of(0, 1, 0),
      Float64Array.of(0, 1, 0),
    ]);
  });

  it('what may move is what a coupled DOF follows, even in a joint on no way to a pin', () => {
    const skeleton: Skeleton = {
      name: 'gears',
      joints: [
        hinge(-1, { limits: [{ min: 0, max: 0 }] }),
        hinge(0),
        hinge(0, { couples: [{ dof: 'r', joint: 1, follows: 'r', gain: -2, offset: 0.1 }] }),
      ],
    };
    const dofs = poseOf(skeleton);
    const target = [0, 2 + Math.cos(0.7), Math.sin(0.7)] as const;
    expect(solve(ikProblem(skeleton, [{ joint: 2, point: [0, 1, 0], target }], dofs), dofs, 'settle').isSolved).toBe(
      true,
    );
    // The aim is 1e-5 of the reach, which is 2 here; the arm of the pin is 1.
    expectClose(dofs.subarray(3), [0, -0.3, 0.7], 2e-5);
  });
});

describe('a pin that holds', () => {
  it('a pin that holds stays while another is dragged where both can not be', () => {
    const skeleton: Skeleton = { name: 'fork', joints: [hinge(-1), hinge(0), hinge(0)] };
    const dofs = poseOf(skeleton);
    const held: IkPin = { joint: 1, point: [0, 0, 0], target: [0, 2, 0], holds: true };
    const dragged: IkPin = { joint: 2, point: [0, 0, 0], target: [0, 1, 1] };
    const { residuals } = solve(ikProblem(skeleton, [dragged, held], dofs), dofs, 'drag');
    expect(residuals[1]).toBeLessThan(residuals[0] / 50);
  });
});

describe('what is degenerate', () => {
  const expectStill = (skeleton: Skeleton, pins: readonly IkPin[]) => {
    for (const how of ['drag', 'settle'] as const) {
      const dofs = poseOf(skeleton);
      const { residuals, turns } = solve(ikProblem(skeleton, pins, dofs), dofs, how);
      expect([...dofs, ...residuals, ...turns].every(Number.isFinite)).toBe(true);
    }
  };

  it('what is degenerate makes no NaN: no length, a target in the pivot, nothing that moves, nothing pinned, tiny and huge', () => {
    const flat = chain(3, { offset: [0, 0, 0] });
    expectStill(flat, [{ joint: 2, point: [0, 0, 0], target: [1, 1, 1] }]);
    expectStill(flat, [{ joint: 2, point: [0, 0, 0], target: [0, 0, 0], orientation: [1, 0, 0, 0] }]);
    expectStill(chain(3), [endPin(3, 0, 0)]);
    expectStill(chain(1), [{ joint: 0, point: [0, 0, 0], target: [0, 0, 0] }]);
    expectStill({ name: 'still', joints: [joint(-1, { motion: { kind: 'fixed' }, limits: [], pose: [] })] }, [
      { joint: 0, point: [0, 1, 0], target: [3, 3, 3] },
    ]);
    expectStill(chain(3), []);
    expectStill(chain(3), [{ joint: 2, point: [0, 1e-200, 0], target: [0, 1e200, 0], weight: 1e-200 }]);
    expectStill(chain(3, { offset: [0, 1e-160, 0] }), [{ joint: 2, point: [0, 0, 0], target: [0, 1, 0] }]);
    expectStill(chain(3, { offset: [0, 1e160, 0] }), [{ joint: 2, point: [0, 0, 0], target: [0, 1, 1] }]);
    const squashed = joint(0, { motion: { kind: 'scale', mode: 'xyz', axis: [1, 0, 0] }, pose: [0, 0, 0] });
    expectStill({ name: 'squashed', joints: [joint(-1), squashed, joint(1)] }, [
      { joint: 2, point: [0, 1, 0], target: [0, 1, 1], orientation: [0, 1, 0, 1] },
    ]);
  });

  it('what is degenerate is refused as a pin, and as a target of one that is there', () => {
    const skeleton = chain(2);
    const dofs = poseOf(skeleton);
    const pin = endPin(2, 1, 1);
    const refused = (more: Partial<IkPin>) =>
      expect(() => ikProblem(skeleton, [{ ...pin, ...more }], dofs)).toThrow(IkError);
    refused({ target: [0, Number.NaN, 0] });
    refused({ point: [Infinity, 0, 0] });
    refused({ joint: 2 });
    refused({ weight: 0 });
    refused({ orientation: [0, 0, 0, 0] });
    const problem = ikProblem(skeleton, [pin], dofs);
    expect(movePin(problem, 0, 0, Number.NaN, 0)).toBe(false);
    expect(turnPin(problem, 0, [0, 0, 0, 0])).toBe(false);
    expect([...problem.pins.targets]).toEqual([0, 1, 1]);
    expect(solve(problem, dofs, 'drag').isSolved).toBe(true);
  });

  it('brings DOFs that are out of limits within them', () => {
    const skeleton = chain(2, { limits: [{ min: -0.5, max: 0.5 }] });
    const dofs = poseOf(skeleton).fill(2, 3);
    solve(ikProblem(skeleton, [endPin(2, 2, 0)], dofs), dofs, 'drag');
    const clamped = dofs.slice();
    clampDofs(compileSkeleton(skeleton), clamped);
    expect(clamped).toEqual(dofs);
  });
});
