/**
 * The root of a character where a joint of another one takes it, in spans of its take:
 *
 *     P · R = P' · W · offset        R, W      matrices of the root and of the joint that it follows, in their own spaces
 *                                    P, P'     placements of both characters
 *
 * The root gets the place and, if it takes any rotation, the rotation of that; what scales the joint moves its place,
 * and scales nothing. The leader is posed at the same time, in its own order: limits, its own attachments, limbs.
 */
import { backMultiply3, multiply3, writeRotationPart } from '../math/mat3.ts';
import { invertAffine, multiplyAffine } from '../math/mat4.ts';
import type { Vec3 } from '../math/vec3.ts';
import { type Character, DEFAULT_PLACEMENT, type Placement } from '../model/document.ts';
import { perPair } from '../model/per-object.ts';
import type { Skeleton } from '../model/skeleton/skeleton.ts';
import type { Follower, OverPose } from '../model/takes/layer-code.ts';
import type { AttachmentOffset, Attachments, Take } from '../model/takes/take.ts';
import { type CompiledSkeleton, compileSkeleton, writeLocal } from './kinematics.ts';
import { anglesIn, intoSpace } from './limbs/match.ts';
import { writeEuler } from './limbs/target.ts';
import { type TurnedJoint, turnedJoint, turnJoint } from './limbs/turned-joint.ts';
import { type PoseSource, poseFrom, poseSource } from './pose.ts';
import { NO_TRAVEL, placementMatrix } from './space/placements.ts';
import { limbsOf } from './take-motion.ts';

/** A root that can follow: which of its DOFs change. */
export interface FollowingRoot {
  /** The DOFs along x, y and z. */
  readonly travel: Int32Array;
  /** Undefined if it doesn't take any rotation, and keeps its own. */
  readonly turned: TurnedJoint | undefined;
}

/** The root of a skeleton as one that follows; undefined if it can't be moved along x, y and z of the character's space. */
export function followingRoot(skeleton: Skeleton): FollowingRoot | undefined {
  const compiled = compileSkeleton(skeleton);
  const { travel, hasRootTranslation } = compiled;
  const turned = turnedJoint(skeleton, compiled, 0);
  if (travel.some((dof) => dof < 0) || !(hasRootTranslation || turned || !turnsItself(compiled))) return undefined;
  return { travel, turned };
}

/** Whether the root joint has other DOFs than those along x, y and z, which may come before them. */
function turnsItself({ firstDof }: CompiledSkeleton): boolean {
  return firstDof[1] > 3;
}

/** A joint of a character in the scene. */
class JointInScene {
  private readonly source: PoseSource;
  private readonly skeleton: CompiledSkeleton;
  private readonly dofs: Float64Array;
  private readonly placement = new Float64Array(16);
  /** The joint with those above it, from the root down. */
  private readonly path: readonly number[];

  constructor(character: Character, joint: number, placement: Placement) {
    const { skeleton, space } = character;
    if (!skeleton?.joints[joint]) throw new Error(`${character.name} has no joint ${joint}.`);
    this.source = poseSource(character);
    this.skeleton = compileSkeleton(skeleton);
    this.dofs = new Float64Array(this.source.count);
    placementMatrix(placement, space, NO_TRAVEL, this.placement);
    const path: number[] = [];
    for (let j = joint; j >= 0; j = this.skeleton.parent[j]) path.unshift(j);
    this.path = path;
  }

  /** Writes the joint's matrix at a time of the transport. */
  write(timeSeconds: number, out: Float64Array): void {
    const { skeleton, dofs, path } = this;
    poseFrom(this.source, timeSeconds, dofs);
    out.set(this.placement);
    for (let i = 0; i < path.length; i++) {
      writeLocal(skeleton, path[i], dofs, local, 0);
      multiplyAffine(out, 0, local, 0, product, 0);
      out.set(product);
    }
  }
}

/** Scratch; never escapes, and is not used while a leader is posed. */
const local = new Float64Array(16);
const product = new Float64Array(16);
const turn = new Float64Array(9);
const turnInScene = new Float64Array(9);

/**
 * A joint's matrix in the scene, by the first placement of its character.
 * @param timeSeconds of the transport
 * @throws Error if the character has no such joint
 */
export function jointInScene(character: Character, joint: number, timeSeconds: number): Float64Array {
  const matrix = new Float64Array(16);
  new JointInScene(character, joint, character.placements[0]).write(timeSeconds, matrix);
  return matrix;
}

