/**
 * Where some joints of a character are over its take, as displayed: the data of all quantities (`quantities.ts`).
 *
 *     positions    in the scene, with the placement and the space of the character
 *     rotations    relative to the parent, and from rest: R_rest⁻¹ · R_parent⁻¹ · R
 *     contacts     of feet with the ground (`foot-contacts.ts`)
 */

import { backMultiply3, copy3, writeRotationPart } from '../../math/mat3.ts';
import { quaternionOfRotation } from '../../math/quaternion.ts';
import type { Character } from '../../model/document.ts';
import { restPose } from '../../model/skeleton/dofs.ts';
import { arePoints } from '../../model/skeleton/joint-types.ts';
import { type Frames, MAX_FRAMES, playedTake } from '../bake.ts';
import { contactSpans, feetOf, framesOfSpans, standingHeight } from '../foot-contacts.ts';
import { inTakes } from '../in-takes.ts';
import { compileSkeleton, worldMatrices } from '../kinematics.ts';
import { dofCountOf, poseFrom, poseSource } from '../pose.ts';
import { framesOfTake } from '../samples/key-frames.ts';
import { NO_TRAVEL, placementMatrix } from '../space/placements.ts';
import { applySpace } from '../space/space.ts';
import type { Steps } from '../steps.ts';
import { isVisible } from '../visible-points.ts';
import { jointMasses, type MassModel } from './mass.ts';

/** Joints over the frames of a take: positions, rotations, contacts and the centre of mass. */
export interface Tracks {
  /** Frame f is at `startSeconds + f · frameSeconds` of the transport. */
  readonly frames: Frames;
  /** Those asked for, then feet that are not among them. */
  readonly joints: readonly number[];
  /** x y z per frame, one row per joint; NaN where a point is missing. */
  readonly positions: readonly Float64Array[];
  /** x y z w per frame, unit, one row per joint. */
  readonly rotations: readonly Float64Array[];
  /** x y z of the centre of mass per frame. */
  readonly mass: Float64Array;
  readonly massModel: MassModel;
  /** Joints of the feet that were recognised. */
  readonly feet: readonly number[];
  /** 1 while on the ground, else 0; one row per foot. */
  readonly contacts: readonly Float64Array[];
}

/** For a range of keys that has more frames than a page can hold. */
const FRAMES_INSTEAD = 100_000;

function keptInBounds(frames: Frames, [start, end]: readonly [number, number]): Frames {
  if (frames.frameCount <= MAX_FRAMES) return frames;
  // The length of a range from −1e308 to 1e308 is not a number.
  const frameSeconds = end / (FRAMES_INSTEAD - 1) - start / (FRAMES_INSTEAD - 1);
  return { startSeconds: start, frameSeconds, frameCount: FRAMES_INSTEAD };
}

/**
 * Frames of the take that drives a character, in seconds of the transport; undefined if it shows none.
 * @param framesPerSecond the rate of a take that has none of its own; keys over hours have fewer frames, over all of
 *   their range
 */
export function measuredFrames(character: Character, framesPerSecond: number): Frames | undefined {
  const take = playedTake(character);
  if (!take) return undefined;
  const frames = take.samples
    ? framesOfTake(take, framesPerSecond)
    : keptInBounds(framesOfTake(take, framesPerSecond), take.range);
  const offset = character.timeOffsetSeconds + (character.driver?.source.timeOffsetSeconds ?? 0);
  return { ...frames, startSeconds: frames.startSeconds - offset };
}

/** Frames between two progress reports, a few milliseconds at most. */
const FRAMES_AT_A_TIME = 32;

/**
 * Samples in steps: yields progress, 0 to 1.
 * @throws Error if the character has no skeleton
 */
