/**
 * Compares another program's numbers with a character: where they are wrong first, which joints are wrong by
 * themselves, and which mistake explains them.
 */
import { runToEnd, type Steps, within } from '../../evaluate/steps.ts';
import type { Character } from '../../model/document.ts';
import type { Goal } from '../ik/goal.ts';
import { type JudgedGoal, type JudgedSolver, judgeSolver } from '../ik/judged.ts';
import { patternOf } from '../pattern/pattern.ts';
import { Evaluator, type FrameNumbers, type FrameTime } from '../program/evaluator.ts';
import { valuesNearest } from '../program/own-values.ts';
import { RIGHT_PROGRAM } from '../program/program.ts';
import { frameNearest } from '../search/cells.ts';
import type { Cause, CauseSubject, FoundCauses } from '../search/found-causes.ts';
import { findCauses } from '../search/search.ts';
import { nameOfChannel } from './channel-name.ts';
import { DEFAULT_TOLERANCE, diagonalOf, matrixError, pointError } from './errors.ts';
import { relativeMatrices } from './relative.ts';
import { FRAME_KINDS, type FrameTarget, type MatrixLayout, type Targets } from './targets.ts';

/** How many items of each kind were compared. */
export interface Compared {
  readonly world: number;
  readonly local: number;
  readonly positions: number;
  readonly vertices: number;
  readonly normals: number;
  readonly channels: number;
}

/** A number that is wrong, by its joint, vertex or channel. */
export interface FirstWrong {
  readonly what: 'joint' | 'vertex' | 'normal' | 'channel';
  /** From 0. */
  readonly index: number;
  /** Name of a joint, or of the DOF that a channel drives; absent for vertices. */
  readonly name?: string;
  readonly error: number;
  /** The error in the units of the files, if it is one of a length: `error` is over the size. */
  readonly length?: number;
  /** Time of a channel. */
  readonly time?: number;
}

/** One time of the dumps. */
export interface FrameComparison {
  /** Undefined: the file pose. */
  readonly time: FrameTime;
  readonly agrees: boolean;
  readonly worst: number;
  readonly first?: FirstWrong;
  /** The first wrong of joints, of vertices and of normals, in that order; those that agree have none. */
  readonly firsts: readonly FirstWrong[];
  /** Where the error is largest, if any is wrong. */
  readonly largest?: FirstWrong;
  /** Joints whose own local matrix is wrong. */
  readonly own: readonly number[];
  /** Joints that are wrong only because a parent is. */
  readonly inherited: readonly number[];
  /** Error of each joint, vertex and normal; empty if not compared. */
  readonly jointErrors: Float64Array;
  readonly vertexErrors: Float64Array;
  readonly normalErrors: Float64Array;
  /** Our numbers, with which theirs were compared; local matrices, vertices and normals only if they were. */
  readonly ours: FrameNumbers;
  /** Size of the character: the unit of errors of lengths. */
  readonly size: number;
}

/** The result of comparing dumps with a character. Errors of lengths are over the size of what is compared. */
export interface Comparison {
  readonly agrees: boolean;
  readonly compared: Compared;
  readonly layout?: MatrixLayout;
  readonly worst: number;
  readonly first?: FirstWrong;
  /** Where the error is largest, if any is wrong. */
  readonly largest?: FirstWrong;
  /** In the order of the dumps. `first`, `own` and `inherited` of the whole are those of the first that differs. */
  readonly frames: readonly FrameComparison[];
  /** Our value of each sample of channels. */
  readonly ourChannels: Float64Array;
  readonly own: readonly number[];
  readonly inherited: readonly number[];
  /** The best first; empty if all agrees, or if nothing explains it. */
  readonly causes: readonly Cause[];
  /** Where some parts of the numbers are explained: those that aren't, or only in what a mistake touches. */
  readonly unexplained?: CauseSubject;
  /** How they differ, in sentences; absent if all agrees, or if causes explain all of it. */
  readonly pattern?: string;
  /** Goals of inverse kinematics: each point and its target; absent if there are none. */
  readonly goals?: readonly ComparedGoal[];
  /** The same in sentences; absent if there are none. */
  readonly reached?: readonly string[];
}

