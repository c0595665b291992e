/** Edits of a skeleton from menus, keys and the tree: commands with the page's state filled in. */

import { type Change, documentIn } from '../../../edit/change.ts';
import type { ArgsOf } from '../../../edit/command.ts';
import { CommandError } from '../../../edit/command-error.ts';
import { addJoint, createRig, mirrorJoint, removeJoint, reparentJoint } from '../../../edit/commands/rig.ts';
import { keysLostBy, renameJoint, setFilePose, setMotion, setOffset } from '../../../edit/commands/rig-joint.ts';
import { inTurn } from '../../../edit/in-turn.ts';
import { snappedPoint } from '../../../edit/rig/dragged-places.ts';
import { boxOf } from '../../../evaluate/skin/bounds.ts';
import { roundStep } from '../../../math/round-steps.ts';
import type { Vec3 } from '../../../math/vec3.ts';
import { type Character, type Document, findCharacter, shownSkin } from '../../../model/document.ts';
import type { AxisLetter } from '../../../model/skeleton/dof-axis.ts';
import { isSameType, type MotionKind, motionOfKind } from '../../../model/skeleton/joint-types.ts';
import type { Motion, Skeleton } from '../../../model/skeleton/skeleton.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import { attempt } from '../../state/actions/attempt.ts';
import { NO_JOINT } from '../../state/actions/needs.ts';
import { jointsText, selectedJointsOf } from '../../state/joints/selected-joint.ts';
import { pausePlayback } from '../../state/pause-playback.ts';
import type { Uses, Workbench } from '../../state/workbench.ts';
import { type ClickedAt, placeForRoot } from './clicked-places.ts';
import { nameNote } from './joint-names.ts';
import { outermostJoints } from './outermost.ts';
import { riggedNow, scenePivot } from './rigged.ts';
import { rigging } from './rigging-args.ts';

/** Position of the first joint of a new skeleton: hip height. */
const FIRST: Vec3 = [0, 1, 0];
/** Front view, so that clicks are in one plane; with room for a person's height. */
const FIRST_VIEW = { azimuth: 0, polar: Math.PI / 2, distance: 5 } as const;

/**
 * Creates a skeleton of one joint in the middle of the view, ready for clicking further ones; for a skin without a
 * skeleton, as its own.
 */
export function newSkeleton(wb: Workbench): void {
  const waiting = waitingCharacter(wb);
  start(wb, waiting ? middleOf(waiting) : FIRST);
  wb.posing.mode.set('rig');
  wb.posing.rig.adding.set(true);
  const rigged = riggedNow(wb);
  if (waiting) wb.viewport.camera.reveal(waiting.id);
  // At once: a click during an animated move would place a joint by the wrong view.
  else if (rigged) wb.viewport.camera.view = { ...FIRST_VIEW, target: scenePivot(rigged, 0) };
}

/** Centre of its skin, rounded. */
function middleOf(waiting: Character): Vec3 {
  const skin = shownSkin(waiting);
  const box = new Float64Array(6);
  if (!skin || skin.positions.length === 0) return FIRST;
  boxOf(skin.positions, box);
  const step = roundStep(Math.max(box[3] - box[0], box[4] - box[1], box[5] - box[2]) / 100);
  return snappedPoint([(box[0] + box[3]) / 2, (box[1] + box[4]) / 2, (box[2] + box[5]) / 2], step);
}

/** The same where a click is, while joints are being added and there is no skeleton yet. */
export function startSkeletonAt(wb: Workbench, at: ClickedAt): void {
  const place = placeForRoot(wb, waitingCharacter(wb), at);
  if (place) start(wb, place);
  else wb.messages.note('The character is scaled to zero, so nothing can be placed in it.', 'warning');
}

/** A skin without a skeleton, which gets the first joint. */
function waitingCharacter(wb: Uses<'store'>): Character | undefined {
  const character = currentCharacter(wb);
  return character && !character.skeleton && character.skins.length > 0 ? character : undefined;
}

function start(wb: Uses<'store' | 'transport' | 'timeline' | 'posing' | 'settings' | 'messages'>, offset: Vec3): void {
  pausePlayback(wb);
  const waiting = waitingCharacter(wb);
  attempt(wb.messages, () => {
    const { document } = wb.store;
    const args = waiting ? { characterId: waiting.id, skin: wb.posing.rigSkin.get() } : {};
    const created = createRig.run(document, args);
    const id = selectedIn(created, document);
    const character = findCharacter(documentIn(created), id);
    if (!character) return;
    const placing = { ...rigging(wb, character), joint: 0, offset, children: 'follow' } as const;
    const placed = setOffset.run(documentIn(created), placing);
    const selected = { characterId: character.id, joint: 0 };
    const step = wb.store.begin(createRig.label(document, args));
    step.preview({ document: documentIn(placed), keys: [], selected });
    step.commit();
    wb.store.select(selected);
  });
}

/** The id of the character that a command created or changed. */
function selectedIn(change: Document | Change, before: Document): string | undefined {
  const said = 'document' in change ? change.selected?.characterId : undefined;
  return said ?? documentIn(change).characters.find((c) => !findCharacter(before, c.id))?.id;
}

