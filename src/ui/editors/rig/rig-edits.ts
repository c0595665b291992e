/** What menus, keys and the tree do to a skeleton: commands with all that the page knows filled in. */
import { addJoint, createRig, mirrorJoint, removeJoint, reparentJoint } from '../../../edit/commands/rig.ts';
import { renameJoint, setFilePose, setOffset } from '../../../edit/commands/rig-joint.ts';
import { inverseOf, snappedPoint, withoutDust } from '../../../edit/rig/dragged-places.ts';
import type { NamedAxis, ReparentJoint, SetFilePose } from '../../../edit/rig/rigging.ts';
import { documentIn, type Edit } from '../../../edit/store.ts';
import { boxOf } from '../../../evaluate/bounds.ts';
import { roundStep } from '../../../math/round-steps.ts';
import { transformPoint, type Vec3 } from '../../../math/vec3.ts';
import { type Character, type Document, findCharacter, shownSkin } from '../../../model/document.ts';
import { currentCharacter } from '../../state/action.ts';
import { attempt } from '../../state/attempt.ts';
import { selectedJoint } from '../../state/selected-joint.ts';
import { standStill } from '../../state/stand-still.ts';
import type { Uses, Workbench } from '../../state/workbench.ts';
import { nameNote } from './joint-names.ts';
import { riggedNow, scenePivot } from './rigged.ts';
import { rigging } from './rigging-args.ts';

/** Where the first joint of a skeleton from nothing stands: where hips are. */
const FIRST: Vec3 = [0, 1, 0];
/** Looked at from the front, so that what is clicked lies in one plane; with room for a figure of a person's height. */
const FIRST_VIEW = { azimuth: 0, polar: Math.PI / 2, distance: 5 } as const;

/**
 * A skeleton of one joint in the middle of the picture, ready for the next ones to be clicked; for a skin that waits for
 * one, its own.
 */
export function newSkeleton(wb: Workbench): void {
  const waiting = waitingCharacter(wb);
  start(wb, waiting ? middleOf(waiting) : FIRST);
  wb.posing.mode.set('rig');
  wb.posing.rig.adding.set(true);
  const rigged = riggedNow(wb);
  if (waiting) wb.viewport.reveal(waiting.id);
  // At once: a click on the way there would place a joint by a view that is gone the next moment.
  else if (rigged) wb.viewport.cameraView = { ...FIRST_VIEW, target: scenePivot(rigged, 0) };
}

/** Of its skin, to a round number. */
function middleOf(waiting: Character): Vec3 {
  const skin = shownSkin(waiting);
  const box = new Float64Array(6);
  if (!skin || skin.positions.length === 0) return FIRST;
  boxOf(skin.positions, box);
  const step = roundStep(Math.max(box[3] - box[0], box[4] - box[1], box[5] - box[2]) / 100);
  return snappedPoint([(box[0] + box[3]) / 2, (box[1] + box[4]) / 2, (box[2] + box[5]) / 2], step);
}

/** A press or a click: where it was on the page, and whether numbers are to be round. */
type At = Pick<PointerEvent, 'clientX' | 'clientY' | 'ctrlKey' | 'metaKey'>;

/** The same where the pointer is, while joints are added and there is nothing to add them to. */
export function startSkeletonAt(wb: Workbench, at: At): void {
  const { eye } = wb.viewport;
  const scene = eye.inPlaneOf([0, 0, 0], at.clientX, at.clientY);
  const unit = eye.unitsPerPixel(scene);
  const waiting = waitingCharacter(wb);
  const placement = waiting && wb.viewport.placementOf(waiting.id, wb.viewport.pickedCopy(waiting));
  const inverse = placement && inverseOf(placement);
  const own = inverse ? transformPoint(inverse, scene) : scene;
  start(wb, at.ctrlKey || at.metaKey ? snappedPoint(own, roundStep(8 * unit)) : withoutDust(own, unit));
}

/** A skin without a skeleton: the first joint is its. */
function waitingCharacter(wb: Uses<'store'>): Character | undefined {
  const character = currentCharacter(wb);
  return character && !character.skeleton && character.skins.length > 0 ? character : undefined;
}

function start(wb: Uses<'store' | 'transport' | 'timeline' | 'posing' | 'settings' | 'messages'>, offset: Vec3): void {
  standStill(wb);
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

/** The id of the character that a command made or changed. */
function selectedIn(change: Document | Edit, before: Document): string | undefined {
  const said = 'document' in change ? change.selected?.characterId : undefined;
  return said ?? documentIn(change).characters.find((c) => !findCharacter(before, c.id))?.id;
}

/** The current character with the joint that is meant; says so where there is none. */
function withJoint(
  wb: Uses<'store' | 'transport' | 'timeline' | 'settings' | 'messages'>,
  joint: number | undefined,
  run: (character: Character, joint: number) => void,
): void {
  const character = currentCharacter(wb);
  const meant = joint ?? selectedJoint(wb)?.joint;
  if (!character?.skeleton || meant === undefined) {
    wb.messages.note('Select a joint first.');
    return;
  }
  standStill(wb);
  attempt(wb.messages, () => run(character, meant));
}

/** A child that continues the bone; it is selected. */
export function addChild(
  wb: Uses<'store' | 'transport' | 'timeline' | 'posing' | 'settings' | 'messages'>,
  joint?: number,
): void {
  withJoint(wb, joint, (character, parent) => wb.store.apply(addJoint, { ...rigging(wb, character), parent }));
}

export function removeIt(
  wb: Uses<'store' | 'transport' | 'timeline' | 'posing' | 'settings' | 'messages'>,
  children: 'too' | 'stay',
  joint?: number,
): void {
  withJoint(wb, joint, (character, meant) =>
    wb.store.apply(removeJoint, { ...rigging(wb, character), joint: meant, children }),
  );
}

export function mirrorIt(
  wb: Uses<'store' | 'transport' | 'timeline' | 'posing' | 'settings' | 'messages'>,
  across: NamedAxis,
  joint?: number,
): void {
  withJoint(wb, joint, (character, meant) => {
    const before = wb.store.document;
    wb.store.apply(mirrorJoint, { ...rigging(wb, character), joint: meant, across });
    if (wb.store.document === before) wb.messages.note('Both sides already match.');
  });
}

export function moveUnder(
  wb: Uses<'store' | 'transport' | 'timeline' | 'posing' | 'settings' | 'messages'>,
  characterId: string,
  place: Pick<ReparentJoint, 'joint' | 'parent' | 'before'>,
): void {
  standStill(wb);
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

/** @param joint all of them where none is named */
export function takeFilePose(
  wb: Uses<'store' | 'transport' | 'timeline' | 'posing' | 'settings' | 'messages'>,
  from: SetFilePose['from'],
  joint?: number,
): void {
  const character = currentCharacter(wb);
  if (!character?.skeleton) return;
  standStill(wb);
  attempt(wb.messages, () => wb.store.apply(setFilePose, { ...rigging(wb, character), joint, from }));
}