/** Whether all agrees, or a mistake or two explain all that doesn't. */
export function isExplained({
  agrees,
  causes,
  unexplained,
}: Pick<Comparison, 'agrees' | 'causes' | 'unexplained'>): boolean {
  return agrees || (!unexplained && causes.some(({ explains, of }) => explains === of));
}

/** A point that a solver was to bring to a target. */
export interface ComparedGoal extends Goal {
  /** Index of its numbers. */
  readonly frame: number;
  /** Distances from the target: in the pose that the solver started from, and in its numbers, if they tell. */
  readonly before: number;
  readonly after?: number;
  readonly hasMoved: boolean;
  readonly isPose: boolean;
}

/** Yields progress; a caller that stops asking cancels it. */
export function* compare(character: Character, targets: Targets, tolerance = DEFAULT_TOLERANCE): Steps<Comparison> {
  const { frames: asked, channels, layout } = targets;
  const { skeleton } = character;
  const evaluator = new Evaluator(character);
  // Any number is within an infinite tolerance, and every solver would be right.
  const ofGoals = Number.isFinite(tolerance) ? tolerance : DEFAULT_TOLERANCE;
  const solved = asked.map((target) =>
    target.solver && skeleton ? judgeSolver(character, skeleton, target, target.solver, ofGoals) : undefined,
  );
  const sizes = asked.map(
    (target, f) => solved[f]?.size ?? sizeOf(target, evaluator.frame(RIGHT_PROGRAM, target.time, wantedOf(target))),
  );
  const own = asked.map(
    (target, f) => solved[f]?.ours ?? copyOf(frameNearest(evaluator, RIGHT_PROGRAM, target.time, [target], sizes[f])),
  );
  yield 0;
  const frames = asked.map((target, f) => {
    const frame = compareFrame(character, target, own[f], sizes[f], tolerance);
    const judged = solved[f];
    return judged ? solverFrame(character, frame, judged) : frame;
  });
  const ofChannels = compareChannels(character, targets, tolerance);
  yield 0.1;
  const worst = Math.max(ofChannels.worst, ...frames.map((frame) => frame.worst));
  const agrees = frames.every((frame) => frame.agrees) && ofChannels.worst <= tolerance;
  const differs = frames.find((frame) => !frame.agrees);
  const others = [...asked.keys()].filter((f) => !solved[f]);
  const agree = ofChannels.worst <= tolerance && others.every((f) => frames[f].agrees);
  const some = agree ? undefined : someFrames(targets, others);
  const found: FoundCauses = some
    ? ofFrames(
        yield* within(
          findCauses({ character, targets: some, own: pick(own, others), sizes: pick(sizes, others), tolerance }),
          0.1,
          1,
        ),
        others,
      )
    : { causes: [] };
  const causes = [...found.causes, ...solved.flatMap((judged, f) => solverCauses(targets, judged, f))];
  const first = differs?.first ?? ofChannels.first;
  const pattern =
    !some || isExplained({ agrees: agree, ...found })
      ? undefined
      : patternOf({
          character,
          targets: some,
          frames: pick(frames, others),
          ourChannels: ofChannels.own,
          tolerance,
        });
  const largest = [...frames.map((frame) => frame.largest), ofChannels.largest].find((at) => at?.error === worst);
  const goals = solved.flatMap((judged, frame) => judged?.goals.map((each) => comparedGoal(each, frame)) ?? []);
  const reached = solved.flatMap((judged, f) => {
    const at = frames.length > 1 && asked[f].time !== undefined ? `At ${asked[f].time} s: ` : '';
    return judged?.sentences.map((sentence) => `${at}${sentence}`) ?? [];
  });
  return {
    agrees,
    compared: countOf(asked, channels.channels),
    ...(layout && { layout }),
    worst,
    ...(first && { first }),
    ...(largest && { largest }),
    frames,
    ourChannels: ofChannels.own,
    own: differs?.own ?? [],
    inherited: differs?.inherited ?? [],
    ...found,
    causes,
    ...(pattern && { pattern }),
    ...(goals.length > 0 && { goals, reached }),
  };
}

function pick<T>(list: readonly T[], indices: readonly number[]): readonly T[] {
  return indices.map((index) => list[index]);
}

function someFrames(targets: Targets, indices: readonly number[]): Targets {
  const { frames, origins } = targets;
  const own = origins && { ...origins, frames: pick(origins.frames, indices) };
  return { ...targets, frames: pick(frames, indices), ...(own && { origins: own }) };
}

