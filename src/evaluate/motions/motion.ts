import type { Vec3 } from '../../math/vec3.ts';

/** A joint's own rule, with what its motion says (axes, order) worked out. */
export interface JointMotion {
  /** Writes J(φ) as 16 numbers at `out[o]`; φ begins at `dofs[first]`. */
  write(dofs: Float64Array, first: number, out: Float64Array, o: number): void;
  /**
   * Writes ∂J/∂φ of the joint's DOF number `dof` (0 is its first) as 16 numbers at `out[o]`: its last row is 0, and so
   * is its last column where the DOF moves no pivot.
   */
  writeDerivative(dofs: Float64Array, first: number, dof: number, out: Float64Array, o: number): void;
  /** Whether the 3×3 part of J can be anything but a rotation: scales and shear. */
  readonly stretches?: boolean;
  /**
   * J as a product of screws, from left to right, where it is one: of a motion that doesn't stretch, but for that of a
   * quaternion. Inverse kinematics is quick with them; without them it goes by `writeDerivative`.
   */
  readonly screws?: readonly Screw[];
}

/** T(slide · φ · axis) · R(axis, turn · φ): turning about an axis through the origin and sliding along it. */
export interface Screw {
  /** Of length 1. */
  readonly axis: Vec3;
  /** 1 where the DOF turns, 0 where it only slides. */
  readonly turn: 0 | 1;
  readonly slide: number;
  /** Which of the joint's DOFs it is. */
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
