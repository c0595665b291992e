/**
 * Names in the labels of undo steps: `Rotate head (rx)`, `Delete 4 keys on hip`. A step says what it did to what.
 */

import { type Character, type Document, shownTake } from '../model/document.ts';
import type { ChannelKeys } from '../model/session.ts';
import { type CharacterDof, characterDofs } from '../model/skeleton/dofs.ts';
import { jointName } from '../model/skeleton/joint-name.ts';
import type { Skeleton } from '../model/skeleton/skeleton.ts';
import { requireCharacter } from './characters.ts';
import { cutName, SHORT_NAME } from './cut-name.ts';
import { countKeys } from './keys/selection.ts';

/** Characters of a whole label, at most. */
export const LABEL_LENGTH = 60;
/** The character's name. */
export function characterIn(document: Document, characterId: string, length?: number): string {
  return cutName(requireCharacter(document, characterId).name, length);
}

/** A joint's name; handles missing joints. */
export function jointIn({ skeleton }: { readonly skeleton?: Skeleton }, joint: number, length?: number): string {
  return cutName(jointName(skeleton, joint), length);
}

/** `rx of hip`, `morph smile`; handles missing DOFs. */
export function dofIn(character: Character, index: number, length?: number): string {
  const dof = characterDofs(character.skeleton, character.morphs)[index];
  if (!dof) return `DOF ${index}`;
  if (dof.joint < 0) return `morph ${cutName(dof.name, length)}`;
  return `${dof.name} of ${jointIn(character, dof.joint, length)}`;
}

/** `rx of hip`, `hip` if all are of that joint, `3 joints`, `2 morphs`, `5 DOFs`. */
export function dofsIn(character: Character, dofs: readonly number[], length?: number): string {
  const [first] = dofs;
  if (dofs.length === 1) return dofIn(character, first, length);
  const joints = jointsOf(character, dofs);
  if (joints === undefined) return `${dofs.length} DOFs`;
  if (joints.size > 1) return `${joints.size} joints`;
  const [joint] = joints;
  return joint < 0 ? `${dofs.length} morphs` : jointIn(character, joint, length);
}

/** The joints of these DOFs, -1 for morphs; undefined if there are joints and morphs, no DOFs, or missing ones. */
function jointsOf(character: Character, dofs: readonly number[]): ReadonlySet<number> | undefined {
  const all: readonly (CharacterDof | undefined)[] = characterDofs(character.skeleton, character.morphs);
  const joints = new Set<number>();
  for (const dof of dofs) {
    const joint = all[dof]?.joint;
    if (joint === undefined) return undefined;
    joints.add(joint);
  }
  return joints.size === 0 || (joints.has(-1) && joints.size > 1) ? undefined : joints;
}

const VERBS = { angle: 'Rotate', length: 'Move', factor: 'Pose', weight: 'Set' } as const;

/** `Rotate head`, `Rotate head (rx)` if it has other DOFs too, `Move hips`, `Pose 3 joints`, `Set morph smile`. */
export function poseLabel(character: Character, dofs: readonly number[]): string {
  const all: readonly (CharacterDof | undefined)[] = characterDofs(character.skeleton, character.morphs);
  const joints = jointsOf(character, dofs);
  const units = new Set(dofs.map((dof) => all[dof]?.unit ?? 'factor'));
  const [unit = 'factor'] = units;
  const verb = units.size === 1 ? VERBS[unit] : 'Pose';
  const [first] = dofs;
  const dof = all[first];
  if (!joints || !dof || dof.joint < 0 || joints.size > 1) return `${verb} ${dofsIn(character, dofs)}`;
  const name = jointIn(character, dof.joint);
  const isOnly = dofs.length > 1 || all.filter((other) => other?.joint === dof.joint).length === 1;
  return isOnly ? `${verb} ${name}` : `${verb} ${name} (${dof.name})`;
}

/** `rx of hip`, `3 curves`: channels of the shown take. */
export function curvesIn(document: Document, characterId: string, channels: readonly number[]): string {
  if (channels.length !== 1) return `${channels.length} curves`;
  return dofIn(requireCharacter(document, characterId), channels[0], SHORT_NAME);
}

/** `key on rx of hip`, `4 keys on hip`, `12 keys`: keys of the shown take. */
export function keysIn(document: Document, characterId: string, keys: readonly ChannelKeys[]): string {
  const character = requireCharacter(document, characterId);
  const count = countKeys(shownTake(character)?.channels ?? [], keys);
  const text = count === 1 ? 'key' : `${count} keys`;
  const channels = keys.filter(({ indices }) => indices.length > 0).map(({ channel }) => channel);
  const joints = jointsOf(character, channels);
  return joints?.size === 1 ? `${text} on ${dofsIn(character, channels, SHORT_NAME)}` : text;
}
