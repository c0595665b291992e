/**
 * The numbers of a take, as arrays. T frames, J joints in depth-first order without End Sites, E End Sites, C feet.
 *
 *     names, parents, offsets           J texts; J, −1 for the root; J × 3, the pivot in the parent's space at rest
 *     end_names, end_parents            E
 *     end_offsets                       E × 3, in the space of the joint
 *     positions, end_positions          T × J × 3, T × E × 3, world
 *     world_quat, local_quat            T × J × 4, x y z w; local: without the offset
 *     local_6d                          T × J × 6, the first two columns of the local rotation: x0 y0 z0 x1 y1 z1
 *     root_positions                    T × 3, of the joint that carries the body
 *     velocities                        T × J × 3, a second: central differences, one-sided at the ends
 *     contacts, contact_joints          T × C, C: which feet are on the ground
 *     fps, times                        one; T, in seconds of the take
 *
 * The parent of a root is the scene: its rotation is the same locally and in the world. Of points, positions and velocities
 * are NaN where one is missing.
 */
import { CommandError } from '../edit/command-error.ts';
import { playedTake } from '../evaluate/bake.ts';
import { contactSpans, feetOf, framesOfSpans, standingHeight } from '../evaluate/foot-contacts.ts';
import { compileSkeleton } from '../evaluate/kinematics.ts';
import { dofCountOf, poseFrom, poseSource } from '../evaluate/pose.ts';
import { carrierIn, retargetCarrier } from '../evaluate/space/carrier.ts';
import { metresPerUnit } from '../evaluate/space/metres.ts';
import { applySpace } from '../evaluate/space/space.ts';
import { isVisible } from '../evaluate/visible-points.ts';
import { arePoints } from '../model/skeleton/joint-types.ts';
import type { Skeleton } from '../model/skeleton/skeleton.ts';
import type { Space } from '../model/space.ts';
import type { DataArray, Floats } from './data-array.ts';
import type { FloatPool, Precision } from './float-pool.ts';
import { BLOCK } from './joint-rows.ts';
import { JointTransforms } from './joint-transforms.ts';
import type { ArrayTake } from './take.ts';

/** Numbers per joint and frame: positions, two quaternions, 6D, velocities. */
const PER_JOINT = 3 + 4 + 4 + 6 + 3;
/** A file of more is refused: it would not fit beside those of the other threads. */
const MAX_BYTES = 2 ** 31;

/** All numbers of a take; shapes, units and spaces are listed at the top of this file. */
export interface TakeArrays {
  readonly names: readonly string[];
  readonly parents: Int32Array;
  readonly offsets: Floats;
  readonly endNames: readonly string[];
  /** The joint of each End Site. */
  readonly endParents: Int32Array;
  readonly endOffsets: Floats;
  readonly positions: Floats;
  readonly endPositions: Floats;
  readonly worldQuat: Floats;
  readonly localQuat: Floats;
  readonly local6d: Floats;
  readonly rootPositions: Floats;
  readonly velocities: Floats;
  readonly contacts: Uint8Array;
  readonly contactJoints: Int32Array;
  readonly fps: number;
  readonly times: Float64Array;
  readonly frameCount: number;
  /** Index of the joint that carries the body. */
  readonly carrier: number;
}

/** Sees the frames of the whole take in passing, in order. */
export interface FrameWatcher {
  /** @param points x y z of each joint, then of each End Site, as in the arrays; both are reused */
  frame(frame: number, dofs: Float64Array, points: Float64Array): void;
}

/**
 * Evaluates all frames of a take, and makes its arrays.
 * @param pool of which the floats are taken: those of one take are overwritten by the next
 * @throws CommandError if they would be too large
 */
