/** Rotations as Euler angles of any order and as quaternions x y z w. */
import { eulerNear, quaternionOfEuler } from '../../math/euler.ts';
import type { EulerOrder } from '../../model/skeleton/skeleton.ts';

/** Indices of the axes of an order, first applied first, and 1 or −1: whether they are a cycle of x y z. */
interface Axes {
  readonly axes: readonly [number, number, number];
  readonly sign: 1 | -1;
}

const AXES: { readonly [O in EulerOrder]: Axes } = {
  xyz: { axes: [0, 1, 2], sign: 1 },
  yzx: { axes: [1, 2, 0], sign: 1 },
  zxy: { axes: [2, 0, 1], sign: 1 },
  xzy: { axes: [0, 2, 1], sign: -1 },
  yxz: { axes: [1, 0, 2], sign: -1 },
  zyx: { axes: [2, 1, 0], sign: -1 },
};

const scratch = new Float64Array(4);

/**
 * Writes the quaternion of angles about x, y and z, in radians, at `out[0]`. Renaming the axes so that they are x y z
 * mirrors if they are no cycle, which negates all angles.
 */
export function writeQuaternion(order: EulerOrder, angles: ArrayLike<number>, out: Float64Array): void {
  const { axes, sign } = AXES[order];
  const half = sign / 2;
  quaternionOfEuler(half * angles[axes[0]], half * angles[axes[1]], half * angles[axes[2]], scratch, 0);
  for (let k = 0; k < 3; k++) out[axes[k]] = sign * scratch[k];
  out[3] = scratch[3];
}

const turned = new Float64Array(3);

/** Replaces angles about x, y and z by the nearest ones that give the unit quaternion. */
export function writeAnglesNear(order: EulerOrder, q: Float64Array, angles: Float64Array): void {
  const { axes, sign } = AXES[order];
  for (let k = 0; k < 3; k++) {
    scratch[k] = sign * q[axes[k]];
    turned[k] = sign * angles[axes[k]];
  }
  scratch[3] = q[3];
  eulerNear(scratch, turned, 0);
  // Adding 0 turns −0 into 0.
  for (let k = 0; k < 3; k++) angles[axes[k]] = sign * turned[k] + 0;
}

/** The largest |sin β| of the middle angle of unit quaternions, 4 numbers each: 1 is gimbal lock. */
export function lockedness(order: EulerOrder, all: ArrayLike<number>): number {
  const {
    axes: [i, j, k],
    sign,
  } = AXES[order];
  let most = 0;
  for (let o = 0; o < all.length; o += 4) {
    most = Math.max(most, Math.abs(2 * (all[o + 3] * sign * all[o + j] - all[o + i] * all[o + k])));
  }
  return most;
}

/** `out = a · b`: first b, then a. `out` may be either. */
export function multiplyQuaternions(a: ArrayLike<number>, b: ArrayLike<number>, out: Float64Array): void {
  const x = a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1];
  const y = a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0];
  const z = a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3];
  const w = a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2];
  out[0] = x;
  out[1] = y;
  out[2] = z;
  out[3] = w;
}

/** The axes of an order, the one that is turned about first first; at right angles of the second there is gimbal lock. */
export function axesOfOrder(order: EulerOrder): readonly [number, number, number] {
  return AXES[order].axes;
}

/** The two orders that turn about an axis first. */
export function ordersFrom(axis: number): readonly [EulerOrder, EulerOrder] {
  return axis === 0 ? ['xyz', 'xzy'] : axis === 1 ? ['yxz', 'yzx'] : ['zxy', 'zyx'];
}
