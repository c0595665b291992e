/** A character's pose library: unique names, and adding poses. */
import type { Character } from '../../model/document.ts';
import type { PoseByNames } from '../../model/pose-by-names.ts';
import type { NamedPose } from '../../model/poses.ts';
import { characterDofs } from '../../model/skeleton/dofs.ts';
import { poseByNames, takePose } from './by-names.ts';

/** The name itself if unused; else with the next number. */
export function freePoseName(poses: readonly NamedPose[], name: string): string {
  const taken = new Set(poses.map((pose) => pose.name));
  if (!taken.has(name)) return name;
  const stem = name.replace(/ \d+$/, '');
  for (let n = 2; ; n++) if (!taken.has(`${stem} ${n}`)) return `${stem} ${n}`;
}

/** `pose 1`, `pose 2`. */
export function nextPoseName(poses: readonly NamedPose[]): string {
  const taken = new Set(poses.map((pose) => pose.name));
  for (let n = poses.length + 1; ; n++) if (!taken.has(`pose ${n}`)) return `pose ${n}`;
}

/** The character with that library; without the property if it is empty. */
export function withPoses(character: Character, poses: readonly NamedPose[]): Character {
  const { poses: _before, ...rest } = character;
  return poses.length ? { ...rest, poses } : rest;
}

/**
 * The character with poses from a file or another character; the same object if it has all of them. DOFs missing in a
 * pose are at rest.
 */
export function addPoses(character: Character, added: readonly PoseByNames[]): Character {
  const poses = [...(character.poses ?? [])];
  const all = characterDofs(character.skeleton, character.morphs);
  for (const pose of added) {
    const taken = takePose(character, pose).values;
    const values = all.map((dof, index) => taken.get(index) ?? dof.rest);
    const isThere = poses.some(
      (p) => p.name === pose.name && values.every((v, d) => v === (p.values[d] ?? all[d].rest)),
    );
    if (!isThere) poses.push({ name: freePoseName(poses, pose.name), values });
  }
  return poses.length === (character.poses?.length ?? 0) ? character : withPoses(character, poses);
}

/**
 * Poses of a character with a new skeleton; new DOFs are at rest. The same object if nothing changes.
 * @param to for each old joint its new index; -1 if removed
 */
export function movedPoses(
  before: Pick<Character, 'skeleton' | 'morphs'>,
  after: Pick<Character, 'skeleton' | 'morphs'>,
  poses: readonly NamedPose[],
  to: ArrayLike<number>,
): readonly NamedPose[] {
  const all = characterDofs(after.skeleton, after.morphs);
  const moved = poses.map((pose) => {
    const taken = takePose(after, poseByNames(before, pose), to).values;
    const values = all.map((dof, index) => taken.get(index) ?? dof.rest);
    const isSame = values.length === pose.values.length && values.every((value, d) => value === pose.values[d]);
    return isSame ? pose : { ...pose, values };
  });
  return moved.every((pose, i) => pose === poses[i]) ? poses : moved;
}
