/**
 * Joins takes: one continues from where the other ends, in place and heading, with a cross-fade.
 *
 *     first      ────────────╲╲╲╲╲
 *     second            ╱╱╱╱╱────────────        the overlap: as many frames of either
 *
 * The second is carried over the ground so that, in the middle of the overlap, its root is at the first's and faces
 * alike, or so that the foot that stands in both stays where it is. Without an overlap it continues by the mean of the
 * two speeds; a second take that continues by itself, such as the second half of one that was cut, is not moved.
 */
import { partsOf } from '../../evaluate/retarget/roles.ts';
import type { Steps } from '../../evaluate/steps.ts';
import { smoothstep } from '../../math/smoothstep.ts';
import type { Character } from '../../model/document.ts';
import { characterDofs } from '../../model/skeleton/dofs.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import type { Samples } from '../../model/takes/samples.ts';
import type { Take } from '../../model/takes/take.ts';
import { blendPoses } from './blend-frames.ts';
import { Carrier, type Carry, isCarried, STAYS } from './carry.ts';
import { refuseTooMany } from './most-frames.ts';
import { jointRotations } from './rotations.ts';
import { readFrame, writeFrame } from './take-frames.ts';

/** Points that are laid over each other: the root, the foot that stands, or nothing, where takes share a space. */
export const JOIN_ALIGNMENTS = ['root', 'foot', 'none'] as const;
/** Points that are aligned where takes are joined; see `JOIN_ALIGNMENTS`. */
export type JoinAlignment = (typeof JOIN_ALIGNMENTS)[number];

/** Frames between two yields. */
const STEP_FRAMES = 256;
/** Frames that are looked at on either side of a cut without an overlap. */
const AROUND = 3;
/**
 * A second take continues by itself if its root is off by less than this share of the way it goes in a frame, and this
 * share of the skeleton's size, or as many radians: for takes that begin at rest.
 */
const GOES_ON = { ofWay: 0.5, ofSize: 1e-4 };
/** The same for one whose frames follow those of the first in time too, as those of a take that was split do. */
const FOLLOWS = { ofWay: 10, ofSize: 0.1 };
/** Frames follow if they do within this share of a frame. */
const IN_TIME = 1e-3;

/** The character whose takes are joined, and how they are aligned. */
export interface Joining {
  readonly character: Pick<Character, 'morphs' | 'space'> & { readonly skeleton: Skeleton };
  /** For what carries the body; of the first take. */
  readonly take: Take;
  readonly alignment: JoinAlignment;
}

/**
 * Joins two takes with a cross-fade, the second carried to where the first ends.
 * @param a and `b`, its continuation: columns for the same channels, at one frame rate
 * @param overlap frames of either that are blended; from 0 to the number of frames of the shorter one
 */
export function* joining(joined: Joining, a: Samples, b: Samples, overlap: number): Steps<Samples> {
  const { skeleton, morphs, space } = joined.character;
  const width = a.scales.length;
  const frameCount = a.frameCount + b.frameCount - overlap;
  refuseTooMany(frameCount, width, a.frameCount + b.frameCount);
  const carrier = new Carrier(skeleton, joined.take, space?.up ?? 'y');
  const carry = carryOf(carrier, joined, a, b, overlap);
  const values = new Float64Array(frameCount * width);
  values.set(a.values);
  const out: Samples = { ...a, frameCount, values };
  const dofs = characterDofs(skeleton, morphs);
  const count = Math.min(dofs.length, width);
  const rotations = jointRotations(skeleton);
  const [theirs, own, previous, mixed] = [0, 1, 2, 3].map(() => new Float64Array(count));
  // Angles of the carried take are those nearest to its own frame before.
  const before = new Float64Array(count);
  const isMoved = isCarried(carry);
  readFrame(b, 0, before);
  for (let f = 0; f < b.frameCount; f++) {
    const at = a.frameCount - overlap + f;
    readFrame(b, f, theirs);
    if (isMoved) carrier.carry(carry, theirs, before);
    before.set(theirs);
    if (f < overlap) {
      readFrame(out, at, own);
      readFrame(out, Math.max(0, at - 1), previous);
      blendPoses(dofs, rotations, own, theirs, smoothstep(0, overlap + 1, f + 1), previous, mixed);
      writeFrame(out, at, mixed);
    } else {
      copyFrame(b, f, out, at);
      writeFrame(out, at, theirs);
    }
    if (f % STEP_FRAMES === STEP_FRAMES - 1) yield f / b.frameCount;
  }
  return out;
}

/** The frame's own numbers, if both have them in one unit; otherwise `writeFrame` converts them. */
function copyFrame(from: Samples, frame: number, to: Samples, at: number): void {
  const width = to.scales.length;
  for (let k = 0; k < width; k++) {
    if (from.scales[k] === to.scales[k]) to.values[at * width + k] = from.values[frame * from.scales.length + k];
  }
}

