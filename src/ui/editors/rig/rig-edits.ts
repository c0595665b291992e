/** Edits of a skeleton from menus, keys and the tree: commands with the page's state filled in. */
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
import { pausePlayback } from '../../state/pause-playback.ts';
import { selectedJoint } from '../../state/selected-joint.ts';
import type { Uses, Workbench } from '../../state/workbench.ts';
import { nameNote } from './joint-names.ts';
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
  if (waiting) wb.viewport.reveal(waiting.id);
  // At once: a click during an animated move would place a joint by the wrong view.
  else if (rigged) wb.viewport.cameraView = { ...FIRST_VIEW, target: scenePivot(rigged, 0) };
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

/** Page position of a press or click, and modifiers for rounding. */
type At = Pick<PointerEvent, 'clientX' | 'clientY' | 'ctrlKey' | 'metaKey'>;

/** The same at the pointer, while joints are being added and there is no skeleton yet. */
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
function selectedIn(change: Document | Edit, before: Document): string | undefined {
  const said = 'document' in change ? change.selected?.characterId : undefined;
  return said ?? documentIn(change).characters.find((c) => !findCharacter(before, c.id))?.id;
}

/** Runs with the current character and joint; reports if there is none. */
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
  pausePlayback(wb);
  attempt(wb.messages, () => run(character, meant));
}

/** Adds and selects a child that continues the bone. */
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

/** @param joint absent: all of them */
export function takeFilePose(
  wb: Uses<'store' | 'transport' | 'timeline' | 'posing' | 'settings' | 'messages'>,
  from: SetFilePose['from'],
  joint?: number,
): void {
  const character = currentCharacter(wb);
  if (!character?.skeleton) return;
  pausePlayback(wb);
  attempt(wb.messages, () => wb.store.apply(setFilePose, { ...rigging(wb, character), joint, from }));
}
