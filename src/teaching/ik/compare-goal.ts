/**
 * Compares what a program of inverse kinematics printed with the target that it was given. Any pose that reaches it is
 * right, or, after one step, any usual step that brings the point nearer. Else the mistakes are tried: one is named
 * only if its numbers are those of the program.
 */
import { length3, subtract } from '../../math/vec3.ts';
import type { Character } from '../../model/document.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { diagonalOf } from '../compare/errors.ts';
import { shortNumber } from '../compare/short-number.ts';
import type { FrameTarget } from '../compare/targets.ts';
import type { Cause } from '../search/found-causes.ts';
import { dumpedPose } from './dumped-pose.ts';
import { type FittedStep, fitStep } from './fit-step.ts';
import { type EndEffector, effectorText, endEffectorsOf, type Goal } from './goal.ts';
import type { SeenPoint } from './jacobian.ts';
import { LikelyEffectors } from './likely.ts';
import { IK_FORMULAS, type IkMistake } from './mistakes.ts';
import { placeIn } from './place-in.ts';
import { remaining } from './solved.ts';
import { SolverStart } from './start.ts';
import {
  bestLength,
  kindAlong,
  misread,
  rightKinds,
  type StepKind,
  transposed,
  transposeKind,
  wholeSteps,
} from './steps.ts';

/** How a program's numbers reach one target; lengths are in the units of the files. */
export interface GoalComparison {
  readonly agrees: boolean;
  /** Distances from the target: in the pose from which the program started, and in its numbers, if they tell. */
  readonly before: number;
  readonly after?: number;
  /** Whether the numbers differ from those of the pose from which the program started. */
  readonly hasMoved: boolean;
  /** Whether the joints stand as the skeleton can have them; not asked of one step. */
  readonly isPose: boolean;
  readonly causes: readonly Cause[];
}

/** A step must move something by so many tolerances, so that others can't be taken for it. */
const EVIDENCE = 50;
/** Steps after which to give up on a solver that never comes nearer. */
const MAX_STEPS = 60;

/**
 * Compares a program's numbers with one target.
 * @param frame world matrices or joint positions, or, of one step, local matrices
 * @param isOneStep whether the program made one step only
 */
export function compareGoal(
  character: Character,
  skeleton: Skeleton,
  frame: FrameTarget,
  goal: Goal,
  isOneStep: boolean,
  tolerance: number,
): GoalComparison {
  const start = new SolverStart(character, skeleton, frame.time);
  const size = diagonalOf(start.matrices(start.pose), 16, 12);
  const trial = new GoalTrial(start, frame, goal, size, tolerance);
  const place = placeIn(frame, goal);
  const distances = {
    before: start.distance(start.pose, goal),
    ...(place && { after: length3(...subtract(goal.target, place)) }),
  };
  // A solver that diverged prints what no pose has.
  const numbers = frame.world ?? frame.positions ?? frame.local;
  const judged = isOneStep ? () => trial.oneStep() : () => trial.solution();
  return { ...distances, hasMoved: trial.hasMoved, ...(numbers?.every(Number.isFinite) ? judged() : NO_POSE) };
}

type Judged = Pick<GoalComparison, 'agrees' | 'isPose' | 'causes'>;

const NO_POSE: Judged = { agrees: false, isPose: false, causes: [] };

class GoalTrial {
  private readonly near: number;
  readonly hasMoved: boolean;
  /** Whether so far that mistakes can be told from each other. */
  private readonly isTelling: boolean;

  constructor(
    private readonly start: SolverStart,
    private readonly frame: FrameTarget,
    private readonly goal: Goal,
    private readonly size: number,
    private readonly tolerance: number,
  ) {
    this.near = tolerance * size;
    const moved = start.error(frame, start.pose, size);
    this.hasMoved = moved > tolerance;
    this.isTelling = moved > EVIDENCE * tolerance;
  }

  oneStep(): Judged {
    const { start, goal } = this;
    const own = start.see(goal, goal.target);
    const isRight = this.hasMoved && rightKinds(own).some((kind) => this.rightStep(kind, goal));
    if (isRight) return { agrees: true, isPose: true, causes: [] };
    const tooLong = this.stepInDegrees(own) ?? this.unscaledStep(own);
    const causes = tooLong ? [tooLong] : [...merged(this.misreadSteps(own)), ...merged(this.stepsOfOthers())];
    return { agrees: false, isPose: true, causes };
  }

