/**
 * Inverse kinematics frame by frame: each frame's own pose, changed as little as possible to bring the pins to their
 * targets.
 *
 * Every frame starts from its own pose, and its pins move to their targets in a few equal steps: the result depends
 * only on the frame's own pose and the target, and as smoothly as they change from frame to frame. (Starting from the
 * previous frame would carry over its solution in directions that the pins leave free, and drift.) It can jump if a
 * limb bends the other way. So if a frame's change differs much from that of the previous one, it is solved again from
 * its own pose with the other's change added, and the nearer solution is used.
 *
 * Unreachable targets are approached as closely as possible from there, at limited speed (`calm.ts`), without restarts,
 * which would jump.
 */
import type { Turn } from '../../evaluate/ik/pins.ts';
import { ikProblem, movePin, turnPin } from '../../evaluate/ik/problem.ts';
import { type PinTarget, pinTarget, reachOfSkeleton } from '../../evaluate/ik/set-up.ts';
import { solve } from '../../evaluate/ik/solve.ts';
import type { IkProblem } from '../../evaluate/ik/state.ts';
import { type CompiledSkeleton, compileSkeleton, worldMatrices } from '../../evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../evaluate/pose.ts';
import type { Steps } from '../../evaluate/steps.ts';
import { slerp } from '../../math/slerp.ts';
import type { Character } from '../../model/document.ts';
import type { Pin } from '../../model/ik.ts';
import { characterDofs } from '../../model/skeleton/dofs.ts';
import { quaternionDofs } from '../../model/skeleton/joint-types.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { calm } from './calm.ts';
import type { HeldFrames } from './frames.ts';
import type { HoldWindow } from './window.ts';

/** The held pins, the same for all frames. */
export interface Holding {
  /** Without unkeyed changes. */
  readonly character: Character;
  readonly skeleton: Skeleton;
  readonly pins: readonly Pin[];
  /** One per pin. */
  readonly targets: readonly PinTarget[];
  readonly stiffness: Float64Array;
}

/** Number of steps in which pins move to their targets. */
const PARTS = 8;
/** Maximum number of solves for an unfinished solution. */
const MAX_TRIES = 4;
/**
 * Fraction of the reach: a difference to the change of the previous frame that counts as a jump, unless the targets
 * jumped.
 */
const JUMP = 0.02;
/** The same as a multiple of the change in the targets' distances. */
const JUMP_OF_TARGET = 4;

/** Yields after each frame. */
export function* holdingFrames(holding: Holding, { times, weights }: HoldWindow): Steps<HeldFrames> {
  const { character, skeleton } = holding;
  const width = dofCountOf(character);
  const own = new Float64Array(times.length * width);
  const held = new Float64Array(times.length * width);
  const isReached = new Uint8Array(times.length);
  const compiled = compileSkeleton(skeleton);
  let before: Change | undefined;
  for (let f = 0; f < times.length; f++) {
    const pose = own.subarray(f * width, (f + 1) * width);
    poseAt(character, times[f] - character.timeOffsetSeconds, pose);
    const change = weights[f] > 0 ? changeOf(holding, compiled, pose, weights[f], before) : undefined;
    held.set(change?.dofs ?? pose, f * width);
    isReached[f] = change && !change.isReached ? 0 : 1;
    before = change;
    yield (f + 1) / times.length;
  }
  const frames = { width, own, held, isReached };
  const reach = reachOfSkeleton(skeleton);
  const units = characterDofs(skeleton, character.morphs).map(({ unit }) => (unit === 'length' ? 1 / reach : 1));
  calm(frames, times, units, compiled, character.clampsToLimits);
  keepSigns(skeleton, compiled, held, width);
  return frames;
}

/** The change of a frame's pose. */
interface Change {
  readonly own: Float64Array;
  readonly weight: number;
  readonly dofs: Float64Array;
  readonly isReached: boolean;
  /** Displacement of each joint: x y z. */
  readonly moved: Float64Array;
  /** Displacement from the pins to their targets: x y z. */
  readonly way: Float64Array;
  /** Remaining distance from the targets, in total. */
  readonly left: number;
}

