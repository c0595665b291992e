/** What every command of rigging does: find the joint, change the skeleton, bind skins anew where they are to stay. */
import { type Character, type Document, findCharacter } from '../../model/document.ts';
import { jointName } from '../../model/joint-name.ts';
import type { Joint, Skeleton } from '../../model/skeleton.ts';
import { finiteNumber, indexIn, oneOf } from '../arguments.ts';
import { changeCharacter, requireCharacter } from '../characters.ts';
import type { Edit } from '../store.ts';
import { withSkinsStaying } from './bind.ts';
import { changedJoints, type JointMap } from './joint-map.ts';
import { withSkeletonChanged } from './remap.ts';
import { type Rigging, SKIN_MODES } from './rigging.ts';
import { requireSkeleton } from './shown.ts';

/** The character, its skeleton and one of its joints, as a command is told of them. */
export interface Found {
  readonly character: Character;
  readonly skeleton: Skeleton;
  readonly joint: Joint;
}

/** Throws a `CommandError` where one of them is not there. */
export function findJoint(document: Document, characterId: string, index: number, what = 'joint'): Found {
  const character = requireCharacter(document, characterId);
  const skeleton = requireSkeleton(character);
  indexIn(index, 0, skeleton.joints.length, what);
  return { character, skeleton, joint: skeleton.joints[index] };
}

/** Seconds of the transport at which the pose is that shown. */
export function secondsOf({ timeSeconds = 0 }: Rigging): number {
  return finiteNumber(timeSeconds, '"timeSeconds"');
}

/**
 * A character's skeleton changed, with all that goes by it, as a command gives it.
 * @param selected index of the joint after it that is selected; undefined: what was
 * @param then what else is done to the document before skins are bound, joints keeping their indices
 */
export function rigged(
  document: Document,
  rigging: Rigging,
  map: JointMap,
  selected: number | undefined,
  then: (document: Document) => Document = (d) => d,
): Edit {
  const { characterId, skin = 'follows' } = rigging;
  const timeSeconds = secondsOf(rigging);
  const before = requireCharacter(document, characterId);
  const stays = oneOf(skin, SKIN_MODES, '"skin"') === 'stays';
  let next = then(withSkeletonChanged(document, characterId, map));
  if (stays) next = changeCharacter(next, characterId, (after) => withSkinsStaying(before, after, map, timeSeconds));
  return { document: next, keys: [], ...(selected !== undefined && { selected: { characterId, joint: selected } }) };
}

/**
 * What changes where joints stand, but neither which there are nor their DOFs, with skins bound anew if they are to stay.
 * @param next the very document where nothing changed
 */
export function boundAnew(document: Document, rigging: Rigging, next: Document): Document {
  const { characterId, skin = 'follows' } = rigging;
  const timeSeconds = secondsOf(rigging);
  if (oneOf(skin, SKIN_MODES, '"skin"') === 'follows' || next === document) return next;
  const before = requireCharacter(document, characterId);
  return changeCharacter(next, characterId, (after) => {
    const map = changedJoints(requireSkeleton(before), requireSkeleton(after).joints);
    return withSkinsStaying(before, after, map, timeSeconds);
  });
}

/** One joint changed and nothing else. */
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

/** What a joint is called in a label or a sentence, whether it is there or not. */
export function calledIn(document: Document, characterId: string, joint: number): string {
  return called(findCharacter(document, characterId)?.skeleton, joint);
}

export function called(skeleton: Skeleton | undefined, joint: number): string {
  return jointName(skeleton, joint);
}
