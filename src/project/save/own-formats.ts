/**
 * What saving a character's parts (`model/part.ts`) goes by: which formats are its own, and the pose that goes into a
 * skeleton's file.
 */
import { poseByNames } from '../../edit/pose/by-names.ts';
import { channelOf } from '../../evaluate/pose.ts';
import type { Character } from '../../model/document.ts';
import { jointDofCount, rootDofCount } from '../../model/dofs.ts';
import type { PoseLibrary } from '../../model/part.ts';
import type { PoseByNames } from '../../model/pose-by-names.ts';
import { type FormatKind, KINDS } from '../kinds.ts';

/** Whether a character has nothing of a format itself, but can be converted to it. */
export function isExport(character: Character, kind: FormatKind): boolean {
  return !KINDS[kind].isOwn(character);
}

/** What of a library its file holds. */
export function posesByNames(library: PoseLibrary): readonly PoseByNames[] {
  return library.poses.map((pose) => poseByNames(library, pose));
}

/** The pose of the joints as set: one value for each of their DOFs, without root translation and morphs. */
export function jointPose({ pose, skeleton }: Character): readonly number[] {
  return pose.slice(rootDofCount(skeleton), rootDofCount(skeleton) + jointDofCount(skeleton));
}

/**
 * The pose that saving writes of itself: as set, but where the take shown has a channel for a DOF, what the file has
 * stays. What one sees there is the take's, and a pose that lies hidden under keys should not end up in a skeleton.
 *
 * @param inFile one value for each DOF of the joints
 */
export function poseToSave(character: Character, inFile: readonly number[]): readonly number[] {
  const first = rootDofCount(character.skeleton);
  let changed: number[] | undefined;
  for (let d = 0; d < inFile.length; d++) {
    const value = character.pose[first + d] ?? 0;
    if (value === inFile[d] || channelOf(character, first + d)) continue;
    changed ??= [...inFile];
    changed[d] = value;
  }
  return changed ?? inFile;
}