/** Runs with the current character and its selected joints, the active one last; reports if there are none. */
function withJoints(
  wb: Uses<'store' | 'transport' | 'timeline' | 'settings' | 'messages'>,
  run: (character: Character, skeleton: Skeleton, joints: readonly number[]) => void,
): void {
  const character = currentCharacter(wb);
  const joints = character ? selectedJointsOf(wb, character.id) : [];
  if (!character?.skeleton || joints.length === 0) {
    wb.messages.note(NO_JOINT);
    return;
  }
  const { skeleton } = character;
  pausePlayback(wb);
  attempt(wb.messages, () => run(character, skeleton, joints));
}

/** Adds and selects a child of the active joint that continues the bone. */
export function addChild(wb: Uses<'store' | 'transport' | 'timeline' | 'posing' | 'settings' | 'messages'>): void {
  withJoints(wb, (character, _skeleton, joints) => {
    const parent = joints[joints.length - 1];
    wb.store.apply(addJoint, { ...rigging(wb, character), parent });
  });
}

/** Deletes the selected joints. The parent of the first one is selected then, as after deleting one. */
export function removeSelected(
  wb: Uses<'store' | 'transport' | 'timeline' | 'posing' | 'settings' | 'messages'>,
  children: 'too' | 'stay',
): void {
  withJoints(wb, (character, skeleton, joints) => {
    const shared = { ...rigging(wb, character), children };
    if (joints.length === 1) return wb.store.apply(removeJoint, { ...shared, joint: joints[0] });
    const meant = children === 'too' ? outermostJoints(skeleton, joints) : joints;
    // From the last one, so that the indices of those before stay valid.
    const each = [...meant].sort((a, b) => b - a).map((joint) => ({ ...shared, joint }));
    const text = `Delete ${jointsText(skeleton, joints)}`;
    const { parent } = skeleton.joints[Math.min(...meant)];
    wb.store.apply(inTurn(removeJoint, children === 'too' ? `${text} and descendants` : text), each);
    wb.store.select({ characterId: character.id, ...(parent >= 0 && { joint: parent }) });
  });
}

/** Mirrors the hierarchies of the selected joints. */
export function mirrorSelected(
  wb: Uses<'store' | 'transport' | 'timeline' | 'posing' | 'settings' | 'messages'>,
  across: AxisLetter,
): void {
  withJoints(wb, (character, skeleton, joints) => {
    const before = wb.store.document;
    if (outermostJoints(skeleton, joints).length > 1) {
      throw new CommandError('Mirroring adds and renumbers joints. Select the joints of one hierarchy.');
    }
    const [joint] = outermostJoints(skeleton, joints);
    wb.store.apply(mirrorJoint, { ...rigging(wb, character), joint, across });
    if (wb.store.document === before) wb.messages.note('Both sides already match.');
  });
}

export function moveUnder(
  wb: Uses<'store' | 'transport' | 'timeline' | 'posing' | 'settings' | 'messages'>,
  characterId: string,
  place: Pick<ArgsOf<typeof reparentJoint>, 'joint' | 'parent' | 'before'>,
): void {
  pausePlayback(wb);
  attempt(wb.messages, () => wb.store.apply(reparentJoint, { ...rigging(wb, { id: characterId }), ...place }));
}

export function renameIt(
  wb: Uses<'store' | 'transport' | 'posing' | 'messages'>,
  characterId: string,
  joint: number,
  name: string,
): void {
  attempt(wb.messages, () => {
    wb.store.apply(renameJoint, { ...rigging(wb, { id: characterId }), joint, name });
    const character = findCharacter(wb.store.document, characterId);
    const note = character && nameNote(character, joint);
    if (note) wb.messages.note(`${name}: ${note}`);
  });
}

/** Gives the selected joints another type, with that type's initial parameters; reports lost keys. */
export function setType(
  wb: Uses<'store' | 'transport' | 'timeline' | 'posing' | 'settings' | 'messages'>,
  kind: MotionKind,
): void {
  withJoints(wb, (character, skeleton, joints) => {
    const others = joints.filter((joint) => !isSameType(skeleton.joints[joint].motion, { kind }));
    const each = others.map((joint) => ({ joint, motion: motionOfKind(kind, skeleton.joints[joint].motion) }));
    changeMotions(wb, character, each);
  });
}

/** Types or parameters of joints, in one undo step; reports lost keys. */
export function changeMotions(
  wb: Uses<'store' | 'transport' | 'posing' | 'messages'>,
  { id, skeleton }: Pick<Character, 'id' | 'skeleton'>,
  motions: readonly { readonly joint: number; readonly motion: Motion }[],
): void {
  const shared = rigging(wb, { id });
  const each = motions.map((one) => ({ ...shared, ...one }));
  const lost = each.flatMap((args) => keysLostBy(wb.store.document, args) ?? []);
  const joints = motions.map(({ joint }) => joint);
  wb.store.apply(inTurn(setMotion, `Set type of ${jointsText(skeleton, joints)}`), each);
  const what = joints.length === 1 ? 'type of the joint' : 'types';
  if (lost.length) wb.messages.note(`Changing the ${what} removed ${lost.join(', ')}. Undo restores them.`);
}

/** @param joint absent: all of them */
export function takeFilePose(
  wb: Uses<'store' | 'transport' | 'timeline' | 'posing' | 'settings' | 'messages'>,
  from: ArgsOf<typeof setFilePose>['from'],
  joint?: number,
): void {
  const character = currentCharacter(wb);
  if (!character?.skeleton) return;
  pausePlayback(wb);
  attempt(wb.messages, () => wb.store.apply(setFilePose, { ...rigging(wb, character), joint, from }));
}
