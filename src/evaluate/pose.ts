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
import { type Channel, isSampled } from '../model/clip.ts';
import type { Character } from '../model/document.ts';
import { shownClip } from '../model/document.ts';
import { rootDofCount } from '../model/dofs.ts';
import { compileClip } from './compiled-clip.ts';
import { evaluateClip } from './curves.ts';
import { compileSkeleton, settleDofs } from './kinematics.ts';
import { retargetPlan } from './retarget/make-plan.ts';
import { movedDofs, silentChannels } from './retarget/moved-dofs.ts';
import { retargetPose } from './retarget/retarget-pose.ts';
import { sampledJoints } from './sampled-joints.ts';
import { samplePose } from './sampled-pose.ts';

/** Times nearer than this are the same moment; seconds. */
const SAME_MOMENT = 1e-9;

/** How many DOFs a character has: the length of its poses. */
export function dofCountOf(character: Character): number {
  const { skeleton, morphs } = character;
  const joints = skeleton ? compileSkeleton(skeleton).firstDof[skeleton.joints.length] : rootDofCount(undefined);
  return joints + morphs.length;
}

/**
 * Writes the value of each of the character's DOFs (`model/dofs.ts`) to `out`, which has `dofCountOf` of them at least.
 * @param timeSeconds of the transport; the character's own offset is added here
 */
export function poseAt(character: Character, timeSeconds: number, out: Float64Array): void {
  const { pose, unkeyed, skeleton, driver } = character;
  const count = dofCountOf(character);
  const clip = skeleton && shownClip(character);
  const driven = clip ? Math.min(clip.channels.length, count) : 0;
  for (let d = driven; d < count; d++) out[d] = pose[d] ?? 0;
  if (clip) {
    const compiled = compileClip(clip);
    const time = timeSeconds + character.timeOffsetSeconds;
    evaluateClip(compiled, time, out, driven);
    const { samples } = compiled;
    if (samples) samplePose(samples, compiled, sampledJoints(compiled, skeleton), time, out, driven);
  }
  if (driver && skeleton) {
    const plan = retargetPlan(driver, character, skeleton);
    for (let d = 0; d < plan.restDofs.length; d++) out[d] = pose[d] ?? 0;
    const clipSeconds = timeSeconds + character.timeOffsetSeconds + driver.source.timeOffsetSeconds;
    retargetPose(plan, clipSeconds, out);
  }
  if (unkeyed && Math.abs(timeSeconds - unkeyed.timeSeconds) <= SAME_MOMENT) {
    for (let i = 0; i < unkeyed.dofs.length; i++) {
      if (unkeyed.dofs[i] < count) out[unkeyed.dofs[i]] = unkeyed.values[i];
    }
  }
  if (skeleton) settleDofs(compileSkeleton(skeleton), out, character.clampsToLimits);
}

/** The channel that has the say over a DOF, whether it has keys or only stands at a value; none where another has. */
export function channelOf(character: Character, dof: number): Channel | undefined {
  if (!character.skeleton || dof >= dofCountOf(character) || dof < silentChannels(character)) return undefined;
  return shownClip(character)?.channels[dof];
}

/** Whether keys or samples of the clip shown drive the DOF, or another character's take does. */
export function isDriven(character: Character, dof: number): boolean {
  if (dof < silentChannels(character)) return movedDofs(character)?.has(dof) ?? false;
  const clip = shownClip(character);
  const channel = channelOf(character, dof);
  return clip !== undefined && channel !== undefined && (channel.times.length > 0 || isSampled(clip, dof));
}
