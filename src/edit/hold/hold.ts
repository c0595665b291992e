/**
 * Holds pins over a range of a take: solves the frames, bakes them into the take, and removes unneeded keys.
 *
 * Between two frames curves take their own course, so that a foot that is fixed at every frame may slide in between. If
 * it does, the number of frames is doubled and they are solved again, up to eight times as many; sampled takes keep
 * their frames.
 */
import { ikOf, type PinTarget, pinTarget, reachOfSkeleton, stiffnessOf } from '../../evaluate/ik/set-up.ts';
import { compileSkeleton, worldMatrices } from '../../evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../evaluate/pose.ts';
import { type Steps, within } from '../../evaluate/steps.ts';
import type { Character } from '../../model/document.ts';
import type { Pin } from '../../model/ik.ts';
import { lockedDofs } from '../../model/sets.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import type { Take } from '../../model/takes/take.ts';
import { refuseTooMany } from '../samples/most-frames.ts';
import { withTake } from '../takes.ts';
import { bakingFrames, thinning } from './bake.ts';
import { changedDofs } from './changed-dofs.ts';
import { cornerTimes } from './corners.ts';
import type { HeldFrames } from './frames.ts';
import { type Holding, holdingFrames } from './held-frames.ts';
import { slides, withHalves } from './measure.ts';
import { pruning } from './prune.ts';
import { type HoldWindow, keyedWindow, sampledWindow } from './window.ts';

/** The range of a hold, and how its frames are solved. */
export interface HoldOptions {
  /** Seconds of the take. */
  readonly range: readonly [number, number];
  readonly framesPerSecond: number;
  readonly easeSeconds: number;
  /** How far joints and pins may deviate to save keys; lengths. Default: a thousandth of the reach. */
  readonly tolerance: number | undefined;
}

/** How far a pin slides, before and after. */
export interface HeldPin {
  /** Its id. */
  readonly pin: number;
  /** How far its point gets from its target during the range, at frames and halfway between; lengths. */
  readonly slideBefore: number;
  readonly slideAfter: number;
}

/** A take with held pins, and what was done. */
export interface HeldTake {
  /** The same object if nothing had to be changed. */
  readonly take: Take;
  readonly window: HoldWindow;
  /** Channels that changed, ascending. */
  readonly channels: readonly number[];
  readonly pins: readonly HeldPin[];
  /** Frames in which some pin did not reach its target. */
  readonly unreached: number;
}

/** Fraction of the reach. */
const TOLERANCE = 1e-3;
/**
 * Fraction of the tolerance for movement between frames, and for removed keys. Both are measured on frames and halfway;
 * the rest is a margin for what lies between.
 */
const SHARE = 0.42;
/** Maximum factor by which the number of frames is increased. */
const FINEST = 8;

/**
 * Holds pins over a range of a take, as described at the top of this file; yields its progress.
 * @param character without unkeyed changes
 * @param take the take that it shows, with a channel for each DOF
 * @param targets where the pins are held, one per pin
 */
