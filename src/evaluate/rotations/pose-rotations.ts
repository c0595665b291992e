/**
 * The joint rotations that samples gave for a pose, beside its DOFs. Between two frames, samples give a joint's
 * rotation as a quaternion, and the pose takes its Euler angles; making a matrix of these takes six more sines and
 * cosines than of the quaternion. So both are passed from `poseFrom` to `worldMatrices`.
 *
 *     8 numbers per joint, at 8 · joint:  φ φ φ  x y z w  −
 *
 * φ are the angles of the quaternion, in order of application. The quaternion is used only while the joint's DOFs equal
 * them, so that limits, linked DOFs, unkeyed changes, or anything else that overrides the samples need not clear it.
 * Rotations belong to one `PoseSource`, and so to one character, rotation order and take; each pose between two frames
 * overwrites those of all joints that its samples rotate.
 */
export class PoseRotations {
  /** Whether the last pose had any; those of an earlier time don't count. */
  areGiven = false;
  /** If samples gave no rotation, the first φ is NaN, which equals no angle. */
  readonly values: Float64Array;

  constructor(jointCount: number) {
    this.values = new Float64Array(8 * jointCount).fill(Number.NaN);
  }
}
