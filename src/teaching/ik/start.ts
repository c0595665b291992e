/** The pose that a solver of inverse kinematics starts from, and how points of joints move there. */
import { ikStiffness } from '../../evaluate/ik/pins.ts';
import { applyConstraints, type CompiledSkeleton, compileSkeleton, worldMatrices } from '../../evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../evaluate/pose.ts';
import { length3, subtract, transformPoint, type Vec3 } from '../../math/vec3.ts';
import type { Character } from '../../model/document.ts';
import { dofsOf } from '../../model/skeleton/joint-types.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { matrixError, pointError } from '../compare/errors.ts';
import { relativeMatrices } from '../compare/relative.ts';
import type { FrameTarget } from '../compare/targets.ts';
import type { FrameTime } from '../program/evaluator.ts';
import { inFilePose } from '../program/file-pose.ts';
import type { EndEffector, Goal } from './goal.ts';
import { Jacobian, type SeenPoint } from './jacobian.ts';

/** The pose of a character from which a solver starts, with what is needed to move it. */
export class SolverStart {
  readonly pose: Float64Array;
  /** DOFs that a solver may change: all but root translation and bone lengths. */
  readonly variables: readonly number[];
  /** Joint of each variable. */
  readonly jointOf: readonly number[];
  /** Whether each variable is one. */
  readonly isAngle: readonly boolean[];
  readonly compiled: CompiledSkeleton;
  private readonly jacobian: Jacobian;
  private readonly world: Float64Array;
  private readonly moved: Float64Array;

  /** @param time of the pose; undefined for the file pose */
  constructor(
    readonly character: Character,
    readonly skeleton: Skeleton,
    time: FrameTime,
  ) {
    this.compiled = compileSkeleton(skeleton);
    this.pose = new Float64Array(dofCountOf(character));
    poseAt(time === undefined ? inFilePose(character) : character, time ?? 0, this.pose);
    const stiffness = ikStiffness(skeleton, false);
    this.variables = [...stiffness.keys()].filter((dof) => stiffness[dof] < Infinity);
    const { firstDof } = this.compiled;
    const joints = skeleton.joints.flatMap((_, j) => Array.from({ length: firstDof[j + 1] - firstDof[j] }, () => j));
    const units = skeleton.joints.flatMap(({ motion }) => dofsOf(motion).map(({ unit }) => unit));
    this.isAngle = this.variables.map((dof) => units[dof - firstDof[0]] === 'angle');
    this.jointOf = this.variables.map((dof) => joints[dof - firstDof[0]]);
    this.world = new Float64Array(16 * this.compiled.jointCount);
    this.moved = new Float64Array(this.pose.length);
    this.jacobian = new Jacobian(this.compiled, this.pose, this.variables);
  }

  /** The pose after a step, within the limits. @param step the change of each variable */
  after(step: readonly number[], pose: Float64Array = this.pose): Float64Array {
    const { moved, variables, compiled, character } = this;
    moved.set(pose);
    variables.forEach((dof, v) => {
      moved[dof] += step[v];
    });
    applyConstraints(compiled, moved, character.clampsToLimits);
    return moved;
  }

  /** A DOF that follows none after a step, within its limits. */
  clamped(dof: number, by: number): number {
    const { lower, upper, firstDof } = this.compiled;
    const value = this.pose[dof] + by;
    const limit = dof - firstDof[0];
    return this.character.clampsToLimits ? Math.min(upper[limit], Math.max(lower[limit], value)) : value;
  }

  /** A joint's place in its parent's space; undefined if its own DOFs move it. */
  fixedOffset(joint: number): Vec3 | undefined {
    return this.jacobian.offsetOf(joint);
  }

  /** The next call overwrites them. */
  matrices(pose: Float64Array): Float64Array {
    worldMatrices(this.compiled, pose, this.world);
    return this.world;
  }

  /** From the goal's target. */
  distance(pose: Float64Array, { joint, point, target }: Goal): number {
    return length3(...subtract(target, transformPoint(this.matrices(pose), point, 16 * joint)));
  }

  /** A point, and its J, at a pose. */
  see(effector: EndEffector, target: Vec3, pose: Float64Array = this.pose): SeenPoint {
    const { compiled, variables } = this;
    const jacobian = pose === this.pose ? this.jacobian : new Jacobian(compiled, pose, variables);
    return jacobian.see(effector, target);
  }

  /** How far a dump is from a pose, as `compare` measures it. */
  error({ world, local, positions }: FrameTarget, pose: Float64Array, size: number): number {
    const own = this.matrices(pose);
    const { joints } = this.skeleton;
    const relative = local && relativeMatrices(own, joints);
    let error = 0;
    for (let j = 0; j < joints.length; j++) {
      const o = 16 * j;
      if (world) error = Math.max(error, matrixError(world, own, o, size));
      if (local && relative) error = Math.max(error, matrixError(local, relative, o, size));
      if (positions) error = Math.max(error, pointError(positions, 3 * j, own, o + 12, size));
    }
    return error;
  }
}