  solution(): Judged {
    const { frame, goal, near, size, start } = this;
    if (!dumpedPose(start, frame, size, near)) return NO_POSE;
    const place = placeIn(frame, goal);
    const off = place ? length3(...subtract(goal.target, place)) : undefined;
    // Of targets out of reach the nearest place is right.
    const agrees =
      off === undefined
        ? dumpedPose(start, frame, size, near, goal) !== undefined
        : off <= near || off <= remaining(start, goal) + near;
    if (agrees) return { agrees, isPose: true, causes: [] };
    const tooLong = this.repeatedSteps();
    return { agrees, isPose: true, causes: tooLong ? [tooLong] : merged(this.othersAtTarget()) };
  }

  /** The step of a kind that gives the numbers, if it is right for the point. */
  private rightStep(kind: StepKind, effector: EndEffector): FittedStep | undefined {
    const fitted = this.fitted(kind);
    const isRight = fitted.error <= this.tolerance && (!kind.mustGain || this.gain(fitted.step, effector) > 0);
    return isRight ? fitted : undefined;
  }

  private fitted(kind: StepKind) {
    const { start, frame, size } = this;
    return fitStep(kind, (step) => start.error(frame, start.after(step), size));
  }

  /** How much nearer the step brings the point to the target. */
  private gain(step: readonly number[], { joint, point }: EndEffector): number {
    const { start, goal } = this;
    const own: Goal = { joint, point, target: goal.target };
    return start.distance(start.pose, own) - start.distance(start.after(step), own);
  }

  /** A step of known length, each angle of which is 180/π times as large: such a step of any other is one of any length. */
  private stepInDegrees(own: SeenPoint): Cause | undefined {
    const fits = wholeSteps(own)
      .filter((step) => this.isTold(step))
      .map((step) => this.errorAfter(this.inDegrees(step)))
      .filter((error) => error <= this.tolerance);
    return fits.length > 0 ? this.degreesCause('', Math.min(...fits)) : undefined;
  }

  private inDegrees(step: readonly number[]): readonly number[] {
    return step.map((part, v) => (this.start.isAngle[v] ? (part * 180) / Math.PI : part));
  }

  private degreesCause(detail: string, error: number): Cause {
    const sentence =
      'You convert the step to degrees before you add it to DOFs in radians; it should be added as it is, since J is per radian.';
    return this.cause('ik-step-degrees', detail, sentence, error);
  }

  /** α·Jᵀe, so far that the point isn't nearer. */
  private unscaledStep(own: SeenPoint): Cause | undefined {
    const { relative, step, error } = this.fitted(transposeKind(own));
    if (!(error <= this.tolerance) || !this.isTold(step)) return undefined;
    const best = bestLength(own);
    const alpha = relative * best;
    const isOne = this.errorAfter(transposed(own)) <= this.tolerance;
    const detail = isOne ? 'α = 1' : `α = ${shortNumber(alpha)}`;
    return this.cause(
      'ik-step-unscaled',
      detail,
      `You add ${isOne ? 'Jᵀe itself' : `${shortNumber(alpha)}·Jᵀe`} to the DOFs, which doesn't bring ${this.text(this.goal)} nearer; it should be α·Jᵀe with α at most about ${shortNumber(best)} here.`,
      error,
    );
  }

  private misreadSteps(own: SeenPoint): readonly Cause[] {
    return misread(own).flatMap(([detail, direction]) => {
      const { step, error } = this.fitted(kindAlong(direction, bestLength(own)));
      if (!(error <= this.tolerance) || !this.isTold(step)) return [];
      const sentence = `You read the numbers of J in the wrong order: ${detail}; it should be read as it is stored, so that each DOF's change is its own column of J times e.`;
      return [this.cause('ik-jacobian-transposed', detail, sentence, error)];
    });
  }

  private stepsOfOthers(): readonly Cause[] {
    const { start, goal, frame, size, tolerance } = this;
    const likely = new LikelyEffectors(start, frame, size, tolerance).of(endEffectorsOf(start.skeleton), goal.target);
    return this.others(likely).flatMap((seen) => {
      const fits = rightKinds(seen)
        .flatMap((kind) => this.rightStep(kind, seen.effector) ?? [])
        .filter(({ step }) => this.isTold(step));
      return fits.length > 0 ? [this.wrongEffector(seen.effector, Math.min(...fits.map(({ error }) => error)))] : [];
    });
  }