function changeOf(
  { character, skeleton, pins, targets, stiffness }: Holding,
  compiled: CompiledSkeleton,
  own: Float64Array,
  weight: number,
  before: Change | undefined,
): Change {
  const world = new Float64Array(16 * compiled.jointCount);
  worldMatrices(compiled, own, world);
  const starts = pins.map((pin) => pinTarget(pin, world));
  const ends = starts.map((start, p) => between(start, targets[p], weight));
  const asked = pins.map(({ joint, point, weight: counts }, p) => ({
    joint,
    point,
    weight: counts,
    target: starts[p].position,
    ...(starts[p].orientation && { orientation: starts[p].orientation }),
  }));
  // Made for each frame, since it measures lengths that the take may change.
  const problem = ikProblem(skeleton, asked, own, { clamps: character.clampsToLimits, stiffness });
  const way = Float64Array.from(ends.flatMap(({ position }, p) => position.map((x, k) => x - starts[p].position[k])));
  const dofs = own.slice();
  for (let part = 1; part < PARTS; part++) {
    aim(problem, starts, ends, part / PARTS);
    solve(problem, dofs, 'drag');
  }
  const direct = finish(problem, dofs, starts, ends);
  const change: Change = { ...direct, own, weight, way, moved: movedBy(compiled, direct.dofs, world) };
  if (!before) return change;
  const jump = apart(change.moved, before.moved);
  if (jump <= JUMP * problem.reach + JUMP_OF_TARGET * apart(way, before.way)) return change;
  const share = Math.min(1, weight / before.weight);
  const carried = finish(
    problem,
    own.map((value, d) => value + share * (before.dofs[d] - before.own[d])),
    starts,
    ends,
  );
  const other: Change = { ...carried, own, weight, way, moved: movedBy(compiled, carried.dofs, world) };
  const isAsGood = other.isReached || other.left <= 1.1 * change.left;
  return isAsGood && apart(other.moved, before.moved) < jump / 2 ? other : change;
}

/** As close as possible from there, in place. */
function finish(problem: IkProblem, dofs: Float64Array, starts: readonly PinTarget[], ends: readonly PinTarget[]) {
  aim(problem, starts, ends, 1);
  let { isSolved } = solve(problem, dofs, 'drag');
  for (let tries = 1; tries < MAX_TRIES && !isSolved; tries++) isSolved = solve(problem, dofs, 'drag').isSolved;
  // At a solution, settling does not restart; it only completes the movement.
  if (isSolved) solve(problem, dofs, 'settle');
  return { dofs, isReached: isSolved, left: problem.result.residuals.reduce((sum, residual) => sum + residual, 0) };
}

function aim(problem: IkProblem, starts: readonly PinTarget[], ends: readonly PinTarget[], part: number): void {
  starts.forEach((start, p) => {
    const { position, orientation } = between(start, ends[p], part);
    movePin(problem, p, position[0], position[1], position[2]);
    if (orientation) turnPin(problem, p, orientation);
  });
}

/** Interpolates between two targets; the orientation along the shortest arc. */
export function between(a: PinTarget, b: PinTarget, part: number): PinTarget {
  const mix = (k: number) => (part === 1 ? b.position[k] : a.position[k] + part * (b.position[k] - a.position[k]));
  const position = [mix(0), mix(1), mix(2)] as const;
  if (!a.orientation || !b.orientation) return { position };
  return { position, orientation: turnBetween(a.orientation, b.orientation, part) };
}

function turnBetween(a: Turn, b: Turn, part: number): Turn {
  const turn = new Float64Array(4);
  slerp(Float64Array.from(a), Float64Array.from(b), part, turn);
  return [turn[0], turn[1], turn[2], turn[3]];
}

/** Displacement of each joint. */
function movedBy(compiled: CompiledSkeleton, dofs: Float64Array, before: Float64Array): Float64Array {
  const world = new Float64Array(before.length);
  worldMatrices(compiled, dofs, world);
  const moved = new Float64Array(3 * compiled.jointCount);
  for (let i = 0; i < moved.length; i++) {
    const at = 16 * Math.floor(i / 3) + 12 + (i % 3);
    moved[i] = world[at] - before[at];
  }
  return moved;
}

/** The largest distance between corresponding points, x y z each. */
function apart(a: Float64Array, b: Float64Array): number {
  let largest = 0;
  for (let i = 0; i < a.length; i += 3) {
    largest = Math.max(largest, Math.hypot(a[i] - b[i], a[i + 1] - b[i + 1], a[i + 2] - b[i + 2]));
  }
  return largest;
}

/** q and −q are the same rotation, but interpolate differently: each frame takes the sign of the previous one. */
function keepSigns({ joints }: Skeleton, { firstDof }: CompiledSkeleton, held: Float64Array, width: number): void {
  joints.forEach(({ motion }, j) => {
    const [x] = quaternionDofs(motion);
    if (x === undefined) return;
    for (let o = width + firstDof[j] + x; o < held.length; o += width) {
      let along = 0;
      for (let k = o; k < o + 4; k++) along += held[k] * held[k - width];
      if (along < 0) for (let k = o; k < o + 4; k++) held[k] = -held[k];
    }
  });
}
