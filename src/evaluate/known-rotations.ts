/**
 * Rotations of joints that are known beside their angles. Between two frames, samples give a rotation as a quaternion;
 * a pose is its angles, and from those the matrix takes six sines and cosines again. So what was known last stands here,
 * with the angles that came of it: where a joint has the very same ones, its matrix is the quaternion's. As it goes by
 * the angles' values, it does not matter whose they are, nor what limits or hands have changed since.
 *
 *     8 numbers a rotation, at 8 · (index of the DOF that is applied first):  φ φ φ  x y z w  −
 *
 * φ are the three angles in the order in which they are applied.
 */
export class KnownRotations {
  /** NaN, which no angle is, where nothing is known. */
  values = new Float64Array(0);

  /** Room for characters of so many DOFs. */
  reserve(dofCount: number): void {
    if (this.values.length < 8 * dofCount) this.values = new Float64Array(8 * dofCount).fill(Number.NaN);
  }
}
