/** Numbers of a solver as a comparison tells of them: whether they are right, what they are beside, and in sentences. */
import { ikProblem } from '../../evaluate/ik/problem.ts';
import { solve } from '../../evaluate/ik/solve.ts';
import type { Character } from '../../model/document.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { diagonalOf } from '../compare/errors.ts';
import { relativeMatrices, worldOfRelative } from '../compare/relative.ts';
import { shortNumber } from '../compare/short-number.ts';
import type { FrameTarget, SolverTask } from '../compare/targets.ts';
import type { FrameNumbers } from '../program/evaluator.ts';
import type { Cause } from '../search/found-causes.ts';
import { compareGoal, type GoalComparison } from './compare-goal.ts';
import { dumpedPose } from './dumped-pose.ts';
import { effectorText, type Goal } from './goal.ts';
import { SolverStart } from './start.ts';
import { bestLength, transposed } from './steps.ts';

/** A target, and how the program's numbers reach it. */
export interface JudgedGoal {
  readonly goal: Goal;
  readonly found: GoalComparison;
}

/** The judgement of all targets of a dump. */
export interface JudgedSolver {
  readonly agrees: boolean;
  readonly goals: readonly JudgedGoal[];
  readonly sentences: readonly string[];
  readonly causes: readonly Cause[];
  /** Their own where they are right; else the nearest of those that we know to be. */
  readonly ours: FrameNumbers;
  /** Size of the skeleton, before it moved. */
  readonly size: number;
}

/**
 * Judges the numbers of a solver by its targets.
 * @param tolerance over the size of the skeleton
 */
export function judgeSolver(
  character: Character,
  skeleton: Skeleton,
  target: FrameTarget,
  { goals, isOneStep }: SolverTask,
  tolerance: number,
): JudgedSolver {
  const start = new SolverStart(character, skeleton, target.time);
  const size = diagonalOf(start.matrices(start.pose), 16, 12);
  const frame = isOneStep ? target : withWorld(target, skeleton);
  const judged = goals.map((goal): JudgedGoal => {
    return { goal, found: compareGoal(character, skeleton, frame, goal, isOneStep, tolerance) };
  });
  const agrees = judged.every(({ found }) => found.agrees) || isNearest(start, judged, tolerance * size);
  return {
    agrees,
    goals: judged,
    sentences: judged.flatMap(({ goal, found }, g) =>
      sentencesOf(effectorText(skeleton, goal), found, agrees, isOneStep, g === 0),
    ),
    causes: agrees ? [] : judged.flatMap(({ found }) => found.causes),
    ours: numbersOf(
      agrees ? agreeing(start, frame, size, tolerance) : expected(start, frame, goals, isOneStep, size, tolerance),
      skeleton,
    ),
    size,
  };
}

/** Numbers with world matrices, made of local ones where these are alone. */
function withWorld(target: FrameTarget, { joints }: Skeleton): FrameTarget {
  const { local, world, positions } = target;
  return local && !world && !positions ? { ...target, world: worldOfRelative(local, joints) } : target;
}

/** Whether several points are as near to targets as they come together. */
function isNearest({ skeleton, character, pose }: SolverStart, judged: readonly JudgedGoal[], near: number): boolean {
  const offs = judged.map(({ found }) => (found.isPose ? (found.after ?? Infinity) : Infinity));
  if (judged.length < 2 || !offs.every(Number.isFinite)) return false;
  const pins = judged.map(({ goal }) => goal);
  const problem = ikProblem(skeleton, pins, pose, { clamps: character.clampsToLimits });
  const { residuals } = solve(problem, Float64Array.from(pose), 'settle');
  return Math.hypot(...offs) <= Math.hypot(...residuals) + near;
}

/** Their matrices; of positions, those of a pose that has them. */
function agreeing(start: SolverStart, frame: FrameTarget, size: number, tolerance: number): Float64Array {
  const { world, local, positions } = frame;
  if (world) return world.slice();
  if (local) return worldOfRelative(local, start.skeleton.joints);
  const pose = dumpedPose(start, frame, size, tolerance * size) ?? start.pose;
  const own = start.matrices(pose).slice();
  positions?.forEach((value, i) => {
    own[16 * Math.floor(i / 3) + 12 + (i % 3)] = value;
  });
  return own;
}

/** From their pose to the targets, or a good step. */
function expected(
  start: SolverStart,
  frame: FrameTarget,
  goals: readonly Goal[],
  isOneStep: boolean,
  size: number,
  tolerance: number,
): Float64Array {
  const { skeleton, character } = start;
  if (isOneStep) {
    const seen = start.see(goals[0], goals[0].target);
    const best = bestLength(seen);
    return start.matrices(start.after(transposed(seen).map((part) => best * part))).slice();
  }
  const isKnown = (frame.world ?? frame.positions)?.every(Number.isFinite) ?? false;
  const pose = Float64Array.from((isKnown && dumpedPose(start, frame, size, tolerance * size)) || start.pose);
  solve(ikProblem(skeleton, goals, pose, { clamps: character.clampsToLimits }), pose, 'settle');
  return start.matrices(pose).slice();
}

function numbersOf(world: Float64Array, { joints }: Skeleton): FrameNumbers {
  const none = new Float64Array(0);
  return { world, local: relativeMatrices(world, joints), vertices: none, normals: none };
}

function sentencesOf(
  what: string,
  { agrees: isThere, hasMoved, isPose, before, after, causes }: GoalComparison,
  agrees: boolean,
  isOneStep: boolean,
  isFirst: boolean,
): readonly string[] {
  const start = what.charAt(0).toUpperCase() + what.slice(1);
  const away = after === undefined ? '' : `, ${shortNumber(after)} away`;
  if (!isPose)
    return isFirst ? ['No pose of the skeleton has these numbers: its bones have other lengths, axes or limits.'] : [];
  if (isOneStep && agrees)
    return [`A correct step of ${what}: ${shortNumber(before)} from its target before${away} after it.`];
  if (isThere || agrees)
    return [`${start} is at its target, or as close as possible${away}; ${shortNumber(before)} away before.`];
  const sentences = [`${start} is not at its target${away}; ${shortNumber(before)} away before.`];
  if (causes.length > 0) return sentences;
  if (!hasMoved) return [...sentences, 'All joints are where they were before.'];
  const none = isOneStep
    ? 'It is not a step of α·Jᵀe, damped least squares or the pseudo-inverse, and no known mistake explains these numbers. A longer step, or a smaller tolerance, tells more.'
    : 'No known mistake explains these numbers. Those after one step of your solver, headed "one step", tell more.';
  return [...sentences, none];
}
