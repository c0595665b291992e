/**
 * Points of joints at a pose, and how they move with the DOFs. Of each point only the joints on its path to the root
 * are looked at, so that many points of a long skeleton take little more than one.
 */
import { type CompiledSkeleton, localMatrices, worldMatrices } from '../../evaluate/kinematics.ts';
import { add, subtract, transformPoint, transformVector, type Vec3, ZERO } from '../../math/vec3.ts';
import type { EndEffector } from './goal.ts';

/** A point before a step. */
export interface SeenPoint {
  readonly effector: EndEffector;
  readonly position: Vec3;
  /** e = target − p. */
  readonly error: Vec3;
  /** J: ∂p/∂φ of each variable. */
  readonly columns: readonly Vec3[];
}

/** The Jacobian of points of joints at one pose. */
export class Jacobian {
  private readonly local: Float64Array;
  private readonly world: Float64Array;
  /** ∂L/∂φ, 16 per DOF of a joint. */
  private readonly derivatives: Float64Array;

  /** @param variables DOFs, for which J has a column each */
  constructor(
    private readonly compiled: CompiledSkeleton,
    pose: Float64Array,
    private readonly variables: readonly number[],
  ) {
    const { jointCount, dofCount, firstDof, motions } = compiled;
    this.local = new Float64Array(16 * jointCount);
    this.world = new Float64Array(16 * jointCount);
    this.derivatives = new Float64Array(16 * dofCount);
    localMatrices(compiled, pose, this.local);
    worldMatrices(compiled, pose, this.world);
    for (let j = 0; j < jointCount; j++) {
      for (let dof = firstDof[j]; dof < firstDof[j + 1]; dof++) {
        motions[j].writeDerivative(pose, firstDof[j], dof - firstDof[j], this.derivatives, 16 * (dof - firstDof[0]));
      }
    }
  }

  /**
   * Position, error and columns of J for a point; the error is target − position, in the space of the world matrices.
   */
  see(effector: EndEffector, target: Vec3): SeenPoint {
    const { parent, firstDof, couples } = this.compiled;
    const speeds = new Map<number, Vec3>();
    let point = effector.point;
    for (let j = effector.joint; j >= 0; j = parent[j]) {
      for (let dof = firstDof[j]; dof < firstDof[j + 1]; dof++) {
        const speed = transformPoint(this.derivatives, point, 16 * (dof - firstDof[0]));
        speeds.set(dof, parent[j] < 0 ? speed : transformVector(this.world, speed, 16 * parent[j]));
      }
      point = transformPoint(this.local, point, 16 * j);
    }
    // A linked DOF moves with the one that it follows, never by itself.
    for (const { dof, follows, gain } of couples.toReversed()) {
      const own = speeds.get(dof);
      if (own) speeds.set(follows, add(speeds.get(follows) ?? ZERO, own, gain));
      speeds.delete(dof);
    }
    const columns = this.variables.map((dof) => speeds.get(dof) ?? ZERO);
    return { effector, position: point, error: subtract(target, point), columns };
  }

  /** A joint's place in its parent's space; undefined if its own DOFs move it. */
  offsetOf(joint: number): Vec3 | undefined {
    const { firstDof } = this.compiled;
    for (let dof = firstDof[joint]; dof < firstDof[joint + 1]; dof++) {
      const o = 16 * (dof - firstDof[0]) + 12;
      if (this.derivatives.subarray(o, o + 3).some((part) => part !== 0)) return undefined;
    }
    return transformPoint(this.local, ZERO, 16 * joint);
  }
}
