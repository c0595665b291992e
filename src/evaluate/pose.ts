/**
 * A character's pose at a time, from several layers, later ones on top:
 *
 *     1. the pose as set       every DOF
 *     2. the take shown        DOFs with a channel, with its layers (`layers.ts`); needs a skeleton, since channels are
 *                              counted by its DOFs
 *     3. retargeted take       overrides all joints; the character's own take then only drives morphs
 *     4. unkeyed changes       over the take, at the time when they were made only
 *     5. limits                of the joints, unless the character does not enforce them
 *     6. linked DOFs           override all the above
 *     7. attachments           put the root where a joint of another character takes it (`attached.ts`), as limbs
 *     8. limbs                 go to the goals of the take shown, if it moves the joints (`limbs/`)
 */

import type { Character, Unkeyed } from '../model/document.ts';
import { shownTake } from '../model/document.ts';
import { rootDofCount } from '../model/skeleton/dofs.ts';
import { type OverPose, withCurvesOfGoals } from '../model/takes/layer-code.ts';
import type { Channel } from '../model/takes/take.ts';
import { drivenPose } from './driven-pose.ts';
import { applyConstraints, type CompiledSkeleton, compileSkeleton } from './kinematics.ts';
import { movedDofs, silentChannels } from './retarget/moved-dofs.ts';
import type { PoseRotations } from './rotations/pose-rotations.ts';
import { evaluateMotion, overPoseOf, type TakeMotion, takeMotion } from './take-motion.ts';

/** Times closer than this are the same; seconds. */
const SAME_MOMENT = 1e-9;

/** Number of a character's DOFs, the length of its poses. */
export function dofCountOf(character: Character): number {
  const { skeleton, morphs } = character;
  const joints = skeleton ? compileSkeleton(skeleton).firstDof[skeleton.joints.length] : rootDofCount(undefined);
  return joints + morphs.length;
}

/** Data for posing a character, looked up once for many times. Valid as long as the character is the same object. */
export interface PoseSource {
  readonly character: Character;
  /** Number of DOFs, and how many of them have a channel in the shown take. */
  readonly count: number;
  readonly driven: number;
  readonly skeleton: CompiledSkeleton | undefined;
  /** The shown take, with its layers. */
  readonly motion: TakeMotion | undefined;
  /** Absent without attachments and goals. */
  readonly over: OverPose | undefined;
}

/** Everything that a character's pose is evaluated from, compiled once for all times. */
export function poseSource(character: Character): PoseSource {
  const { skeleton } = character;
  const take = skeleton && shownTake(character);
  const count = dofCountOf(character);
  return {
    character,
    count,
    driven: take ? Math.min(take.channels.length, count) : 0,
    skeleton: skeleton && compileSkeleton(skeleton),
    motion: take && takeMotion(take, skeleton),
    over: character.driver ? undefined : overPoseOf(take, character),
  };
}

/**
 * Writes the value of each of the character's DOFs (`model/dofs.ts`) to `out`, of length at least `dofCountOf`.
 * @param timeSeconds of the transport; the character's own offset is added here
 */
export function poseAt(character: Character, timeSeconds: number, out: Float64Array): void {
  poseFrom(poseSource(character), timeSeconds, out);
}

/**
 * `poseAt` with precomputed data. Allocates nothing.
 * @param rotations receives the rotations that samples give to joints; previous ones are cleared
 */
export function poseFrom(source: PoseSource, timeSeconds: number, out: Float64Array, rotations?: PoseRotations): void {
  const { character, count, driven, skeleton, motion, over } = source;
  const { pose, driver } = character;
  if (rotations) rotations.areGiven = false;
  for (let d = driven; d < count; d++) out[d] = pose[d] ?? 0;
  if (motion) evaluateMotion(motion, timeSeconds + character.timeOffsetSeconds, out, driven, rotations);
  if (driver && character.skeleton) drivenPose(character, driver, character.skeleton, timeSeconds, out);
  const byHand = shownUnkeyed(character, timeSeconds);
  if (byHand) {
    for (let i = 0; i < byHand.dofs.length; i++) {
      if (byHand.dofs[i] < count) out[byHand.dofs[i]] = byHand.values[i];
    }
  }
  if (skeleton) applyConstraints(skeleton, out, character.clampsToLimits);
  over?.solve(timeSeconds + character.timeOffsetSeconds, out, character.clampsToLimits, count, byHand);
}

/** The unkeyed changes of a time of the transport, which are shown then; undefined without any. */
export function shownUnkeyed({ unkeyed }: Character, timeSeconds: number): Unkeyed | undefined {
  return unkeyed && Math.abs(timeSeconds - unkeyed.timeSeconds) <= SAME_MOMENT ? unkeyed : undefined;
}

/** The channel that drives a DOF, or a goal, whatever its kind; undefined if something else overrides it. */
export function channelOf(character: Character, dof: number): Channel | undefined {
  const take = shownTake(character);
  const count = dofCountOf(character);
  if (!take || !character.skeleton || dof < silentChannels(character) || (dof >= count && !take.goals))
    return undefined;
  return withCurvesOfGoals(take, count).channels[dof];
}

/**
 * Whether the DOF is driven by keys or samples of the shown take, or by a retargeted take. Of a take with layers, every
 * DOF that has a channel is: what it shows is a sum, and no value of its own.
 */
export function isDriven(character: Character, dof: number): boolean {
  if (dof < silentChannels(character)) return movedDofs(character)?.has(dof) ?? false;
  const channel = channelOf(character, dof);
  const isSum = dof < dofCountOf(character) && shownTake(character)?.layers !== undefined;
  return channel !== undefined && (channel.kind !== 'rest' || isSum);
}
