/**
 * The pose of the skeleton that has the joints where a dump has them. It is found from the root outwards, at each joint
 * with those few levels below it that tell its DOFs, so that the work grows with the number of joints alone.
 */
import { type IkPin, ikStiffness } from '../../evaluate/ik/pins.ts';
import { ikProblem } from '../../evaluate/ik/problem.ts';
import { solve } from '../../evaluate/ik/solve.ts';
import { applyConstraints, compileSkeleton, worldMatrices } from '../../evaluate/kinematics.ts';
import { invertAffine, isSingular, multiplyAffine, setIdentity } from '../../math/mat4.ts';
import { length3, subtract, transformPoint, type Vec3, ZERO } from '../../math/vec3.ts';
import { type Joint, NO_BOX, type Skeleton } from '../../model/skeleton/skeleton.ts';
import type { FrameTarget } from '../compare/targets.ts';
import type { Goal } from './goal.ts';
import type { SolverStart } from './start.ts';

/** Levels below a joint by whose positions its angles are told: a straight knee tells nothing of the hip's twist. */
const LEVELS = 3;
/** In the space of the parent, which is this joint's: the root translation is no DOF of a solver. */
const PARENT: Joint = {
  name: '',
  parent: -1,
  offset: ZERO,
  box: NO_BOX,
  motion: { kind: 'fixed' },
  limits: [],
  pose: [],
};

/** The pose that has the joints, and the point of a goal, nearer than `near` to where they are said to be, if one has. */
export function dumpedPose(
  start: SolverStart,
  frame: FrameTarget,
  size: number,
  near: number,
  goal?: Goal,
): Float64Array | undefined {
  return new DumpedPose(start, frame, size, near, goal).found();
}

class DumpedPose {
  private readonly pose: Float64Array;
  private readonly world: Float64Array;
  private readonly stiffness: Float64Array;
  private readonly levels: number;
  private readonly points: readonly Vec3[];
  private readonly children: readonly (readonly number[])[];

  constructor(
    private readonly start: SolverStart,
    private readonly frame: FrameTarget,
    size: number,
    private readonly near: number,
    private readonly goal: Goal | undefined,
  ) {
    const { skeleton, pose } = start;
    this.pose = pose.slice();
    this.world = new Float64Array(16 * skeleton.joints.length);
    this.stiffness = ikStiffness(skeleton, false);
    // Of matrices, points on the axes tell the DOFs of each joint alone.
    this.levels = frame.world ? 0 : LEVELS;
    const axes: readonly Vec3[] = [ZERO, [size, 0, 0], [0, size, 0], [0, 0, size]];
    this.points = frame.world ? axes : [ZERO];
    const children = skeleton.joints.map((): number[] => []);
    skeleton.joints.forEach(({ parent }, j) => {
      if (parent >= 0) children[parent].push(j);
    });
    this.children = children;
  }

  found(): Float64Array | undefined {
    const { start, pose } = this;
    const { joints } = start.skeleton;
    if (!joints.every((_, j) => this.settle(j))) return undefined;
    // Linked DOFs were taken for free ones, and errors may have added up.
    applyConstraints(start.compiled, pose, start.character.clampsToLimits);
    const world = start.matrices(pose);
    const pins = joints.flatMap((_, j) => this.pinsOf(j));
    const isThere = pins.every(({ joint, point, target }) => {
      return length3(...subtract(target, transformPoint(world, point, 16 * joint))) <= this.near;
    });
    return isThere ? pose : undefined;
  }

  /** Finds the DOFs of a joint, whose parent's are known. @returns false if none have it and those below where they are */
  private settle(joint: number): boolean {
    const { start, pose, world } = this;
    const { compiled, skeleton, character } = start;
    const { firstDof, parent } = compiled;
    const members = this.membersOf(joint);
    const indexOf = new Map(members.map((member, i) => [member, i + 1]));
    const own: Skeleton = {
      name: '',
      joints: [
        PARENT,
        ...members.map((member): Joint => {
          const { couples: _linked, ...free } = skeleton.joints[member];
          return { ...free, parent: indexOf.get(parent[member]) ?? 0 };
        }),
      ],
    };
    const above = this.parentMatrix(parent[joint]);
    if (isSingular(above)) return false;
    const toParent = new Float64Array(16);
    invertAffine(above, 0, toParent, 0);
    const pins = members.flatMap((member) =>
      this.pinsOf(member).map((pin) => ({
        ...pin,
        joint: indexOf.get(member) ?? 0,
        target: transformPoint(toParent, pin.target),
      })),
    );
    const ofMembers = (values: Float64Array) =>
      members.flatMap((member) => [...values.subarray(firstDof[member], firstDof[member + 1])]);
    const dofs = Float64Array.from([0, 0, 0, ...ofMembers(pose)]);
    const stiffness = [Infinity, Infinity, Infinity, ...ofMembers(this.stiffness)];
    const problem = ikProblem(own, pins, dofs, { clamps: character.clampsToLimits, stiffness });
    const { residuals } = solve(problem, dofs, 'settle');
    if (!residuals.every((residual) => residual <= this.near)) return false;
    let at = 3;
    for (const member of members) {
      for (let dof = firstDof[member]; dof < firstDof[member + 1]; dof++) pose[dof] = dofs[at++];
    }
    const local = new Float64Array(16 * own.joints.length);
    worldMatrices(compileSkeleton(own), dofs, local);
    multiplyAffine(above, 0, local, 16, world, 16 * joint);
    return true;
  }

  /** The joint and those below it by which it is told, each after its parent. */
  private membersOf(joint: number): readonly number[] {
    const members = [joint];
    let from = 0;
    for (let level = 0; level < this.levels; level++) {
      const to = members.length;
      for (; from < to; from++) members.push(...this.children[members[from]]);
    }
    return members.sort((a, b) => a - b);
  }

  private pinsOf(joint: number): readonly IkPin[] {
    const { frame, points, goal } = this;
    const { world, positions } = frame;
    const held: readonly IkPin[] = world
      ? points.map((point) => ({ joint, point, target: transformPoint(world, point, 16 * joint) }))
      : positions
        ? [{ joint, point: ZERO, target: [positions[3 * joint], positions[3 * joint + 1], positions[3 * joint + 2]] }]
        : [];
    return goal?.joint === joint ? [...held, goal] : held;
  }

  private parentMatrix(parent: number): Float64Array {
    if (parent >= 0) return this.world.slice(16 * parent, 16 * parent + 16);
    const above = new Float64Array(16);
    setIdentity(above);
    if (this.start.compiled.hasRootTranslation) above.set(this.pose.subarray(0, 3), 12);
    return above;
  }
}