/** Causes of some frames. @param indices of those among all */
function ofFrames(found: FoundCauses, indices: readonly number[]): FoundCauses {
  return { ...found, causes: found.causes.map((cause) => ({ ...cause, frames: pick(indices, cause.frames) })) };
}

/** Each alone, with what it is about where there are other numbers. */
function solverCauses({ frames, origins, channels }: Targets, judged: JudgedSolver | undefined, f: number) {
  const isAlone = frames.length === 1 && channels.channels.length === 0;
  const kinds = FRAME_KINDS.filter((kind) => frames[f][kind]);
  const files = kinds.flatMap((kind) => origins?.fileNames[origins.frames[f][kind] ?? 0] ?? []);
  const about = isAlone ? {} : { about: { kinds, files: [...new Set(files)] } };
  return judged?.causes.map((cause): Cause => ({ ...cause, frames: [f], ...about })) ?? [];
}

function comparedGoal({ goal, found }: JudgedGoal, frame: number): ComparedGoal {
  const { before, after, hasMoved, isPose } = found;
  return { ...goal, frame, before, ...(after !== undefined && { after }), hasMoved, isPose };
}

/** Wrong only in what its points are from their targets: another solution has other joints. */
function solverFrame({ skeleton }: Character, frame: FrameComparison, judged: JudgedSolver): FrameComparison {
  const { agrees, goals, size } = judged;
  const { first: _first, largest: _largest, ...rest } = frame;
  const alike = { ...rest, agrees, firsts: [], own: [], inherited: [] };
  if (agrees) return alike;
  const [{ goal, found }] = goals.filter((each) => !each.found.agrees);
  const off = found.isPose ? (found.after ?? frame.worst * size) : frame.worst * size;
  const error = off / size;
  const name = skeleton?.joints[goal.joint].name;
  const first: FirstWrong = { what: 'joint', index: goal.joint, ...(name && { name }), error, length: off };
  return { ...alike, worst: error, first, firsts: [first], largest: first };
}

/** The largest error, without a search for what explains it. */
export function worstError(character: Character, targets: Targets): number {
  return runToEnd(compare(character, targets, Number.POSITIVE_INFINITY)).worst;
}

function wantedOf({ local, vertices, normals }: FrameTarget) {
  return { local: local !== undefined, vertices: vertices !== undefined, normals: normals !== undefined };
}

function copyOf({ world, local, vertices, normals }: FrameNumbers): FrameNumbers {
  return { world: world.slice(), local: local.slice(), vertices: vertices.slice(), normals: normals.slice() };
}

/** The diagonal of the box around our vertices, if they are compared, else around our joints. */
function sizeOf(target: FrameTarget, own: FrameNumbers): number {
  return target.vertices ? diagonalOf(own.vertices, 3, 0) : diagonalOf(own.world, 16, 12);
}

/**
 * Counts the numbers that are compared, by kind.
 * @param channels of each sample
 */
export function countOf(frames: readonly FrameTarget[], channels: Uint32Array): Compared {
  const counts = { world: 0, local: 0, positions: 0, vertices: 0, normals: 0, channels: new Set(channels).size };
  for (const frame of frames) {
    for (const kind of FRAME_KINDS) {
      counts[kind] += (frame[kind]?.length ?? 0) / (kind === 'world' || kind === 'local' ? 16 : 3);
    }
  }
  return counts;
}

