/**
 * The rotations that samples gave to the joints of one pose, beside its DOFs. Between two frames, samples give a joint's
 * rotation as a quaternion, and the pose takes its Euler angles; a matrix made of those costs six sines and cosines more
 * than one made of the quaternion. So both travel from `poseFrom` to `worldMatrices`.
 *
 *     8 numbers a joint, at 8 · joint:  φ φ φ  x y z w  −
 *
 * φ are the angles that came of the quaternion, in the order in which they are applied. The quaternion counts only while
 * the joint's DOFs equal them: limits, linked DOFs, values set by hand, or whatever else overrides the samples, then have
 * nothing to clear, and none of them can forget to. They belong to one `PoseSource`, so nothing is another character's,
 * rotation order's or clip's; each pose between two frames rewrites those of all joints that its samples turn.
 */
export class PoseRotations {
  /** Whether the last pose had any: those of an earlier time don't count. */
  areGiven = false;
  /** The first φ is NaN, which no angle equals, where the samples gave no rotation. */
  readonly values: Float64Array;

  constructor(jointCount: number) {
    this.values = new Float64Array(8 * jointCount).fill(Number.NaN);
  }
}
