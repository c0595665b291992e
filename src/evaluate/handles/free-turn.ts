/**
 * Rotates a joint freely about any axis and decomposes the rotation into its DOFs. Euler angles are the nearest to the
 * previous ones, so that nothing flips; a quaternion keeps its sign.
 */
import { eulerNear, quaternionOfEuler } from '../../math/euler.ts';
import { determinant3, invertAffine, isSingular, multiplyAffine } from '../../math/mat4.ts';
import { transformVector, unit, type Vec3 } from '../../math/vec3.ts';
import { coupleOf } from '../../model/skeleton/couples.ts';
import { dofsOf, quaternionDofs } from '../../model/skeleton/joint-types.ts';
import type { EulerOrder, Joint, Skeleton } from '../../model/skeleton/skeleton.ts';
import { compileSkeleton } from '../kinematics.ts';
import { eulerDofs, renamedAxes } from '../rotations/euler-dofs.ts';
import { frameOf } from './dof-axes.ts';

/** The DOFs of a joint that make up a whole rotation, as indices into the character's. */
export interface FreeTurn {
  readonly joint: number;
  /** Three angles about x, y and z, or a quaternion's x y z w. */
  readonly dofs: readonly number[];
  /** Order in which the angles are applied; absent for a quaternion. */
  readonly order?: EulerOrder;
}

/** Undefined if the joint can't rotate about every axis, or one of those DOFs is linked. */
export function freeTurn(skeleton: Skeleton, joint: number): FreeTurn | undefined {
  const { motion } = skeleton.joints[joint];
  const first = compileSkeleton(skeleton).firstDof[joint];
  const euler = eulerDofs(motion);
  if (!euler) {
    const dofs = quaternionDofs(motion).map((d) => first + d);
    return dofs.length ? { joint, dofs } : undefined;
  }
  const dofs = [euler.x, euler.y, euler.z].map((d) => first + d);
  if (dofs.some((dof) => coupleOf(skeleton, dof))) return undefined;
  return { joint, dofs, order: euler.order };
}

/** The frame of the rotation: everything to its left in J is constant while these DOFs change. */
function frameOfTurn(
  skeleton: Skeleton,
  { joint, dofs: turning }: FreeTurn,
  dofs: Float64Array,
  world: Float64Array,
  placement: Float64Array,
): Float64Array {
  const { motions, firstDof } = compileSkeleton(skeleton);
  const own = dofsOf(skeleton.joints[joint].motion);
  const first = firstDof[joint];
  const isTurning = own.map((_, d) => turning.includes(first + d));
  const from = isTurning.indexOf(true);
  // Factors listed before the angles are multiplied before them; those after them don't matter.
  const before = dofs.slice();
  own.forEach((dof, d) => {
    if (d >= from) before[first + d] = dof.rest;
  });
  const J = new Float64Array(16);
  motions[joint].write(before, first, J, 0);
  const frame = frameOf(skeleton, joint, dofs, world, placement);
  multiplyAffine(frame, 0, J, 0, frame, 0);
  return frame;
}

/** A free rotation in progress: accumulates rotations and updates the angles. */
export class Turning {
  /** x y z w, in the frame of the rotation. */
  private readonly q = new Float64Array(4);
  private readonly values: Float64Array;
  private readonly toFrame = new Float64Array(16);
  private readonly isMirrored: boolean;

  /** Takes the pose at the start, with parameters as for `dofAxes`. */
  constructor(
    skeleton: Skeleton,
    readonly turn: FreeTurn,
    dofs: Float64Array,
    world: Float64Array,
    placement: Float64Array,
  ) {
    const frame = frameOfTurn(skeleton, turn, dofs, world, placement);
    this.isMirrored = determinant3(frame) < 0;
    // If the frame above is singular, rotates as if it were the identity.
    if (isSingular(frame)) this.toFrame.set([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
    else invertAffine(frame, 0, this.toFrame, 0);
    this.values = Float64Array.from(turn.dofs, (dof) => dofs[dof]);
    this.readQuaternion();
  }

  /**
   * Rotates the joint further about an axis.
   * @param axis unit vector in the world
   * @param angle radians
   */
  by(axis: Vec3, angle: number): void {
    const own = unit(transformVector(this.toFrame, axis));
    if (!own) return;
    const half = (this.isMirrored ? -angle : angle) / 2;
    const s = Math.sin(half);
    const [ax, ay, az, aw] = [own[0] * s, own[1] * s, own[2] * s, Math.cos(half)];
    const [x, y, z, w] = this.q;
    this.q[0] = aw * x + ax * w + ay * z - az * y;
    this.q[1] = aw * y + ay * w + az * x - ax * z;
    this.q[2] = aw * z + az * w + ax * y - ay * x;
    this.q[3] = aw * w - ax * x - ay * y - az * z;
    const length = Math.hypot(...this.q);
    for (let k = 0; k < 4; k++) this.q[k] /= length;
    this.writeValues();
  }

  /** The current value of each of these DOFs, before limits. */
  get result(): readonly number[] {
    return [...this.values];
  }

  private readQuaternion(): void {
    const { q, values, turn } = this;
    if (!turn.order) {
      const length = Math.hypot(...values);
      for (let k = 0; k < 4; k++) q[k] = length > 0 ? values[k] / length : k === 3 ? 1 : 0;
      return;
    }
    const { axes, sign } = renamedAxes(turn.order);
    const [a, b, c] = axes.map((axis) => (sign * values[axis]) / 2);
    const renamed = new Float64Array(4);
    quaternionOfEuler(a, b, c, renamed, 0);
    axes.forEach((axis, k) => {
      q[axis] = sign * renamed[k];
    });
    q[3] = renamed[3];
  }

  private writeValues(): void {
    const { q, values, turn } = this;
    if (!turn.order) {
      const [x, y, z, w] = values;
      const isFar = q[0] * x + q[1] * y + q[2] * z + q[3] * w < 0;
      for (let k = 0; k < 4; k++) values[k] = isFar ? -q[k] : q[k];
      return;
    }
    const { axes, sign } = renamedAxes(turn.order);
    const renamed = Float64Array.of(...axes.map((axis) => sign * q[axis]), q[3]);
    const angles = Float64Array.from(axes, (axis) => sign * values[axis]);
    eulerNear(renamed, angles, 0);
    axes.forEach((axis, k) => {
      values[axis] = sign * angles[k];
    });
  }
}

/** Whether a joint has DOFs that only rotate it together: those of a quaternion. */
export function turnsOnlyFreely({ motion }: Pick<Joint, 'motion'>): boolean {
  return quaternionDofs(motion).length > 0;
}
