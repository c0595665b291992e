/**
 * Which end effectors may be those that a program moves in one step, told without evaluating all joints for each:
 * joints that turned are on the path to the point, and a few of these joints turned as a right step turns them.
 */
import { writeLocal } from '../../evaluate/kinematics.ts';
import { length3, subtract, transformPoint, type Vec3 } from '../../math/vec3.ts';
import { larger, matrixError } from '../compare/errors.ts';
import { relativeMatrices } from '../compare/relative.ts';
import type { FrameTarget } from '../compare/targets.ts';
import { fitStep } from './fit-step.ts';
import type { EndEffector } from './goal.ts';
import type { SeenPoint } from './jacobian.ts';
import type { SolverStart } from './start.ts';
import { rightKinds } from './steps.ts';

/** Joints looked at on each end of a path. */
const FEW = 3;
/** Differences of two joints are as exact as both together. */
const SLACK = 4;
/** The nearest points, by a few joints and by all. */
const MAX_BY_FEW = 64;
const MOST = 8;

/** Sorts out which points of joints a program can't have moved, from the joints that turned. */
export class LikelyEffectors {
  private readonly tolerance: number;
  /** How far a joint's matrix in its parent's space is from the dump's, as far as that tells. */
  private readonly errorFrom: (joint: number, own: Float64Array) => number;
  private readonly local = new Float64Array(16);
  private readonly moved: Float64Array;
  /** Those with a DOF that follows another one's: they turn with joints elsewhere. */
  private readonly isLinked: readonly boolean[];
  /** The joint farthest from the root that turned; −1 if there are none; absent if they are on no path. */
  private readonly deepest: number | undefined;

  constructor(
    private readonly start: SolverStart,
    private readonly frame: FrameTarget,
    private readonly size: number,
    tolerance: number,
  ) {
    this.tolerance = SLACK * tolerance;
    this.moved = start.pose.slice();
    this.isLinked = start.skeleton.joints.map(({ couples }) => couples !== undefined);
    this.errorFrom = this.errorIn(frame);
    this.deepest = this.deepestTurned();
  }

  /** The few of these points that the step may be for. */
  of(effectors: readonly EndEffector[], target: Vec3): readonly SeenPoint[] {
    const { start, deepest } = this;
    if (deepest === undefined) return [];
    const end = deepest < 0 ? start.compiled.jointCount : start.compiled.subtreeEnd[deepest];
    const within = effectors.filter(({ joint }) => joint >= deepest && joint < end);
    const byFew = within.map((effector) => this.byFewJoints(start.see(effector, target)));
    const likely = nearestOf(
      byFew.filter(({ error }) => error <= this.tolerance),
      MAX_BY_FEW,
    );
    return nearestOf(
      likely.map(({ seen, steps }) => ({ seen, error: this.byAllJoints(seen, steps) })),
      MOST,
    ).map(({ seen }) => seen);
  }

  /** The right steps that bring a few joints nearest to the dump's, and the least error of these joints. */
  private byFewJoints(seen: SeenPoint): { seen: SeenPoint; error: number; steps: readonly number[] } {
    const { start, moved } = this;
    const joints = this.tellingJoints(seen);
    const variables = [...start.variables.keys()].filter((v) => joints.includes(start.jointOf[v]));
    const columns = variables.map((v) => seen.columns[v]);
    const errorAfter = (step: readonly number[]) => {
      variables.forEach((v, i) => {
        moved[start.variables[v]] = start.clamped(start.variables[v], step[i]);
      });
      return joints.reduce((most, joint) => Math.max(most, this.errorOf(joint)), 0);
    };
    const fitted = rightKinds(seen, columns).map((kind) => fitStep(kind, errorAfter));
    for (const v of variables) moved[start.variables[v]] = start.pose[start.variables[v]];
    const error = Math.min(...fitted.map((fit) => fit.error));
    return { seen, error, steps: fitted.map(({ relative }) => relative) };
  }

  /** The least error of all joints after these steps. */
  private byAllJoints(seen: SeenPoint, steps: readonly number[]): number {
    const { start, frame, size } = this;
    const errors = rightKinds(seen).map(({ step }, k) => start.error(frame, start.after(step(steps[k])), size));
    return Math.min(...errors);
  }

  /** Those of the path that the step turns, next to the root and next to the point. */
  private tellingJoints({ effector, columns }: SeenPoint): readonly number[] {
    const { start, isLinked } = this;
    const turned = new Set(
      start.variables.flatMap((_, v) => (columns[v].some((part) => part !== 0) ? start.jointOf[v] : [])),
    );
    const path: number[] = [];
    for (let j = effector.joint; j >= 0; j = start.compiled.parent[j]) if (turned.has(j) && !isLinked[j]) path.push(j);
    return path.length <= 2 * FEW ? path : [...path.slice(0, FEW), ...path.slice(-FEW)];
  }

  private deepestTurned(): number | undefined {
    const { compiled } = this.start;
    let deepest = -1;
    for (let j = 0; j < compiled.jointCount; j++) {
      if (this.isLinked[j] || this.errorOf(j) <= this.tolerance) continue;
      if (deepest >= 0 && j >= compiled.subtreeEnd[deepest]) return undefined;
      deepest = j;
    }
    return deepest;
  }

  private errorOf(joint: number): number {
    writeLocal(this.start.compiled, joint, this.moved, this.local, 0);
    return this.errorFrom(joint, this.local);
  }

  private errorIn({ world, local, positions }: FrameTarget): (joint: number, own: Float64Array) => number {
    const { size } = this;
    const { joints } = this.start.skeleton;
    const theirs = local ?? (world && relativeMatrices(world, joints));
    if (theirs) return (joint, own) => matrixError(theirs.subarray(16 * joint, 16 * joint + 16), own, 0, size);
    if (!positions) return () => 0;
    return this.lengthErrors(positions);
  }

  /** Errors of lengths between positions: how far a child is from the parent, or, of the root, where it is. */
  private lengthErrors(positions: Float64Array): (joint: number, own: Float64Array) => number {
    const { size, start } = this;
    const { joints } = start.skeleton;
    const at = (j: number): Vec3 => [positions[3 * j], positions[3 * j + 1], positions[3 * j + 2]];
    const telling = new Map<number, { readonly offset: Vec3; readonly place: Vec3 }>();
    joints.forEach(({ parent }, child) => {
      const offset = start.fixedOffset(child);
      if (parent < 0 || telling.has(parent) || !offset) return;
      const above = joints[parent].parent;
      telling.set(parent, { offset, place: above < 0 ? at(child) : subtract(at(child), at(above)) });
    });
    return (joint, own) => {
      const told = telling.get(joint);
      if (!told) return 0;
      const place = transformPoint(own, told.offset);
      if (joints[joint].parent >= 0) return larger(0, (length3(...place) - length3(...told.place)) / size);
      return place.reduce((most, part, k) => larger(most, (part - told.place[k]) / size), 0);
    };
  }
}

/** Those of the least errors, in their order. */
function nearestOf<T extends { readonly error: number }>(list: readonly T[], most: number): readonly T[] {
  const nearest = new Set([...list].sort((a, b) => a.error - b.error).slice(0, most));
  return list.filter((one) => nearest.has(one));
}