export function* holding(
  character: Character,
  skeleton: Skeleton,
  take: Take,
  pins: readonly Pin[],
  targets: readonly PinTarget[],
  { range, framesPerSecond, easeSeconds, tolerance: allowed }: HoldOptions,
): Steps<HeldTake> {
  const stiffness = stiffnessOf(skeleton, ikOf(character), lockedDofs(character));
  const job: Holding = { character, skeleton, pins, targets, stiffness };
  const reach = reachOfSkeleton(skeleton);
  const tolerance = allowed ?? TOLERANCE * reach;
  const path = dofsOnPaths(skeleton, pins);
  const isByFrames = path.some((dof) => stiffness[dof] < Infinity && take.channels[dof]?.kind === 'samples');
  const samples = isByFrames ? take.samples : undefined;
  const corners = samples ? [] : cornerTimes(take, path, take.range);
  // Checked before any is made.
  const seconds = Math.min(range[1], take.range[1]) - Math.max(range[0], take.range[0]) + 2 * easeSeconds;
  if (!samples) refuseTooMany(Math.ceil(seconds * framesPerSecond), dofCountOf(character));
  let solved: Solved;
  for (let finer = 1; ; finer *= 2) {
    const window = samples
      ? sampledWindow(samples, range, easeSeconds)
      : keyedWindow(range, take.range, framesPerSecond * finer, easeSeconds, corners);
    // The number of rounds is unknown; each takes about half of the remaining progress.
    const share = 0.8 * (1 - 1 / finer);
    solved = yield* within(solving(job, take, window, reach), share, share + 0.4 / finer);
    if (samples || finer === FINEST || !(slideBetween(job, solved) > SHARE * tolerance)) break;
  }
  const { window, frames, changed, dense } = solved;
  const thin = yield* within(thinning(character, skeleton, pins, dense, window, changed, SHARE * tolerance), 0.8, 0.9);
  const takes = { original: take, dense, thin };
  const pruned = yield* within(pruning(job, takes, window, changed, 2 * SHARE * tolerance), 0.9, 1);
  const channels = changed.filter(
    (channel) => dense.channels[channel].kind === 'samples' || pruned.channels[channel] !== take.channels[channel],
  );
  const held = withHalves(window.times.subarray(window.firstHeld, window.lastHeld + 1));
  const before = slides(character, skeleton, pins, targets, held);
  const after = slides(showing(character, pruned), skeleton, pins, targets, held);
  return {
    take: channels.length > 0 ? pruned : take,
    window,
    channels,
    pins: pins.map(({ id }, p) => ({ pin: id, slideBefore: before[p], slideAfter: after[p] })),
    unreached: frames.isReached.reduce((count, is) => count + (is ? 0 : 1), 0),
  };
}

/** Positions of pins in the pose that a character shows at a transport time. */
export function placesAt(
  character: Character,
  skeleton: Skeleton,
  pins: readonly Pin[],
  timeSeconds: number,
): readonly PinTarget[] {
  const compiled = compileSkeleton(skeleton);
  const dofs = new Float64Array(dofCountOf(character));
  const world = new Float64Array(16 * compiled.jointCount);
  poseAt(character, timeSeconds, dofs);
  worldMatrices(compiled, dofs, world);
  return pins.map((pin) => pinTarget(pin, world));
}

interface Solved {
  readonly window: HoldWindow;
  readonly frames: HeldFrames;
  readonly changed: readonly number[];
  /** With a key on every frame. */
  readonly dense: Take;
}

function* solving(job: Holding, take: Take, window: HoldWindow, reach: number): Steps<Solved> {
  const frames = yield* within(holdingFrames(job, window), 0, 0.9);
  const changed = changedDofs(job.skeleton, frames, reach);
  return { window, frames, changed, dense: yield* within(bakingFrames(take, window, frames, changed), 0.9, 1) };
}

/** The DOFs on the paths from the pins to the root, including those that move it; ascending. */
function dofsOnPaths(skeleton: Skeleton, pins: readonly Pin[]): number[] {
  const { firstDof, parent, jointCount } = compileSkeleton(skeleton);
  const onPath = new Set<number>();
  for (const { joint } of pins) for (let j = joint; j >= 0; j = parent[j]) onPath.add(j);
  const dofs = Array.from({ length: firstDof[0] }, (_, dof) => dof);
  for (let j = 0; j < jointCount; j++) {
    if (onPath.has(j)) for (let dof = firstDof[j]; dof < firstDof[j + 1]; dof++) dofs.push(dof);
  }
  return dofs;
}

/** The farthest that a pin gets from its target, halfway between frames at which all are reached. */
function slideBetween({ character, skeleton, pins, targets }: Holding, { window, frames, dense }: Solved): number {
  const { times, firstHeld, lastHeld } = window;
  const halves: number[] = [];
  for (let f = firstHeld; f < lastHeld; f++) {
    if (frames.isReached[f] && frames.isReached[f + 1]) halves.push(times[f] + (times[f + 1] - times[f]) / 2);
  }
  return Math.max(0, ...slides(showing(character, dense), skeleton, pins, targets, Float64Array.from(halves)));
}

function showing(character: Character, take: Take): Character {
  return withTake(character, character.shownTake, take);
}