function compareFrame(
  character: Character,
  target: FrameTarget,
  ours: FrameNumbers,
  size: number,
  tolerance: number,
): FrameComparison {
  const { world, local, positions, vertices, normals, time } = target;
  const joints = character.skeleton?.joints ?? [];
  const jointErrors = new Float64Array(world || local || positions ? joints.length : 0);
  for (let j = 0; j < jointErrors.length; j++) {
    const o = 16 * j;
    jointErrors[j] = Math.max(
      world ? matrixError(world, ours.world, o, size) : 0,
      local ? matrixError(local, ours.local, o, size) : 0,
      positions ? pointError(positions, 3 * j, ours.world, o + 12, size) : 0,
    );
  }
  const errorsOf = (theirs: Float64Array | undefined, own: Float64Array, by: number) =>
    Float64Array.from({ length: (theirs?.length ?? 0) / 3 }, (_, v) =>
      theirs ? pointError(theirs, 3 * v, own, 3 * v, by) : 0,
    );
  const vertexErrors = errorsOf(vertices, ours.vertices, size);
  const normalErrors = errorsOf(normals, ours.normals, 1);
  const lists = [
    ['joint', jointErrors],
    ['vertex', vertexErrors],
    ['normal', normalErrors],
  ] as const;
  const worst = Math.max(...lists.map(([, errors]) => largestOf(errors)));
  const placed = ([what, errors]: (typeof lists)[number], index: number): FirstWrong => {
    const error = errors[index];
    const ofPlace = Math.max(
      world ? pointError(world, 16 * index + 12, ours.world, 16 * index + 12, size) : 0,
      local ? pointError(local, 16 * index + 12, ours.local, 16 * index + 12, size) : 0,
      positions ? pointError(positions, 3 * index, ours.world, 16 * index + 12, size) : 0,
    );
    const isLength = what === 'vertex' || (what === 'joint' && ofPlace === error);
    const name = what === 'joint' && joints[index].name ? { name: joints[index].name } : {};
    return { what, index, ...name, error, ...(isLength && { length: error * size }) };
  };
  const firsts = lists.flatMap((list) => {
    const index = list[1].findIndex((error) => !(error <= tolerance));
    return index < 0 ? [] : [placed(list, index)];
  });
  const first = firsts.at(0);
  const worstIn = first && lists.find(([, errors]) => errors.includes(worst));
  const largest = worstIn && placed(worstIn, worstIn[1].indexOf(worst));
  const own = ownWrong(character, target, ours, size, tolerance, jointErrors);
  const isWrong = (j: number) => !(jointErrors[j] <= tolerance);
  const inherited = world ? joints.flatMap((_, j) => (isWrong(j) && !own.includes(j) ? [j] : [])) : [];
  return {
    time,
    agrees: worst <= tolerance,
    worst,
    ...(first && { first }),
    firsts,
    ...(largest && { largest }),
    own,
    inherited,
    jointErrors,
    vertexErrors,
    normalErrors,
    ours,
    size,
  };
}

function largestOf(errors: Float64Array): number {
  let most = 0;
  for (const error of errors) most = Math.max(most, error);
  return most;
}

/** Joints whose matrix relative to their parent is wrong: inv(W of the parent)·W, theirs against ours. */
function ownWrong(
  { skeleton }: Character,
  { world, local }: FrameTarget,
  ours: FrameNumbers,
  size: number,
  tolerance: number,
  jointErrors: Float64Array,
): readonly number[] {
  const wrong = new Set<number>();
  const joints = skeleton?.joints ?? [];
  if (local) joints.forEach((_, j) => void (matrixError(local, ours.local, 16 * j, size) <= tolerance || wrong.add(j)));
  if (world && !largestWithin(jointErrors, tolerance)) {
    const theirs = relativeMatrices(world, joints);
    const own = relativeMatrices(ours.world, joints);
    joints.forEach((_, j) => void (matrixError(theirs, own, 16 * j, size) <= tolerance || wrong.add(j)));
  }
  return [...wrong].sort((a, b) => a - b);
}

function largestWithin(errors: Float64Array, tolerance: number): boolean {
  return errors.every((error) => error <= tolerance);
}

function compareChannels(character: Character, { channels: target }: Targets, tolerance: number) {
  const own = valuesNearest(character, target, tolerance);
  let worst = 0;
  let first: FirstWrong | undefined;
  let largest: FirstWrong | undefined;
  target.channels.forEach((index, i) => {
    const difference = Math.abs(own[i] - target.values[i]);
    const error = Number.isNaN(difference) ? Number.POSITIVE_INFINITY : difference;
    const isLargest = error > worst;
    worst = Math.max(worst, error);
    if (error <= tolerance) return;
    const time = target.times[i];
    const isEarlier = !first || index < first.index || (index === first.index && time < (first.time ?? 0));
    if (!isEarlier && !isLargest) return;
    const place: FirstWrong = { what: 'channel', index, ...nameOfChannel(character, index), error, time };
    if (isEarlier) first = place;
    if (isLargest) largest = place;
  });
  return { own, worst, first, largest };
}
