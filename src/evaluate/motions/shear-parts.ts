/**
 * Shear as rotations and scales. One shear u′ = u + s·v in a plane u v is
 *
 *     R(45° − ½·atan(s/2)) · diag(√(1 + s²/4) + s/2, √(1 + s²/4) − s/2) · R(−45° − ½·atan(s/2))
 *
 * with rotations from u to v: its singular values, but smooth in s, also through 0. Three shears are their product, the
 * one in y z first:
 *
 *     │ 1 hxy hxz │   │ 1         │   │ 1 hxy     │   │ 1     hxz │
 *     │    1  hyz │ = │    1  hyz │ · │    1      │ · │    1      │
 *     │         1 │   │         1 │   │         1 │   │         1 │
 */
import type { MotionPart } from './motion.ts';

/** From left to right: [u, v, DOF]. */
const SHEARS = [
  [1, 2, 2],
  [0, 1, 0],
  [0, 2, 1],
] as const;

/** Nine parts whose product is the matrix of a shear joint: rotation, scale and rotation for each of its DOFs. */
export function shearParts(): readonly MotionPart[] {
  return SHEARS.flatMap(([u, v, dof]) => {
    const turn = (by: number): MotionPart => ({
      kind: 'rotation',
      write(dofs, first, out) {
        const half = (by * Math.PI) / 8 - Math.atan(dofs[first + dof] / 2) / 4;
        out.fill(0);
        // From z to x is positive about y, so from x to z is negative.
        out[3 - u - v] = (v - u === 1 ? 1 : -1) * Math.sin(half);
        out[3] = Math.cos(half);
      },
    });
    const stretch: MotionPart = {
      kind: 'scale',
      write(dofs, first, out) {
        const half = dofs[first + dof] / 2;
        const root = Math.sqrt(1 + half * half);
        out.fill(1);
        // Their product is 1: no difference of nearly equal numbers.
        out[u] = half < 0 ? 1 / (root - half) : root + half;
        out[v] = half < 0 ? root - half : 1 / (root + half);
      },
    };
    return [turn(1), stretch, turn(-1)];
  });
}
