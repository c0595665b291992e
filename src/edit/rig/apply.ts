/** Steps that all rigging commands share: find the joint, change the skeleton, and rebind skins that are to stay. */
import { type Character, type Document, findCharacter } from '../../model/document.ts';
import type { Joint, Skeleton } from '../../model/skeleton/skeleton.ts';
import { indexIn } from '../arguments.ts';
import type { Edit } from '../change.ts';
import { changeCharacter, requireCharacter } from '../characters.ts';
import { jointIn } from '../step-names.ts';
import { withSkinsStaying } from './bind.ts';
import { changedJoints, type JointMap } from './joint-map.ts';
import { withSkeletonChanged } from './remap.ts';
import type { Rigging } from './rigging.ts';
import { requireSkeleton } from './shown.ts';

/** The character, its skeleton and one of its joints, from a command's arguments. */
export interface Found {
  readonly character: Character;
  readonly skeleton: Skeleton;
  readonly joint: Joint;
}

/** Throws a `CommandError` if one of them doesn't exist. */
export function findJoint(document: Document, characterId: string, index: number, what = 'joint'): Found {
  const character = requireCharacter(document, characterId);
  const skeleton = requireSkeleton(character);
  indexIn(index, 0, skeleton.joints.length, what);
  return { character, skeleton, joint: skeleton.joints[index] };
}

/**
 * Changes a character's skeleton with everything that depends on it, as the result of a command.
 * @param selected index of the joint to select afterwards; undefined: selection unchanged
 * @param then further changes to the document before skins are rebound; must keep joint indices
 */
export function rigged(
  document: Document,
  rigging: Rigging,
  map: JointMap,
  selected: number | undefined,
  then: (document: Document) => Document = (d) => d,
): Edit {
  const { characterId, skin = 'follows', timeSeconds = 0 } = rigging;
  const before = requireCharacter(document, characterId);
  const stays = skin === 'stays';
  let next = then(withSkeletonChanged(document, characterId, map));
  if (stays) next = changeCharacter(next, characterId, (after) => withSkinsStaying(before, after, map, timeSeconds));
  return { document: next, keys: [], ...(selected !== undefined && { selected: { characterId, joint: selected } }) };
}

/**
 * For changes that move joints, but neither add, remove nor change their DOFs; rebinds skins that are to stay.
 * @param next the same document if nothing changed
 */
export function boundAnew(document: Document, rigging: Rigging, next: Document): Document {
  const { characterId, skin = 'follows', timeSeconds = 0 } = rigging;
  if (skin === 'follows' || next === document) return next;
  const before = requireCharacter(document, characterId);
  return changeCharacter(next, characterId, (after) => {
    const map = changedJoints(requireSkeleton(before), requireSkeleton(after).joints);
    return withSkinsStaying(before, after, map, timeSeconds);
  });
}

/** Changes only one joint. */
export function withJoint(
  document: Document,
  rigging: Rigging & { readonly joint: number },
  change: (joint: Joint) => Joint,
  then?: (document: Document) => Document,
): Document | Edit {
  const { skeleton } = findJoint(document, rigging.characterId, rigging.joint);
  const joints = skeleton.joints.map((joint, j) => (j === rigging.joint ? change(joint) : joint));
  if (joints[rigging.joint] === skeleton.joints[rigging.joint]) return document;
  return rigged(document, rigging, changedJoints(skeleton, joints), rigging.joint, then);
}

/** The name of a joint for labels, whether it exists or not. */
export function calledIn(document: Document, characterId: string, joint: number, length?: number): string {
  return jointIn({ skeleton: findCharacter(document, characterId)?.skeleton }, joint, length);
}
