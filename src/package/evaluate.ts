/**
 * `marrow/evaluate`: what characters do at a time, in doubles, into arrays of the caller.
 *
 *     const dofs = poseAt(character, 0.5);                          one number per DOF: angles in radians, lengths
 *     const world = worldMatrices(character.skeleton, dofs);        16 numbers per joint, column-major
 *
 * Functions that take `out` write into it and return it; without it they make an array. With it they allocate nothing.
 */
import { retargetBaked, retargetedTo } from '../edit/commands/retarget.ts';
import { compileTake } from '../evaluate/compiled-take.ts';
import { evaluateChannel as channelAt } from '../evaluate/curves.ts';
import { solve } from '../evaluate/ik/solve.ts';
import type { IkProblem, IkResult } from '../evaluate/ik/state.ts';
import { compileSkeleton, localMatrices as localOf, worldMatrices as worldOf } from '../evaluate/kinematics.ts';
import { dofCountOf, poseAt as poseOf } from '../evaluate/pose.ts';
import {
  blendMorphs,
  compileSkin,
  deform,
  matrixCountOf,
  skinMatrices as skinMatricesOf,
} from '../evaluate/skin/deform.ts';
import { type Character, shownSkin } from '../model/document.ts';
import { perObject } from '../model/per-object.ts';
import type { Skeleton } from '../model/skeleton/skeleton.ts';
import type { Skin } from '../model/skin.ts';
import type { JointPair, RetargetOptions } from '../model/takes/retarget.ts';
import type { Take } from '../model/takes/take.ts';

export { IkError, type IkOptions, type IkPin } from '../evaluate/ik/pins.ts';
export { ikProblem, movePin, turnPin } from '../evaluate/ik/problem.ts';
export type { IkProblem, IkResult } from '../evaluate/ik/state.ts';
export { provideLayers } from '../evaluate/layers.ts';

/** Number of a character's DOFs: the length of its poses. `characterDofs` of `marrow/model` names them. */
export function dofCount(character: Character): number {
  return dofCountOf(character);
}

/**
 * The value of a channel at a time, in the unit of its DOF; 0 if it has neither keys nor samples.
 * @param channel index; see `characterDofs`
 */
export function evaluateChannel(take: Take, channel: number, timeSeconds: number): number {
  return channelAt(compileTake(take), channel, timeSeconds);
}

/**
 * A character's pose while its shown take plays: what its channels give, over the file pose, within limits if it
 * enforces them, with linked DOFs following.
 * @param out one number per DOF
 */
export function poseAt(
  character: Character,
  timeSeconds: number,
  out: Float64Array = new Float64Array(dofCountOf(character)),
): Float64Array {
  poseOf(character, timeSeconds, out);
  return out;
}

/**
 * The matrix of each joint in the character's space.
 * @param dofs from `poseAt`
 * @param out 16 numbers per joint, column-major, as in three.js
 */
export function worldMatrices(
  skeleton: Skeleton,
  dofs: Float64Array,
  out: Float64Array = new Float64Array(16 * skeleton.joints.length),
): Float64Array {
  worldOf(compileSkeleton(skeleton), dofs, out);
  return out;
}

/**
 * The matrix of each joint relative to its parent.
 * @param dofs from `poseAt`
 * @param out 16 numbers per joint, column-major
 */
export function localMatrices(
  skeleton: Skeleton,
  dofs: Float64Array,
  out: Float64Array = new Float64Array(16 * skeleton.joints.length),
): Float64Array {
  localOf(compileSkeleton(skeleton), dofs, out);
  return out;
}

/**
 * World matrix times inverse binding matrix of each joint that a skin is bound to, for skinning on the GPU.
 * @param world from `worldMatrices`
 * @param out 16 numbers per binding, at least 16
 */
export function skinMatrices(
  skin: Skin,
  world: Float64Array,
  out: Float64Array = new Float64Array(16 * matrixCountOf(skin)),
): Float64Array {
  skinMatricesOf(compileSkin(skin), world, out);
  return out;
}

/**
 * Writes the vertices of a character's shown skin in a pose: morphs blended, then linear blend skinning.
 * @param dofs from `poseAt`
 * @param positions x y z per vertex
 * @param normals x y z per vertex, normalised
 */
export function deformSkin(
  character: Character,
  dofs: Float64Array,
  positions: Float64Array,
  normals: Float64Array,
): void {
  const { skeleton, morphs } = character;
  const skin = shownSkin(character);
  if (!skin) return;
  const world = skeleton && worldMatrices(skeleton, dofs, scratchOf(skeleton));
  const compiled = compileSkin(skin);
  blendMorphs(compiled, morphs, dofs, dofCountOf(character) - morphs.length, positions, normals);
  deform(compiled, world, positions, normals, positions, normals);
}

const scratchOf = perObject(({ joints }: Skeleton) => new Float64Array(16 * joints.length));

/**
 * Moves a pose so that pins are at their targets, or as near as possible. Allocates nothing.
 * @param problem from `ikProblem`; targets are moved by `movePin`
 * @param dofs changed in place
 * @param thorough whether to try several starting poses if the pins aren't reached; for once, not for every frame
 * @returns the problem's own result, overwritten by the next call
 */
export function solveIk(problem: IkProblem, dofs: Float64Array, thorough = false): IkResult {
  return solve(problem, dofs, thorough ? 'settle' : 'rest');
}

/** Options of `retarget`. */
export interface RetargetSettings extends Partial<RetargetOptions> {
  /** Which joint follows which; absent: matched by names and shape. */
  readonly pairs?: readonly JointPair[];
}

/**
 * A character that plays the shown take of another one: `poseAt` gives it, by the source's seconds.
 * @throws UserError if one of them has no skeleton, or the source no take
 */
export function retarget(target: Character, source: Character, settings: RetargetSettings = {}): Character {
  const { pairs, ...options } = settings;
  return retargetedTo(target, source, pairs, options);
}

/**
 * A retargeted character with what it plays as a take of its own, a sample per frame.
 * @param framesPerSecond default: that of the source's take, or 30 if its keys have none
 * @throws UserError if the character is not retargeted
 */
export function bakeRetarget(character: Character, framesPerSecond?: number): Character {
  return retargetBaked(character, framesPerSecond);
}
