import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { dofAxes } from '../../../src/evaluate/handles/dof-axes.ts';
import { freeTurn, Turning } from '../../../src/evaluate/handles/free-turn.ts';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { multiplyAffine } from '../../../src/math/mat4.ts';
import type { Vec3 } from '../../../src/math/vec3.ts';
import { add, cross, dot, scaled, unit } from '../../../src/math/vec3.ts';
import { characterDofs } from '../../../src/model/skeleton/dofs.ts';
import { dofsOf } from '../../../src/model/skeleton/joint-types.ts';
import {
  type CompoundDof,
  EULER_ORDERS,
  type Motion,
  type Skeleton,
  UNLIMITED,
} from '../../../src/model/skeleton/skeleton.ts';
import { joint } from '../../helpers/builders.ts';
import { expectClose } from '../../helpers/close.ts';

const EXACT = 1e-9;
const placement = Float64Array.of(0, -2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 5, -3, 1, 1);
const angle = fc.double({ min: -3, max: 3, noNaN: true });
const compounds: readonly (readonly CompoundDof[])[] = [
  ['rz', 'rx', 'ry'],
  ['tx', 'ry', 'rz', 'rx', 'ty'],
];
const turning: fc.Arbitrary<Motion> = fc.oneof(
  fc.constantFrom(...EULER_ORDERS).map((order): Motion => ({ kind: 'ball', order })),
  fc.constantFrom(...EULER_ORDERS).map((order): Motion => ({ kind: 'free', order })),
  fc.constantFrom(...compounds).map((dofs): Motion => ({ kind: 'compound', dofs })),
  fc.constant<Motion>({ kind: 'bvh', channels: ['tx', 'ty', 'tz', 'rz', 'rx', 'ry'], positions: 'replace' }),
  fc.constant<Motion>({ kind: 'quaternion' }),
);
const posed = turning.chain((of) => fc.tuple(fc.constant(of), fc.tuple(...dofsOf(of).map(() => angle))));

function rigOf(of: Motion, values: readonly number[]) {
  const skeleton: Skeleton = {
    name: 'rig',
    joints: [joint(-1), joint(0, { motion: of, limits: values.map(() => UNLIMITED), pose: values })],
  };
  const dofs = new Float64Array(characterDofs(skeleton, []).length);
  dofs.set([0.2, -0.1, 0.4, 0.7, -0.5, 0.3, ...values]);
  return { skeleton, dofs };
}

function worldOf(skeleton: Skeleton, dofs: Float64Array): Float64Array {
  const world = new Float64Array(16 * skeleton.joints.length);
  worldMatrices(compileSkeleton(skeleton), dofs, world);
  return world;
}

/** The second joint, in the world. */
function inWorld(skeleton: Skeleton, dofs: Float64Array): Float64Array {
  const out = new Float64Array(16);
  multiplyAffine(placement, 0, worldOf(skeleton, dofs), 16, out, 0);
  return out;
}

/** Rodrigues. */
function rotate(v: Vec3, axis: Vec3, by: number): Vec3 {
  const along = scaled(axis, dot(axis, v) * (1 - Math.cos(by)));
  return add(add(along, v, Math.cos(by)), cross(axis, v), Math.sin(by));
}

function turningOf(of: Motion, values: readonly number[]) {
  const { skeleton, dofs } = rigOf(of, values);
  const turn = freeTurn(skeleton, 1);
  if (!turn) throw new Error('It turns freely.');
  const made = new Turning(skeleton, turn, dofs, worldOf(skeleton, dofs), placement);
  const after = () => {
    const changed = dofs.slice();
    turn.dofs.forEach((dof, i) => {
      changed[dof] = made.result[i];
    });
    return changed;
  };
  return { skeleton, dofs, turn, made, after };
}

describe('turning freely', () => {
  it('turning freely turns the joint about the axis in the world, whatever its angles are called', () => {
    const axis = fc.tuple(angle, angle, angle).filter((v) => Math.hypot(...v) > 0.1);
    fc.assert(
      fc.property(posed, axis, angle, ([of, values], along, by) => {
        fc.pre(of.kind !== 'quaternion' || Math.hypot(...values) > 0.1);
        const { skeleton, dofs, made, after } = turningOf(of, values);
        const about = unit(along) ?? [1, 0, 0];
        const before = inWorld(skeleton, dofs);
        made.by(about, by / 2);
        made.by(about, by / 2);
        const now = inWorld(skeleton, after());
        for (const k of [0, 4, 8]) {
          const column: Vec3 = [before[k], before[k + 1], before[k + 2]];
          expectClose(now.slice(k, k + 3), rotate(column, about, by), 1e-7, `${of.kind} column ${k / 4}`);
        }
      }),
      { numRuns: 200 },
    );
  });

  it('changes nothing without a turn, and keeps whole turns', () => {
    fc.assert(
      fc.property(posed, fc.integer({ min: -2, max: 2 }), ([of, values], turns) => {
        fc.pre(of.kind !== 'quaternion');
        // Away from gimbal lock, where angles are what they are.
        const own = values.map((v, i) => (i === 0 ? v + 2 * Math.PI * turns : v));
        const { made, turn, dofs } = turningOf(of, own);
        made.by([1, 0, 0], 0);
        expectClose(
          made.result,
          turn.dofs.map((dof) => dofs[dof]),
          1e-6,
        );
      }),
      { numRuns: 150 },
    );
  });

  it('about a DOF’s own axis changes that DOF alone, if it is the last applied', () => {
    for (const order of EULER_ORDERS) {
      const { skeleton, dofs, made, turn } = turningOf({ kind: 'ball', order }, [0.3, -0.4, 0.5]);
      const axes = dofAxes(skeleton, 1, dofs, worldOf(skeleton, dofs), placement);
      const last = 'xyz'.indexOf(order[2]);
      made.by(axes[last].axis, 0.25);
      const expected = turn.dofs.map((dof, i) => dofs[dof] + (i === last ? 0.25 : 0));
      expectClose(made.result, expected, EXACT, order);
    }
  });

  it('turning freely never flips on the way round', () => {
    const { made } = turningOf({ kind: 'ball', order: 'xyz' }, [0.1, 0.2, 0.3]);
    const axis = unit([0.2, 1, 0.3]) ?? [0, 1, 0];
    let last = made.result;
    for (let step = 0; step < 400; step++) {
      made.by(axis, Math.PI / 100);
      const next = made.result;
      expect(Math.max(...next.map((v, i) => Math.abs(v - last[i])))).toBeLessThan(0.5);
      last = next;
    }
  });

  it('turning freely keeps a quaternion of length 1, on the side it was on', () => {
    const { made } = turningOf({ kind: 'quaternion' }, [0, 0, 0, -2]);
    made.by([0, 1, 0], 0.1);
    expect(Math.hypot(...made.result)).toBeCloseTo(1, 12);
    expect(made.result[3]).toBeLessThan(0);
  });

  it('turning freely is not for joints of fewer axes, nor if an angle is linked', () => {
    const hinge = rigOf({ kind: 'hinge', axis: [1, 0, 0] }, [0]).skeleton;
    expect(freeTurn(hinge, 1)).toBeUndefined();
    const { skeleton } = rigOf({ kind: 'ball', order: 'xyz' }, [0, 0, 0]);
    const couples = [{ dof: 'rx', joint: 0, follows: 'rx', gain: 1, offset: 0 }];
    const tied = { ...skeleton, joints: [skeleton.joints[0], { ...skeleton.joints[1], couples }] };
    expect(freeTurn(tied, 1)).toBeUndefined();
  });
});