export function takeArrays(take: ArrayTake, pool: FloatPool, watcher?: FrameWatcher): TakeArrays {
  const { character, skeleton, space, frames, first, count, fps } = take;
  const { joints } = skeleton;
  const J = joints.length;
  const ends = joints.flatMap(({ endSites = [] }, joint) => endSites.map((at) => ({ joint, at })));
  const E = ends.length;
  pool.reset();
  refuseTooLarge(count, PER_JOINT * J + 3 * ends.length + 3, pool.precision);
  const floats = (size: number) => pool.take(size);
  const positions = floats(3 * J * count);
  const worldQuat = floats(4 * J * count);
  const localQuat = floats(4 * J * count);
  const local6d = floats(6 * J * count);
  const velocities = floats(3 * J * count);
  const endPositions = floats(3 * ends.length * count);
  const rootPositions = floats(3 * count);
  const offsets = floats(3 * J);
  offsets.set(offsetsOf(skeleton, space));
  const metres = space ? metresPerUnit(space) : 1;
  const endOffsets = floats(3 * ends.length);
  ends.forEach(({ at: [x, y, z] }, e) => void endOffsets.set([metres * x, metres * y, metres * z], 3 * e));
  const carrier = carrierOf(take);
  const feet = new FootPaths(take);
  const transforms = new JointTransforms(skeleton, space);
  const source = poseSource(character);
  const width = dofCountOf(character);
  const dofs = new Float64Array(BLOCK * width);
  const dofsOf = Array.from({ length: BLOCK }, (_, b) => dofs.subarray(b * width, (b + 1) * width));
  const rows = { positions, worldQuat, localQuat, local6d, velocities, fps };
  const missing = arePoints(skeleton) ? new Uint8Array(J * count) : undefined;
  // Contacts are found over the whole take, so that a part of it has the same ones.
  const [from, to] = feet.balls.length || watcher ? [0, frames.frameCount] : [first, first + count];
  for (let f = from, n = 0; f < to; f += n) {
    if (f === first) transforms.restart();
    // Blocks end where the part begins and ends.
    n = Math.min(BLOCK, (f < first ? first : f < first + count ? first + count : to) - f);
    const isPart = f >= first && f < first + count;
    for (let b = 0; b < n; b++) poseFrom(source, frames.startSeconds + (f + b) * frames.frameSeconds, dofsOf[b]);
    transforms.pose(dofs, n, isPart ? rows : undefined, f - first);
    for (let b = 0; b < n; b++) {
      const points = transforms.points[b];
      feet.take(f + b, points);
      watcher?.frame(f + b, dofsOf[b], points);
      if (!isPart) continue;
      const row = f + b - first;
      if (missing) noteMissing(skeleton, dofsOf[b], missing, row * J);
      for (let k = 0; k < 3; k++) rootPositions[3 * row + k] = points[3 * carrier + k];
      for (let i = 0; i < 3 * E; i++) endPositions[3 * E * row + i] = points[3 * J + i];
    }
  }
  transforms.end(rows, count);
  if (missing) leaveOut(missing, J, [positions, velocities]);
  return {
    names: joints.map(({ name }) => name),
    parents: Int32Array.from(joints, ({ parent }) => parent),
    offsets,
    endNames: endNamesOf(skeleton),
    endParents: Int32Array.from(ends, ({ joint }) => joint),
    endOffsets,
    positions,
    endPositions,
    worldQuat,
    localQuat,
    local6d,
    rootPositions,
    velocities,
    contacts: feet.contacts(),
    contactJoints: Int32Array.from(feet.balls),
    fps,
    times: timesOf(take),
    frameCount: count,
    carrier,
  };
}

/** Writes 1 for each point that isn't there, from `out[o]`. */
function noteMissing(skeleton: Skeleton, dofs: Float64Array, out: Uint8Array, o: number): void {
  const compiled = compileSkeleton(skeleton);
  for (let j = 0; j < compiled.jointCount; j++) out[o + j] = isVisible(compiled, j, dofs) ? 0 : 1;
}

/** What is missing is no number: positions where it is, velocities where one of those that they are between is. */
function leaveOut(missing: Uint8Array, width: number, [positions, velocities]: readonly [Floats, Floats]): void {
  for (let i = 0; i < missing.length; i++) {
    if (missing[i] === 1) positions.fill(Number.NaN, 3 * i, 3 * i + 3);
    if (missing[i] === 1 || missing[i - width] === 1 || missing[i + width] === 1) {
      velocities.fill(Number.NaN, 3 * i, 3 * i + 3);
    }
  }
}

function timesOf({ frames, first, count, fps }: ArrayTake): Float64Array {
  const out = new Float64Array(count);
  for (let f = 0; f < count; f++) out[f] = frames.startSeconds + (first + f) / fps;
  return out;
}

