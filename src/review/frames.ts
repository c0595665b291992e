/** A take frame by frame, as points in metres with y up and the ground at 0. */

import { playedTake } from '../evaluate/bake.ts';
import { bareCharacter } from '../evaluate/bare-character.ts';
import { endSitesOf, endsAt, hasStretches } from '../evaluate/end-sites.ts';
import { inTakes } from '../evaluate/in-takes.ts';
import { type CompiledSkeleton, compileSkeleton, worldMatrices } from '../evaluate/kinematics.ts';
import { dofCountOf, type PoseSource, poseFrom, poseSource } from '../evaluate/pose.ts';
import { PoseRotations } from '../evaluate/rotations/pose-rotations.ts';
import { framesOfTake } from '../evaluate/samples/key-frames.ts';
import { metresPerUnit } from '../evaluate/space/metres.ts';
import type { Character } from '../model/document.ts';
import type { Skeleton } from '../model/skeleton/skeleton.ts';
import { DEFAULT_SPACE, type Space } from '../model/space.ts';
import type { Take } from '../model/takes/take.ts';

/** Frames per second of takes that have none. */
export const KEYED_RATE = 60;
const MAX_KEYED_FRAMES = 100_000;

export interface TakeFrames {
  readonly skeleton: Skeleton;
  readonly take: Take;
  readonly count: number;
  readonly frameSeconds: number;
  readonly startSeconds: number;
  /** Joints, then End Sites. */
  readonly pointCount: number;
  /** The joint above each point; −1 for the root. */
  readonly above: Int32Array;
  /** The name of a joint. */
  nameOf(joint: number): string;
  /** Seconds of the take. */
  secondsOf(frame: number): number;
  /** Writes the DOFs, and x y z of each point. Allocates nothing. */
  write(frame: number, dofs: Float64Array, points: Float64Array): void;
  readonly dofCount: number;
}

export function takeFrames(skeleton: Skeleton, take: Take, space: Space = DEFAULT_SPACE): TakeFrames {
  return framesOfBare({ ...bareCharacter(skeleton, take), space }, skeleton, take, 0);
}

/**
 * The frames of what a character plays, as displayed: a take that is retargeted to it, or its own, within its limits if
 * these are enforced. Undefined without a skeleton or a take.
 */
export function displayedFrames(character: Character): TakeFrames | undefined {
  const take = playedTake(character);
  if (!character.skeleton || !take) return undefined;
  const offset = character.driver?.source.timeOffsetSeconds ?? 0;
  return framesOfBare({ ...inTakes(character), timeOffsetSeconds: 0 }, character.skeleton, take, offset);
}

/** @param offsetSeconds from the character's time to that of the take */
function framesOfBare(character: Character, skeleton: Skeleton, take: Take, offsetSeconds: number): TakeFrames {
  const space = character.space ?? DEFAULT_SPACE;
  const source = poseSource(character);
  const { startSeconds, frameSeconds, frameCount } = framesOfTake(take, KEYED_RATE);
  const compiled = compileSkeleton(skeleton);
  const { owners, ends } = endSitesOf(skeleton);
  const posing: Posing = {
    source,
    compiled,
    rotations: new PoseRotations(skeleton.joints.length),
    world: new Float64Array(16 * skeleton.joints.length),
    skeleton,
    endJoints: owners,
    ends,
    ...(hasStretches(skeleton) && { lengthened: ends.slice() }),
    metres: metresPerUnit(space),
    up: space.up,
    lift: space.lift,
  };
  const secondsOf = (frame: number) => startSeconds + frame * frameSeconds;
  return {
    skeleton,
    take,
    count: take.samples ? frameCount : Math.min(MAX_KEYED_FRAMES, frameCount),
    frameSeconds,
    startSeconds,
    pointCount: skeleton.joints.length + owners.length,
    above: Int32Array.from([...skeleton.joints.map(({ parent }) => parent), ...owners]),
    nameOf: (joint) => skeleton.joints[joint]?.name ?? '',
    secondsOf,
    write: (frame, dofs, points) => writePoints(posing, secondsOf(frame) - offsetSeconds, dofs, points),
    dofCount: dofCountOf(character),
  };
}

interface Posing {
  readonly source: PoseSource;
  readonly compiled: CompiledSkeleton;
  readonly rotations: PoseRotations;
  readonly world: Float64Array;
  readonly skeleton: Skeleton;
  readonly endJoints: Int32Array;
  /** x y z of each End Site in its joint's space. */
  readonly ends: Float64Array;
  /** Those of one frame, where DOFs lengthen bones. */
  readonly lengthened?: Float64Array;
  readonly metres: number;
  readonly up: Space['up'];
  readonly lift: number;
}

function writePoints(posing: Posing, seconds: number, dofs: Float64Array, points: Float64Array): void {
  const { source, skeleton, compiled, rotations, world, endJoints, lengthened } = posing;
  poseFrom(source, seconds, dofs, rotations);
  const ends = (lengthened && endsAt(skeleton, endJoints, posing.ends, dofs, 0, lengthened)) ?? posing.ends;
  worldMatrices(compiled, dofs, world, rotations);
  const joints = compiled.jointCount;
  for (let j = 0; j < joints; j++) {
    writePoint(posing, world[16 * j + 12], world[16 * j + 13], world[16 * j + 14], points, 3 * j);
  }
  for (let e = 0; e < endJoints.length; e++) {
    const o = 16 * endJoints[e];
    const x = ends[3 * e];
    const y = ends[3 * e + 1];
    const z = ends[3 * e + 2];
    writePoint(
      posing,
      world[o] * x + world[o + 4] * y + world[o + 8] * z + world[o + 12],
      world[o + 1] * x + world[o + 5] * y + world[o + 9] * z + world[o + 13],
      world[o + 2] * x + world[o + 6] * y + world[o + 10] * z + world[o + 14],
      points,
      3 * (joints + e),
    );
  }
}

function writePoint(
  { metres, up, lift }: Posing,
  x: number,
  y: number,
  z: number,
  points: Float64Array,
  o: number,
): void {
  points[o] = metres * x;
  points[o + 1] = metres * (up === 'z' ? z : up === 'y' ? y : -y) + lift;
  points[o + 2] = metres * (up === 'z' ? -y : up === 'y' ? z : -z);
}
