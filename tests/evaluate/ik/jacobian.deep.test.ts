import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { evaluatePose, orientationError } from '../../../src/evaluate/ik/forward.ts';
import { writeJacobian } from '../../../src/evaluate/ik/jacobian.ts';
import { type IkPin, ikStiffness } from '../../../src/evaluate/ik/pins.ts';
import { ikProblem } from '../../../src/evaluate/ik/problem.ts';
import { aimPins } from '../../../src/evaluate/ik/reach.ts';
import type { IkProblem } from '../../../src/evaluate/ik/state.ts';
import { applyConstraints, compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { jointMotion } from '../../../src/evaluate/motions.ts';
import { filePose } from '../../../src/model/skeleton/dofs.ts';
import { dofsOf } from '../../../src/model/skeleton/joint-types.ts';
import { bvhMotion, motion } from '../../formats/arbitraries.ts';
import { joint } from '../../helpers/builders.ts';
import { expectClose } from '../../helpers/close.ts';
import { type AnyProblem, anyProblem } from './any-problem.ts';

function errorsAt(problem: IkProblem, dofs: Float64Array): Float64Array {
  evaluatePose(problem, dofs);
  return problem.errors.slice();
}

function expectSlopes({ skeleton, pins }: AnyProblem, clamps: boolean): void {
  const stiffness = ikStiffness(skeleton, true).fill(1);
  stiffness[0] = 2.5;
  const pose = Float64Array.from(filePose(skeleton, 0));
  const problem = ikProblem(skeleton, pins, pose, { stiffness, clamps });
  applyConstraints(problem.skeleton, pose, clamps);
  evaluatePose(problem, pose);
  aimPins(problem.balls, problem.pins, problem.slots);
  evaluatePose(problem, pose);
  // Near half a turn the turn left jumps from one side to the other.
  fc.pre(pins.every((_, p) => orientationError(problem.pins, p) < 2.9));
  writeJacobian(problem, pose);
  const { count, dof, scale, followers } = problem.variables;
  // A follower just on its own limit has a slope to one side only.
  const wanted = followers.gain.map((gain, f) => gain * pose[followers.follows[f]] + followers.offset[f]);
  fc.pre(wanted.every((w, f) => Math.abs(w - followers.lower[f]) > 1e-4 && Math.abs(w - followers.upper[f]) > 1e-4));
  const { jacobian } = problem;
  const h = 1e-6;
  for (let v = 0; v < count; v++) {
    const moved = (by: number) => {
      const other = pose.slice();
      other[dof[v]] += by * scale[v];
      return errorsAt(problem, other);
    };
    const [back, ahead] = [moved(-h), moved(h)];
    const slopes = ahead.map((e, r) => (e - back[r]) / (2 * h));
    const column = slopes.map((_, r) => jacobian[r * count + v]);
    expectClose(column, slopes, 2e-6 * Math.max(1, ...column.map(Math.abs)), `the column of DOF ${dof[v]}`);
  }
  expectShape(problem);
}

/** All that the shape leaves out is 0. */
function expectShape({ jacobian, shape, rows, variables: { count } }: IkProblem): void {
  const blocks = rows / 3;
  const moved = Array.from({ length: blocks }, (_, b) => {
    const listed = shape.column.subarray(shape.first[b], shape.first[b + 1]);
    const nonzero = Array.from({ length: count }, (_, v) => v).filter((v) =>
      [0, 1, 2].some((k) => jacobian[(3 * b + k) * count + v] !== 0),
    );
    expect(Array.from(listed)).toEqual(expect.arrayContaining(nonzero));
    expect(Array.from(listed)).toEqual(Array.from(listed).sort((v, w) => v - w));
    return nonzero;
  });
  moved.forEach((a, r) => {
    moved.forEach((b, c) => {
      for (const v of a) if (b.includes(v)) expect(v).toBeLessThan(shape.shared[r * blocks + c]);
    });
  });
}

describe('the Jacobian', () => {
  it('the Jacobian is what finite differences say, for joints of all kinds, with couples, points and orientations', () => {
    fc.assert(
      fc.property(anyProblem(false), (any) => expectSlopes(any, false)),
      { numRuns: 150 },
    );
  });

  it('knows that a linked DOF is constant at its own limit', () => {
    fc.assert(
      fc.property(anyProblem(true), (any) => expectSlopes(any, true)),
      { numRuns: 60 },
    );
  });
});

describe('the matrices of the joints that matter', () => {
  it('the solver’s matrices are those of forward kinematics wherever they are kept, for joints of all kinds on any tree', () => {
    fc.assert(
      fc.property(anyProblem(false), ({ skeleton, pins }) => {
        const pose = Float64Array.from(filePose(skeleton, 0));
        const problem = ikProblem(skeleton, pins, pose);
        applyConstraints(problem.skeleton, pose, true);
        const world = new Float64Array(16 * skeleton.joints.length);
        worldMatrices(problem.skeleton, pose, world);
        evaluatePose(problem, pose);
        const { joint: joints, isKept, worlds, count } = problem.slots;
        expect(isKept).toContain(1);
        const largest = Math.max(1, ...world.map(Math.abs));
        for (let s = 0; s < count; s++) {
          if (isKept[s] === 0) continue;
          const own = worlds.subarray(16 * s, 16 * s + 16);
          expectClose(own, world.subarray(16 * joints[s], 16 * joints[s] + 16), 1e-11 * largest, `joint ${joints[s]}`);
        }
      }),
      { numRuns: 150 },
    );
  });
});

describe('the screws of a joint', () => {
  it('the screws of a joint are its matrix, one after the other', () => {
    const posed = fc
      .oneof(motion, bvhMotion)
      .filter((of) => jointMotion(of).screws !== undefined && (of.kind !== 'screw' || Math.abs(of.pitch) < 100))
      .chain((of) =>
        fc.tuple(fc.constant(of), fc.tuple(...dofsOf(of).map(() => fc.double({ min: -4, max: 4, noNaN: true })))),
      );
    fc.assert(
      fc.property(posed, ([of, values]) => {
        const skeleton = { name: 'two', joints: [joint(-1, { motion: of }), joint(0, { motion: of })] };
        const compiled = compileSkeleton(skeleton);
        const dofs = new Float64Array(compiled.firstDof[2]);
        dofs.set([...values, ...values], compiled.firstDof[0]);
        const own = new Float64Array(32);
        worldMatrices(compiled, dofs, own);
        // A pin on each, so that both matrices are kept.
        const pins = [0, 1].map((j): IkPin => ({ joint: j, point: [0, 0, 0], target: [0, 0, 0] }));
        const problem = ikProblem(skeleton, pins, dofs);
        evaluatePose(problem, dofs);
        for (const o of [0, 16]) {
          const places = [0, 1, 2, 4, 5, 6, 8, 9, 10, 12, 13, 14].map((k) => o + k);
          expectClose(
            places.map((k) => problem.slots.worlds[k]),
            places.map((k) => own[k]),
            1e-12,
            of.kind,
          );
        }
        expect(jointMotion(of).stretches ?? false).toBe(false);
      }),
      { numRuns: 120 },
    );
  });

  it('the screws of a joint are missing only where there is something else than turns and slides', () => {
    fc.assert(
      fc.property(fc.oneof(motion, bvhMotion), (of) => {
        const stretches = of.kind === 'scale' || of.kind === 'shear' || dofsOf(of).some(({ name }) => /^s/.test(name));
        expect(jointMotion(of).stretches ?? false).toBe(stretches);
        expect(jointMotion(of).screws === undefined).toBe(stretches || of.kind === 'quaternion');
      }),
    );
  });
});
