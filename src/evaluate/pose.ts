/**
 * A character's pose at a time, from what has a say in it, later ones on top:
 *
 *     1. the pose as set       every DOF
 *     2. the clip shown        what has a channel there; needs a skeleton, for channels are counted by its DOFs
 *     3. another's take        put onto this one: it has the say over all joints, the clip only over morphs
 *     4. DOFs set by hand      over the clip, at the moment they were set and no other
 *     5. limits                of the joints, unless the character's switch is off
 *     6. couples               DOFs that follow others, whatever has been said of them before
 */
import type { Channel } from '../model/clip.ts';
import type { Character } from '../model/document.ts';
import { shownClip } from '../model/document.ts';
import { rootDofCount } from '../model/dofs.ts';
import { type CompiledClip, compileClip } from './compiled-clip.ts';
import { evaluateClip } from './curves.ts';
import { drivenPose } from './driven-pose.ts';
import { applyConstraints, type CompiledSkeleton, compileSkeleton } from './kinematics.ts';
import type { PoseRotations } from './pose-rotations.ts';
import { movedDofs, silentChannels } from './retarget/moved-dofs.ts';
import { type SampledJoints, sampledJoints } from './sampled-joints.ts';
import { samplePose } from './sampled-pose.ts';

/** Times nearer than this are the same moment; seconds. */
const SAME_MOMENT = 1e-9;

/** How many DOFs a character has: the length of its poses. */
export function dofCountOf(character: Character): number {
  const { skeleton, morphs } = character;
  const joints = skeleton ? compileSkeleton(skeleton).firstDof[skeleton.joints.length] : rootDofCount(undefined);
  return joints + morphs.length;
}

/** What posing a character looks up, found once for many moments. Of use as long as the character is the same object. */
export interface PoseSource {
  readonly character: Character;
  /** DOFs, and how many of them have a channel in the clip shown. */
  readonly count: number;
  readonly driven: number;
  readonly skeleton: CompiledSkeleton | undefined;
  readonly curves: CompiledClip | undefined;
  /** Where samples drive it. */
  readonly joints: SampledJoints | undefined;
}

export function poseSource(character: Character): PoseSource {
  const { skeleton } = character;
  const clip = skeleton && shownClip(character);
  const count = dofCountOf(character);
  const curves = clip && compileClip(clip);
  return {
    character,
    count,
    driven: clip ? Math.min(clip.channels.length, count) : 0,
    skeleton: skeleton && compileSkeleton(skeleton),
    curves,
    joints: curves?.samples && skeleton && sampledJoints(curves, skeleton),
  };
}

/**
 * Writes the value of each of the character's DOFs (`model/dofs.ts`) to `out`, which has `dofCountOf` of them at least.
 * @param timeSeconds of the transport; the character's own offset is added here
 */
export function poseAt(character: Character, timeSeconds: number, out: Float64Array): void {
  poseFrom(poseSource(character), timeSeconds, out);
}

/**
 * `poseAt` for what was looked up before. Allocates nothing.
 * @param rotations takes those that samples give to the joints, and loses the ones it had
 */
export function poseFrom(source: PoseSource, timeSeconds: number, out: Float64Array, rotations?: PoseRotations): void {
  const { character, count, driven, skeleton, curves, joints } = source;
  const { pose, unkeyed, driver } = character;
  rotations?.clear();
  for (let d = driven; d < count; d++) out[d] = pose[d] ?? 0;
  if (curves) {
    const time = timeSeconds + character.timeOffsetSeconds;
    evaluateClip(curves, time, out, driven);
    if (curves.samples && joints) samplePose(curves.samples, curves, joints, time, out, driven, rotations);
  }
  if (driver && character.skeleton) drivenPose(character, driver, character.skeleton, timeSeconds, out);
  if (unkeyed && Math.abs(timeSeconds - unkeyed.timeSeconds) <= SAME_MOMENT) {
    for (let i = 0; i < unkeyed.dofs.length; i++) {
      if (unkeyed.dofs[i] < count) out[unkeyed.dofs[i]] = unkeyed.values[i];
    }
  }
  if (skeleton) applyConstraints(skeleton, out, character.clampsToLimits);
}

/** The channel that has the say over a DOF, whatever its kind; none where another has. */
export function channelOf(character: Character, dof: number): Channel | undefined {
  if (!character.skeleton || dof >= dofCountOf(character) || dof < silentChannels(character)) return undefined;
  return shownClip(character)?.channels[dof];
}

/** Whether keys or samples of the clip shown drive the DOF, or another character's take does. */
export function isDriven(character: Character, dof: number): boolean {
  if (dof < silentChannels(character)) return movedDofs(character)?.has(dof) ?? false;
  const channel = channelOf(character, dof);
  return channel !== undefined && channel.kind !== 'rest';
}