/** The offset with which a root is where it is, by the matrices of the joint and the root in the scene. */
export function offsetBetween(joint: Float64Array, root: Float64Array): AttachmentOffset {
  const [x, y, z] = anglesIn(joint, 0, root);
  // Adding 0 avoids −0 in files.
  return { position: intoSpace(joint, 0, root.subarray(12, 15)), rotation: [x + 0, y + 0, z + 0] };
}

interface Span {
  readonly start: number;
  readonly end: number;
  readonly joint: JointInScene;
  readonly position: readonly number[];
  /** Nine numbers. */
  readonly turn: Float64Array;
  /** From the scene to the follower's space, and the rotation from there. */
  readonly inverse: Float64Array;
  readonly placed: Float64Array;
}

/**
 * The placements of a follower and its leader. What they have in common counts for nothing, so that the numbers don't
 * depend on where both are.
 */
function placementsOf(own: Placement, leader: Placement): readonly [Placement, Placement] {
  const same = (a: Vec3, b: Vec3) => a.every((value, k) => value === b[k]);
  if (!same(own.position, leader.position) || !same(own.turn, leader.turn)) return [own, leader];
  return [
    { ...DEFAULT_PLACEMENT, scale: own.scale },
    { ...DEFAULT_PLACEMENT, scale: leader.scale },
  ];
}

class AttachedRoot {
  /** By their starts. */
  private readonly spans: readonly Span[];
  private readonly skeleton: CompiledSkeleton;
  private readonly root: FollowingRoot | undefined;
  /** The joint that is followed, in the scene. */
  private readonly scene = new Float64Array(16);

  constructor({ list }: Attachments, { placements, space, leaders = [] }: Follower, skeleton: Skeleton) {
    this.skeleton = compileSkeleton(skeleton);
    this.root = followingRoot(skeleton);
    this.spans = list.flatMap(({ leaderId, joint, span: [start, end], offset }): Span[] => {
      const leader = leaders.find(({ id }) => id === leaderId);
      if (!leader?.skeleton?.joints[joint]) return [];
      const [own, leading] = placementsOf(placements[0], leader.placements[0]);
      const placement = new Float64Array(16);
      placementMatrix(own, space, NO_TRAVEL, placement);
      const [inverse, placed, turn] = [new Float64Array(16), new Float64Array(9), new Float64Array(9)];
      writeRotationPart(placement, 0, placed, 0, 3);
      invertAffine(placement, 0, inverse, 0);
      writeEuler(...offset.rotation, turn);
      const { position } = offset;
      return [{ start, end, joint: new JointInScene(leader, joint, leading), position, turn, inverse, placed }];
    });
  }

  solve(timeSeconds: number, dofs: Float64Array): void {
    const { root, scene } = this;
    const span = this.spanAt(timeSeconds);
    if (!span || !root) return;
    const { inverse, placed } = span;
    span.joint.write(timeSeconds, scene);
    if (root.turned) {
      writeRotationPart(scene, 0, turn, 0, 3);
      multiply3(turn, 0, span.turn, 0, turnInScene, 0);
      backMultiply3(placed, 0, turnInScene, 0, turn, 0);
      turnJoint(root.turned, turn, dofs);
    }
    const [x, y, z] = span.position;
    const px = scene[0] * x + scene[4] * y + scene[8] * z + scene[12];
    const py = scene[1] * x + scene[5] * y + scene[9] * z + scene[13];
    const pz = scene[2] * x + scene[6] * y + scene[10] * z + scene[14];
    writeLocal(this.skeleton, 0, dofs, local, 0);
    for (let k = 0; k < 3; k++) {
      const place = inverse[k] * px + inverse[4 + k] * py + inverse[8 + k] * pz + inverse[12 + k];
      dofs[root.travel[k]] += place - local[12 + k];
    }
  }

  private spanAt(timeSeconds: number): Span | undefined {
    const { spans } = this;
    let i = spans.length - 1;
    while (i >= 0 && spans[i].start > timeSeconds) i--;
    return i >= 0 && timeSeconds < spans[i].end ? spans[i] : undefined;
  }
}

/** The last part of posing by an attached take: the root goes where it is attached, then limbs to their goals. Cached. */
export const overPose = perPair((take: Take, character: Follower): OverPose => {
  const { skeleton } = character;
  const root = take.attached && skeleton && new AttachedRoot(take.attached, character, skeleton);
  const limbs = limbsOf(take, character);
  return {
    solve(timeSeconds, dofs, clamps, count, unkeyed) {
      root?.solve(timeSeconds, dofs);
      limbs?.solve(timeSeconds, dofs, clamps, count, unkeyed);
    },
  };
});
