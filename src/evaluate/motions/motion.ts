import type { Vec3 } from '../../math/vec3.ts';

/** A joint's own rule, specialised for its parameters (axes, order). */
export interface JointMotion {
  /** Writes J(φ) as 16 numbers at `out[o]`; φ starts at `dofs[first]`. */
  write(dofs: Float64Array, first: number, out: Float64Array, o: number): void;
  /**
   * Writes ∂J/∂φ for the joint's DOF `dof` (from 0) as 16 numbers at `out[o]`: its last row is 0, and so is its last
   * column if the DOF moves no pivot.
   */
  writeDerivative(dofs: Float64Array, first: number, dof: number, out: Float64Array, o: number): void;
  /** Whether the 3×3 part of J can be other than a rotation: scales and shear. */
  readonly stretches?: boolean;
  /**
   * Where J is a product of three factors or more, which of them `write` multiplies first, so that others get the same
   * doubles: those on the right; absent: those on the left.
   */
  readonly groups?: 'right';
  /**
   * J as a product of screws, from left to right, for motions other than quaternions that don't stretch. Inverse
   * kinematics is fast with them; without them it uses `writeDerivative`.
   */
  readonly screws?: readonly Screw[];
  /** J as a product of screws and, after them, a constant rotation of 9 numbers, column-major. */
  readonly turned?: { readonly screws: readonly Screw[]; readonly by: Float64Array };
  /**
   * J as a product of translations, rotations and scales, from left to right, for motions that stretch: each changes
   * smoothly with the DOFs. Programs without general matrices show it by a chain of nodes.
   */
  readonly parts?: readonly MotionPart[];
}

/** One factor of J: a translation or a scale (x y z), or a rotation (unit quaternion x y z w). */
export interface MotionPart {
  readonly kind: 'translation' | 'rotation' | 'scale';
  /**
   * The DOF that it is along or about one of x, y, z (0, 1, 2), or that scales along several; absent: what a DOF does
   * to it is no such thing, or it is constant.
   */
  readonly by?: { readonly dof: number; readonly axes: readonly number[] };
  /** Writes the 3 or 4 numbers; φ starts at `dofs[first]`. */
  write(dofs: Float64Array, first: number, out: Float64Array): void;
}

/** T(slide · φ · axis) · R(axis, turn · φ): rotation about an axis through the origin and sliding along it. */
export interface Screw {
  /** Normalised. */
  readonly axis: Vec3;
  /** 1 if the DOF rotates, 0 if it only slides. */
  readonly turn: 0 | 1;
  readonly slide: number;
  /** Index among the joint's DOFs. */
  readonly dof: number;
}

const AXES: readonly Vec3[] = [
  [1, 0, 0],
  [0, 1, 0],
  [0, 0, 1],
];

/** About x, y or z: `axis` 0, 1 or 2. */
export function turnScrew(axis: number, dof: number): Screw {
  return { axis: AXES[axis], turn: 1, slide: 0, dof };
}

/** Along x, y or z. */
export function slideAlong(axis: number, dof: number): Screw {
  return { axis: AXES[axis], turn: 0, slide: 1, dof };
}
