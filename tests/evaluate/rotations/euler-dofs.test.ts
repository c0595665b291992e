import { describe, expect, it } from 'vitest';
import { jointMotion } from '../../../src/evaluate/motions.ts';
import { appliedDofs, eulerDofs, renamedAxes } from '../../../src/evaluate/rotations/euler-dofs.ts';
import { quaternionOfEuler } from '../../../src/math/euler.ts';
import { writeRotation } from '../../../src/math/quaternion.ts';
import type { EulerOrder, Motion } from '../../../src/model/skeleton/skeleton.ts';

const ORDERS: readonly EulerOrder[] = ['xyz', 'xzy', 'yxz', 'yzx', 'zxy', 'zyx'];
/** Rounding of a few products of sines and cosines. */
const EXACT = 1e-15;

describe.each(ORDERS)('the order %s', (order) => {
  it('is Rz(γ)·Ry(β)·Rx(α) with its axes renamed, and mirrored where the sign says so', () => {
    const angles = [0.3, -1.1, 2.4];
    const expected = new Float64Array(16);
    jointMotion({ kind: 'ball', order }).write(Float64Array.from(angles), 0, expected, 0);

    const { axes, sign } = renamedAxes(order);
    const renamed = new Float64Array(4);
    const [alpha, beta, gamma] = axes.map((axis) => (sign * angles[axis]) / 2);
    quaternionOfEuler(alpha, beta, gamma, renamed, 0);
    const q = [0, 0, 0];
    axes.forEach((axis, k) => {
      q[axis] = sign * renamed[k];
    });
    const made = new Float64Array(9);
    writeRotation(q[0], q[1], q[2], renamed[3], made, 0, 3);
    for (let c = 0; c < 3; c++) {
      for (let r = 0; r < 3; r++) expect(Math.abs(made[3 * c + r] - expected[4 * c + r])).toBeLessThan(EXACT);
    }
  });

  it('says which DOF is applied first, second and last', () => {
    const motion: Motion = { kind: 'free', order };
    const euler = eulerDofs(motion);
    // tx ty tz rx ry rz
    expect(euler && appliedDofs(euler)).toEqual([...order].map((axis) => 3 + 'xyz'.indexOf(axis)));
  });
});
