/**
 * A character's pose at a time, from what has a say in it, later ones on top:
 *
 *     1. the pose as set       every DOF
 *     2. the clip shown        what has a channel there; needs a skeleton, for channels are counted by its DOFs
 *     3. DOFs set by hand      over the clip, at the moment they were set and no other
 *     4. limits                of the joints, unless the character's switch is off
 */
import { type Channel, isSampled } from '../model/clip.ts';
import type { Character } from '../model/document.ts';
import { shownClip } from '../model/document.ts';
import { rootDofCount } from '../model/dofs.ts';
import { compileClip } from './compiled-clip.ts';
import { evaluateClip } from './curves.ts';
import { clampDofs, compileSkeleton } from './kinematics.ts';

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
  const { pose, unkeyed, skeleton } = character;
  const count = dofCountOf(character);
  for (let d = 0; d < count; d++) out[d] = pose[d] ?? 0;
  const clip = shownClip(character);
  if (clip && skeleton) {
    const driven = Math.min(clip.channels.length, count);
    evaluateClip(compileClip(clip), timeSeconds + character.timeOffsetSeconds, out, driven);
  }
  if (unkeyed && Math.abs(timeSeconds - unkeyed.timeSeconds) <= SAME_MOMENT) {
    for (let i = 0; i < unkeyed.dofs.length; i++) {
      if (unkeyed.dofs[i] < count) out[unkeyed.dofs[i]] = unkeyed.values[i];
    }
  }
  if (skeleton && character.clampsToLimits) clampDofs(compileSkeleton(skeleton), out);
}

/** The channel that has the say over a DOF, whether it has keys or only stands at a value; none where the pose has. */
export function channelOf(character: Character, dof: number): Channel | undefined {
  return character.skeleton && dofCountOf(character) > dof ? shownClip(character)?.channels[dof] : undefined;
}

/** Whether keys or samples of the clip shown drive the DOF. */
export function isDriven(character: Character, dof: number): boolean {
  const clip = shownClip(character);
  const channel = channelOf(character, dof);
  return clip !== undefined && channel !== undefined && (channel.times.length > 0 || isSampled(clip, dof));
}