/** How the second take is carried. */
function carryOf(carrier: Carrier, joined: Joining, a: Samples, b: Samples, overlap: number): Carry {
  if (joined.alignment === 'none') return STAYS;
  const pose = new Float64Array(Math.max(a.scales.length, b.scales.length));
  const stanceAt = (samples: Samples, frame: number) => {
    readFrame(samples, Math.min(samples.frameCount - 1, Math.max(0, frame)), pose);
    return carrier.stanceOf(pose);
  };
  if (overlap === 0) return carryOfCut(carrier, joined, a, b, stanceAt);
  const middle = (overlap - 1) / 2;
  const [first, second] = [Math.floor(middle), Math.ceil(middle)].map((f) => ({
    own: stanceAt(a, a.frameCount - overlap + f),
    theirs: stanceAt(b, f),
  }));
  const turn = carrier.turnBetween(first.own, first.theirs);
  const foot = joined.alignment === 'foot' ? standingFoot(carrier, joined, a, b, overlap) : undefined;
  if (foot) return carrier.over(turn, foot.theirs, foot.own);
  const mean = (p: ArrayLike<number>, q: ArrayLike<number>) => [0, 1, 2].map((k) => (p[k] + q[k]) / 2);
  return carrier.over(turn, mean(first.theirs.place, second.theirs.place), mean(first.own.place, second.own.place));
}

type StanceAt = (samples: Samples, frame: number) => ReturnType<Carrier['stanceOf']>;

function carryOfCut(carrier: Carrier, joined: Joining, a: Samples, b: Samples, stanceAt: StanceAt): Carry {
  const [last, beforeLast] = [stanceAt(a, a.frameCount - 1), stanceAt(a, a.frameCount - 2)];
  const [next, afterNext] = [stanceAt(b, 0), stanceAt(b, 1)];
  const turnedBy = (carrier.turnBetween(last, beforeLast) + carrier.turnBetween(afterNext, next)) / 2;
  const turn = carrier.turnBetween(last, next) + turnedBy;
  const size = sizeOf(joined.character.skeleton);
  const speedA = [0, 1, 2].map((k) => (k === carrier.up ? 0 : last.place[k] - beforeLast.place[k]));
  const speedB = [0, 1, 2].map((k) => (k === carrier.up ? 0 : afterNext.place[k] - next.place[k]));
  const gap = [0, 1, 2].map((k) =>
    k === carrier.up ? 0 : next.place[k] - last.place[k] - (speedA[k] + speedB[k]) / 2,
  );
  const speeds = Math.hypot(...speedA) + Math.hypot(...speedB);
  const turns = Math.abs(carrier.turnBetween(last, beforeLast)) + Math.abs(carrier.turnBetween(afterNext, next));
  const isNext = Math.abs(b.startSeconds - a.startSeconds - a.frameCount * a.frameSeconds) < IN_TIME * a.frameSeconds;
  const { ofWay, ofSize } = isNext ? FOLLOWS : GOES_ON;
  if (Math.hypot(...gap) <= ofWay * speeds + ofSize * size && Math.abs(turn) <= ofWay * turns + ofSize) {
    return STAYS;
  }
  const foot = joined.alignment === 'foot' ? standingFoot(carrier, joined, a, b, 0) : undefined;
  if (foot) return carrier.over(turn, foot.theirs, foot.own);
  const goesOn = carrier.point({ turn, shift: [0, 0, 0] }, speedB, true);
  const to = [0, 1, 2].map((k) => last.place[k] + (speedA[k] + goesOn[k]) / 2);
  return carrier.over(turn, next.place, to);
}

/** Where the foot that moves least over the end of one and the start of the other is in either; undefined without feet. */
function standingFoot(
  carrier: Carrier,
  { character }: Joining,
  a: Samples,
  b: Samples,
  overlap: number,
): { readonly own: Float64Array; readonly theirs: Float64Array } | undefined {
  const frames = Math.max(overlap, AROUND);
  const { single } = partsOf(character.skeleton, character.space?.up);
  const feet = (['left', 'right'] as const).flatMap((side) => {
    const joint = single.get(`${side} toe`) ?? single.get(`${side} foot`);
    if (joint === undefined) return [];
    const own = pathOf(carrier, joint, a, a.frameCount - frames, a.frameCount);
    const theirs = pathOf(carrier, joint, b, 0, frames);
    return { own: own.mean, theirs: theirs.mean, way: own.way + theirs.way };
  });
  return feet.sort((one, other) => one.way - other.way)[0];
}

function pathOf(carrier: Carrier, joint: number, samples: Samples, from: number, to: number) {
  const [first, end] = [Math.max(0, from), Math.min(samples.frameCount, to)];
  const pose = new Float64Array(samples.scales.length);
  const mean = new Float64Array(3);
  const last = new Float64Array(3);
  let way = 0;
  for (let f = first; f < end; f++) {
    readFrame(samples, f, pose);
    const world = carrier.worldOf(pose);
    const at = world.subarray(16 * joint + 12, 16 * joint + 15);
    if (f > first) way += Math.hypot(at[0] - last[0], at[1] - last[1], at[2] - last[2]);
    for (let k = 0; k < 3; k++) mean[k] += at[k] / (end - first);
    last.set(at);
  }
  return { mean, way };
}

function sizeOf({ joints }: Skeleton): number {
  return joints.reduce((sum, { parent, offset }) => (parent < 0 ? sum : Math.max(sum, Math.hypot(...offset))), 0) || 1;
}