/** All of them, with the names and shapes of the comment above. */
export function namedArrays(a: TakeArrays): readonly DataArray[] {
  const [T, J, E, C] = [a.frameCount, a.names.length, a.endNames.length, a.contactJoints.length];
  return [
    { name: 'names', type: 'text', shape: [J], data: a.names },
    { name: 'parents', type: 'int', shape: [J], data: a.parents },
    { name: 'offsets', type: 'float', shape: [J, 3], data: a.offsets },
    { name: 'end_names', type: 'text', shape: [E], data: a.endNames },
    { name: 'end_parents', type: 'int', shape: [E], data: a.endParents },
    { name: 'end_offsets', type: 'float', shape: [E, 3], data: a.endOffsets },
    { name: 'positions', type: 'float', shape: [T, J, 3], data: a.positions },
    { name: 'end_positions', type: 'float', shape: [T, E, 3], data: a.endPositions },
    { name: 'world_quat', type: 'float', shape: [T, J, 4], data: a.worldQuat },
    { name: 'local_quat', type: 'float', shape: [T, J, 4], data: a.localQuat },
    { name: 'local_6d', type: 'float', shape: [T, J, 6], data: a.local6d },
    { name: 'root_positions', type: 'float', shape: [T, 3], data: a.rootPositions },
    { name: 'velocities', type: 'float', shape: [T, J, 3], data: a.velocities },
    { name: 'contacts', type: 'bool', shape: [T, C], data: a.contacts },
    { name: 'contact_joints', type: 'int', shape: [C], data: a.contactJoints },
    { name: 'fps', type: 'float', shape: [], data: Float64Array.of(a.fps) },
    { name: 'times', type: 'float', shape: [T], data: a.times },
  ];
}

function refuseTooLarge(frameCount: number, perFrame: number, precision: Precision): void {
  const bytes = frameCount * perFrame * (precision === 'float64' ? 8 : 4);
  if (bytes <= MAX_BYTES) return;
  throw new CommandError(
    `Its ${frameCount.toLocaleString('en')} frames would be ${(bytes / 2 ** 30).toFixed(1)} GiB, but the maximum is ` +
      `${MAX_BYTES / 2 ** 30} GiB. Crop it, or lower the frame rate.`,
  );
}

/** The joint that moves the character over the ground. */
function carrierOf({ character, skeleton }: ArrayTake): number {
  const { driver } = character;
  if (driver) return retargetCarrier(driver, skeleton);
  const take = playedTake(character);
  return take ? carrierIn(skeleton, take) : 0;
}

function offsetsOf({ joints }: Skeleton, space: Space | undefined): Float64Array {
  const out = new Float64Array(3 * joints.length);
  const metres = space ? metresPerUnit(space) : 1;
  const root = new Float64Array(3);
  joints.forEach(({ parent, offset: [x, y, z] }, j) => {
    if (parent < 0) applySpace(space, x, y, z, root);
    out.set(parent < 0 ? root : [metres * x, metres * y, metres * z], 3 * j);
  });
  return out;
}

/** `Hand_end`, `Hand_end2`: those of files have no names. */
function endNamesOf({ joints }: Skeleton): readonly string[] {
  return joints.flatMap(({ name, endSites = [] }) => endSites.map((_, i) => `${name}_end${i > 0 ? i + 1 : ''}`));
}

/** Where the feet are over the whole take, and when they are on the ground. */
class FootPaths {
  readonly balls: readonly number[];
  private readonly leg: number;
  private readonly points: Float64Array;
  private readonly toMetres: Space | undefined;

  constructor(private readonly asked: ArrayTake) {
    const { skeleton, character, frames, space } = asked;
    const { balls, leg } = feetOf(skeleton, character.space);
    this.balls = balls;
    this.leg = leg;
    this.points = new Float64Array(3 * balls.length * frames.frameCount);
    this.toMetres = space ? undefined : character.space;
  }

  take(frame: number, positions: Float64Array): void {
    const { balls, points, toMetres } = this;
    for (let i = 0; i < balls.length; i++) {
      const p = 3 * balls[i];
      applySpace(toMetres, positions[p], positions[p + 1], positions[p + 2], foot);
      const o = 3 * (frame * balls.length + i);
      for (let k = 0; k < 3; k++) points[o + k] = foot[k];
    }
  }

  /** Frames × feet. */
  contacts(): Uint8Array {
    const { balls, leg, points, asked } = this;
    const { first, count, frames } = asked;
    const width = balls.length;
    const { startSeconds: start, frameSeconds: step, frameCount } = frames;
    const paths = { count: frameCount, start, step, width, points };
    const out = new Uint8Array(width * count);
    balls.forEach((_, i) => {
      const spans = framesOfSpans(paths, contactSpans(paths, i, standingHeight(paths, i), leg));
      for (let s = 0; s < spans.length; s += 2) {
        const from = Math.max(0, spans[s] - first);
        const to = Math.min(count - 1, spans[s + 1] - first);
        for (let row = from; row <= to; row++) out[row * width + i] = 1;
      }
    });
    return out;
  }
}

/** Scratch; never escapes. */
const foot = new Float64Array(3);