export function* trackJoints(character: Character, frames: Frames, asked: readonly number[]): Steps<Tracks> {
  const { skeleton, space } = character;
  if (!skeleton) throw new Error(`${character.name} has no skeleton: there is nothing to measure.`);
  const { frameCount, startSeconds, frameSeconds } = frames;
  const compiled = compileSkeleton(skeleton);
  const world = new Float64Array(16 * skeleton.joints.length);
  worldMatrices(compiled, Float64Array.from(restPose(skeleton, 0)), world);
  const { balls: feet, leg } = feetOf(skeleton, space);
  const joints = [...asked, ...feet.filter((foot) => !asked.includes(foot))];
  const rests = joints.map((joint) => {
    const rest = new Float64Array(9);
    writeLocal(world, joint, skeleton.joints[joint].parent, rest);
    return rest;
  });
  const rows = (count: number, width: number) =>
    Array.from({ length: count }, () => new Float64Array(width * frameCount));
  const positions = rows(joints.length, 3);
  const rotations = rows(joints.length, 4);
  const mass = new Float64Array(3 * frameCount);
  const masses = jointMasses(skeleton);
  const hasPoints = arePoints(skeleton);
  const points = new Float64Array(3 * feet.length * frameCount);
  const toScene = new Float64Array(16);
  placementMatrix(character.placements[0], space, NO_TRAVEL, toScene);
  // Changes that are not keyed hold at one time only, and are no part of the take.
  const source = poseSource(inTakes(character));
  const dofs = new Float64Array(dofCountOf(character));
  const point = new Float64Array(3);
  for (let f = 0; f < frameCount; f++) {
    if (f % FRAMES_AT_A_TIME === 0) yield f / frameCount;
    poseFrom(source, startSeconds + f * frameSeconds, dofs);
    worldMatrices(compiled, dofs, world);
    for (let k = 0; k < joints.length; k++) {
      const joint = joints[k];
      const at = 16 * joint + 12;
      writePoint(toScene, world[at], world[at + 1], world[at + 2], positions[k], 3 * f);
      if (hasPoints && !isVisible(compiled, joint, dofs)) positions[k].fill(Number.NaN, 3 * f, 3 * f + 3);
      writeLocal(world, joint, compiled.parent[joint], local);
      backMultiply3(rests[k], 0, local, 0, fromRest, 0);
      quaternionOfRotation(fromRest, 0, quaternion);
      rotations[k].set(quaternion, 4 * f);
    }
    let x = 0;
    let y = 0;
    let z = 0;
    for (let j = 0; j < compiled.jointCount; j++) {
      const w = masses.weights[j];
      x += w * world[16 * j + 12];
      y += w * world[16 * j + 13];
      z += w * world[16 * j + 14];
    }
    writePoint(toScene, x, y, z, mass, 3 * f);
    for (let i = 0; i < feet.length; i++) {
      const at = 16 * feet[i] + 12;
      applySpace(space, world[at], world[at + 1], world[at + 2], point);
      points.set(point, 3 * (f * feet.length + i));
    }
  }
  const paths = { count: frameCount, start: startSeconds, step: frameSeconds, width: feet.length, points };
  const contacts = feet.map((_, i) => {
    const row = new Float64Array(frameCount);
    const spans = framesOfSpans(paths, contactSpans(paths, i, standingHeight(paths, i), leg));
    for (let s = 0; s < spans.length; s += 2) row.fill(1, spans[s], spans[s + 1] + 1);
    return row;
  });
  return { frames, joints, positions, rotations, mass, massModel: masses.model, feet, contacts };
}

/** Scratch; never escapes. */
const own = new Float64Array(9);
const above = new Float64Array(9);
const local = new Float64Array(9);
const fromRest = new Float64Array(9);
const quaternion = new Float64Array(4);

/** Rotation of a joint relative to its parent. */
function writeLocal(world: Float64Array, joint: number, parent: number, out: Float64Array): void {
  writeRotationPart(world, 16 * joint, own, 0, 3);
  if (parent < 0) {
    copy3(own, 0, out, 0);
    return;
  }
  writeRotationPart(world, 16 * parent, above, 0, 3);
  backMultiply3(above, 0, own, 0, out, 0);
}

function writePoint(m: Float64Array, x: number, y: number, z: number, out: Float64Array, o: number): void {
  for (let k = 0; k < 3; k++) out[o + k] = m[k] * x + m[4 + k] * y + m[8 + k] * z + m[12 + k];
}
