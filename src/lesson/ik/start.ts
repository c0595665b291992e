/** The pose that a solver of inverse kinematics starts from, and how points of joints move there. */
import { ikStiffness } from '../../evaluate/ik/pins.ts';
import { applyConstraints, type CompiledSkeleton, compileSkeleton, worldMatrices } from '../../evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../evaluate/pose.ts';
import { length3, scaled, subtract, transformPoint, type Vec3 } from '../../math/vec3.ts';
import type { Character } from '../../model/document.ts';
import type { Skeleton } from '../../model/skeleton.ts';
import { matrixError, pointError } from '../errors.ts';
import type { FrameTime } from '../evaluator.ts';
import { inFilePose } from '../file-pose.ts';
import { relativeMatrices } from '../relative.ts';
import type { FrameTarget } from '../targets.ts';
import type { EndEffector, Goal } from './goal.ts';

/** Radians or lengths: the derivative of a rotation by central differences is exact to twelve digits then. */
const DIFFERENCE = 1e-6;

/** A point before a step. */
export interface SeenPoint {
  readonly effector: EndEffector;
  readonly position: Vec3;
  /** e = target − p. */
  readonly error: Vec3;
  /** J: ∂p/∂φ of each variable. */
  readonly columns: readonly Vec3[];
}

export class SolverStart {
  readonly pose: Float64Array;
  /** DOFs that a solver may change: all but root translation and bone lengths. */
  readonly variables: readonly number[];
  private readonly compiled: CompiledSkeleton;
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
    this.world = new Float64Array(16 * this.compiled.jointCount);
    this.moved = new Float64Array(this.pose.length);
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

  /** The next call overwrites them. */
  matrices(pose: Float64Array): Float64Array {
    worldMatrices(this.compiled, pose, this.world);
    return this.world;
  }

  /** From the goal's target. */
  distance(pose: Float64Array, { joint, point, target }: Goal): number {
    return length3(...subtract(target, transformPoint(this.matrices(pose), point, 16 * joint)));
  }

  /** Points, and J of each, at a pose. */
  see(effectors: readonly EndEffector[], target: Vec3, pose: Float64Array = this.pose): readonly SeenPoint[] {
    const at = (shifted: Float64Array) => {
      const world = this.matrices(shifted);
      return effectors.map(({ joint, point }) => transformPoint(world, point, 16 * joint));
    };
    const positions = at(pose);
    const columns = effectors.map((): Vec3[] => []);
    for (const dof of this.variables) {
      const [more, less] = [DIFFERENCE, -DIFFERENCE].map((by) => at(this.shifted(pose, dof, by)));
      columns.forEach((column, i) => {
        column.push(scaled(subtract(more[i], less[i]), 0.5 / DIFFERENCE));
      });
    }
    return effectors.map((effector, i) => ({
      effector,
      position: positions[i],
      error: subtract(target, positions[i]),
      columns: columns[i],
    }));
  }

  private shifted(pose: Float64Array, dof: number, by: number): Float64Array {
    const { moved, compiled } = this;
    moved.set(pose);
    moved[dof] += by;
    applyConstraints(compiled, moved, false);
    return moved;
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
