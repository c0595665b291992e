/** The poses that are saved: those of a library, and the pose written to a skeleton's file. */
import { poseByNames } from '../../edit/pose/by-names.ts';
import { channelOf } from '../../evaluate/pose.ts';
import type { Character } from '../../model/document.ts';
import type { PoseByNames } from '../../model/pose-by-names.ts';
import type { PoseLibrary } from '../../model/poses.ts';
import { jointDofCount, rootDofCount } from '../../model/skeleton/dofs.ts';

/** The poses of a library as its file stores them. */
export function posesByNames(library: PoseLibrary): readonly PoseByNames[] {
  return library.poses.map((pose) => poseByNames(library, pose));
}

/** The pose of the joints as set: one value per DOF, without root translation and morphs. */
export function jointPose({ pose, skeleton }: Character): readonly number[] {
  return pose.slice(rootDofCount(skeleton), rootDofCount(skeleton) + jointDofCount(skeleton));
}

/**
 * The pose that saving writes: as set, but DOFs driven by the shown take keep the file's values. There one sees the
 * take, and a pose hidden under keys should not end up in the skeleton.
 *
 * @param inFile one value per DOF of the joints
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
