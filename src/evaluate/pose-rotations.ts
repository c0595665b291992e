/**
 * The rotations that samples gave to the joints of one pose, beside its DOFs. Between two frames, samples give a joint's
 * rotation as a quaternion, and the pose takes its Euler angles; a matrix made of those costs six sines and cosines more
 * than one made of the quaternion. So both travel from `poseFrom` to `worldMatrices`.
 *
 *     8 numbers a joint, at 8 · joint:  φ φ φ  x y z w  −
 *
 * φ are the angles that came of the quaternion, in the order in which they are applied. The quaternion counts only while
 * the joint's DOFs equal them: limits, linked DOFs, values set by hand, or whatever else overrides the samples, then have
 * nothing to clear, and none of them can forget to. `poseFrom` clears all before each pose, so nothing is left of
 * another time or rotation order; and they belong to one player, so nothing is another character's.
 */
export class PoseRotations {
  /** The first φ is NaN, which no angle equals, where the samples gave no rotation. */
  readonly values: Float64Array;

  constructor(jointCount: number) {
    this.values = new Float64Array(8 * jointCount).fill(Number.NaN);
  }

  clear(): void {
    for (let o = 0; o < this.values.length; o += 8) this.values[o] = Number.NaN;
  }
}