  /** Points that came to the target instead. */
  private othersAtTarget(): readonly Cause[] {
    const { frame, goal, near, size, start } = this;
    const offOf = (effector: EndEffector) => {
      const place = placeIn(frame, effector);
      return place ? length3(...subtract(goal.target, place)) : Infinity;
    };
    const there = endEffectorsOf(start.skeleton).filter((effector) => offOf(effector) <= near);
    return this.others(there.map((effector) => start.see(effector, goal.target))).flatMap(({ effector, error }) =>
      length3(...error) <= EVIDENCE * near ? [] : [this.wrongEffector(effector, offOf(effector) / size)],
    );
  }

  /** A number of steps that all are too long, one of which takes the point away from the target. */
  private repeatedSteps(): Cause | undefined {
    if (!this.isTelling) return undefined;
    const after = (steps: number) => `${steps} ${steps === 1 ? 'step' : 'steps'}`;
    const unscaled = this.repeated(transposed);
    if (unscaled) {
      const { steps, best, error } = unscaled;
      const sentence = `You add Jᵀe itself to the DOFs in each step, which goes past the target; it should be α·Jᵀe with α at most about ${shortNumber(best)} there.`;
      return this.cause('ik-step-unscaled', `α = 1, ${after(steps)}`, sentence, error);
    }
    for (const kind of [0, 1, 2]) {
      const found = this.repeated((seen) => this.inDegrees(wholeSteps(seen)[kind]));
      if (found) return this.degreesCause(after(found.steps), found.error);
    }
    return undefined;
  }

  /** After how many steps of a kind the numbers are those of the program, and the best α of those that go too far. */
  private repeated(stepOf: (seen: SeenPoint) => readonly number[]) {
    const { start, goal, tolerance, frame, size } = this;
    let pose = start.pose;
    let distance = start.distance(pose, goal);
    let best = Infinity;
    for (let steps = 1; steps <= MAX_STEPS; steps++) {
      const seen = start.see(goal, goal.target, pose);
      pose = start.after(stepOf(seen), pose).slice();
      const now = start.distance(pose, goal);
      if (now >= distance) best = Math.min(best, bestLength(seen));
      distance = now;
      const error = start.error(frame, pose, size);
      if (error <= tolerance && best < Infinity) return { steps, best, error };
    }
    return undefined;
  }

  /** Those that aren't the goal's, each place once: the tip of a bone is often the next one's origin. */
  private others(effectors: readonly SeenPoint[]): readonly SeenPoint[] {
    const { start, goal, near } = this;
    const isSame = (a: SeenPoint, b: SeenPoint) =>
      length3(...subtract(a.position, b.position)) <= near &&
      a.columns.every((column, v) => length3(...subtract(column, b.columns[v])) <= near);
    const kept = [start.see(goal, goal.target)];
    for (const seen of effectors) if (!kept.some((one) => isSame(one, seen))) kept.push(seen);
    return kept.slice(1);
  }

  /** One DOF alone goes with any direction. */
  private isTold(step: readonly number[]): boolean {
    return this.isTelling && step.filter((part) => part !== 0).length > 1;
  }

  private errorAfter(step: readonly number[]): number {
    const { start, frame, size } = this;
    return start.error(frame, start.after(step), size);
  }

  private wrongEffector(effector: EndEffector, error: number): Cause {
    const detail = this.text(effector);
    const sentence = `You bring ${detail} to the target; it should be ${this.text(this.goal)}.`;
    return this.cause('ik-end-effector', detail, sentence, error);
  }

  private text(effector: EndEffector): string {
    return effectorText(this.start.skeleton, effector);
  }

  private cause(code: IkMistake, detail: string, sentence: string, residual: number): Cause {
    const { length } = this.start.skeleton.joints;
    const formulas = [IK_FORMULAS[code]];
    const told = { code, detail, alternatives: [], sentences: [sentence], formulas };
    return { ...told, explains: length, of: length, frames: [0], residual };
  }
}

/** Causes of one code as the nearest, and the others as alternatives to it. */
function merged(causes: readonly Cause[]): readonly Cause[] {
  const [best, ...others] = [...causes].sort((a, b) => a.residual - b.residual);
  if (!best) return [];
  const details = new Set(others.map(({ detail }) => detail));
  details.delete(best.detail);
  return [{ ...best, alternatives: [...details] }];
}
