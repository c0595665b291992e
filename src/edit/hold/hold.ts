/**
 * Pins held over a range of a take: the frames are solved, baked into the take and thinned.
 *
 * Curves between two frames go their own way, and a foot that stands at every frame may slide between them. Where it
 * does, frames are made twice as many and solved again, up to eight times as many; those of samples are what they are.
 */
import { ikOf, type PinTarget, pinTarget, reachOfSkeleton, stiffnessOf } from '../../evaluate/ik/set-up.ts';
import { compileSkeleton, worldMatrices } from '../../evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../evaluate/pose.ts';
import { type Steps, within } from '../../evaluate/steps.ts';
import type { ChannelClip } from '../../model/clip.ts';
import type { Character } from '../../model/document.ts';
import type { Pin } from '../../model/ik.ts';
import type { Skeleton } from '../../model/skeleton.ts';
import { refuseTooMany } from '../samples/most-frames.ts';
import { withTake } from '../takes.ts';
import { bakingFrames, thinning } from './bake.ts';
import { changedDofs } from './changed-dofs.ts';
import { cornerTimes } from './corners.ts';
import type { HeldFrames } from './frames.ts';
import { type Holding, holdingFrames } from './held-frames.ts';
import { slides, withHalves } from './measure.ts';
import { type HoldWindow, keyedWindow, sampledWindow } from './window.ts';

export interface HoldOptions {
  /** Seconds of the clip. */
  readonly range: readonly [number, number];
  readonly framesPerSecond: number;
  readonly easeSeconds: number;
  /** How far joints and pins may be off for the sake of few keys; lengths. A thousandth of the reach where absent. */
  readonly tolerance: number | undefined;
}

export interface HeldPin {
  /** Its id. */
  readonly pin: number;
  /** How far its point gets from the held place during the range, at frames and halfway between them; lengths. */
  readonly slideBefore: number;
  readonly slideAfter: number;
}

export interface HeldTake {
  /** The very same where nothing had to be changed. */
  readonly clip: ChannelClip;
  readonly window: HoldWindow;
  /** Channels that changed, ascending. */
  readonly channels: readonly number[];
  readonly pins: readonly HeldPin[];
  /** Frames in which some pin could not come to its place. */
  readonly unreached: number;
}

/** Of the reach. */
const TOLERANCE = 1e-3;
/**
 * Of the tolerance, for what the joints do between frames and for keys left out each. They are looked at on frames and
 * halfway; the rest is for what lies between.
 */
const SHARE = 0.42;
/** How many times as many frames as were asked for, at most. */
const FINEST = 8;

/**
 * @param character with nothing set by hand over its take
 * @param clip the take that it shows, with a channel for each DOF
 * @param targets where the pins are held, one for each
 */
export function* holding(
  character: Character,
  skeleton: Skeleton,
  clip: ChannelClip,
  pins: readonly Pin[],
  targets: readonly PinTarget[],
  { range, framesPerSecond, easeSeconds, tolerance: allowed }: HoldOptions,
): Steps<HeldTake> {
  const stiffness = stiffnessOf(skeleton, ikOf(character));
  const job: Holding = { character, skeleton, pins, targets, stiffness };
  const reach = reachOfSkeleton(skeleton);
  const tolerance = allowed ?? TOLERANCE * reach;
  const path = dofsOnPaths(skeleton, pins);
  const isByFrames = path.some((dof) => stiffness[dof] < Infinity && clip.channels[dof]?.kind === 'samples');
  const samples = isByFrames ? clip.samples : undefined;
  const corners = samples ? [] : cornerTimes(clip, path, clip.range);
  // Before any of them is made.
  const seconds = Math.min(range[1], clip.range[1]) - Math.max(range[0], clip.range[0]) + 2 * easeSeconds;
  if (!samples) refuseTooMany(Math.ceil(seconds * framesPerSecond), dofCountOf(character));
  let solved: Solved;
  for (let finer = 1; ; finer *= 2) {
    const window = samples
      ? sampledWindow(samples, range, easeSeconds)
      : keyedWindow(range, clip.range, framesPerSecond * finer, easeSeconds, corners);
    // Nobody knows how many rounds there will be; each takes about half of what is left.
    const share = 0.8 * (1 - 1 / finer);
    solved = yield* within(solving(job, clip, window, reach), share, share + 0.4 / finer);
    if (samples || finer === FINEST || !(slideBetween(job, solved) > SHARE * tolerance)) break;
  }
  const { window, frames, changed, dense } = solved;
  const thin = yield* within(thinning(character, skeleton, pins, dense, window, changed, SHARE * tolerance), 0.8, 1);
  const held = withHalves(window.times.subarray(window.firstHeld, window.lastHeld + 1));
  const before = slides(character, skeleton, pins, targets, held);
  const after = slides(showing(character, thin), skeleton, pins, targets, held);
  return {
    clip: changed.length > 0 ? thin : clip,
    window,
    channels: changed,
    pins: pins.map(({ id }, p) => ({ pin: id, slideBefore: before[p], slideAfter: after[p] })),
    unreached: frames.isReached.reduce((count, is) => count + (is ? 0 : 1), 0),
  };
}

/** Where pins are in the pose that a character shows at a time of the transport. */
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
  readonly dense: ChannelClip;
}

function* solving(job: Holding, clip: ChannelClip, window: HoldWindow, reach: number): Steps<Solved> {
  const frames = yield* within(holdingFrames(job, window), 0, 0.9);
  const changed = changedDofs(job.skeleton, frames, reach);
  return { window, frames, changed, dense: yield* within(bakingFrames(clip, window, frames, changed), 0.9, 1) };
}

/** The DOFs on the ways from the pins to the root, with those that carry it; ascending. */
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

/** The furthest that a pin gets from its place, halfway between frames at both of which all were there. */
function slideBetween({ character, skeleton, pins, targets }: Holding, { window, frames, dense }: Solved): number {
  const { times, firstHeld, lastHeld } = window;
  const halves: number[] = [];
  for (let f = firstHeld; f < lastHeld; f++) {
    if (frames.isReached[f] && frames.isReached[f + 1]) halves.push(times[f] + (times[f + 1] - times[f]) / 2);
  }
  return Math.max(0, ...slides(showing(character, dense), skeleton, pins, targets, Float64Array.from(halves)));
}

function showing(character: Character, clip: ChannelClip): Character {
  return withTake(character, character.shownClip, clip);
}
