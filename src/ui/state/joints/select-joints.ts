/**
 * Clicks on joints, in the viewport as in lists. A click selects one alone; with Shift or Ctrl (Cmd) it is added to the
 * selection, or removed from it. Two modes have another use for one of these keys, where the other one does it: in rig
 * mode Ctrl+click adds a child, and in IK, where a click pins, Shift+click selects a joint alone.
 */

import { findCharacter } from '../../../model/document.ts';
import { NOTHING_SELECTED, type Selection } from '../../../model/session.ts';
import { type JointPick, withJointActive, withJointToggled } from '../../../model/skeleton/joint-selection.ts';
import type { Hit } from '../../../view/picking/picking.ts';
import type { Uses } from '../workbench.ts';

/** Whether a click with these keys adds to the selection, or removes from it. */
export function addsToSelection(
  { posing }: Uses<'posing'>,
  { shiftKey, ctrlKey, metaKey }: Pick<PointerEvent, 'shiftKey' | 'ctrlKey' | 'metaKey'>,
): boolean {
  const mode = posing.mode.get();
  return (shiftKey && mode !== 'ik') || ((ctrlKey || metaKey) && mode !== 'rig');
}

/**
 * Selects what a click has hit. A click on the ground keeps the character selected, and the joints if it adds.
 * @param adds to the selection, or removes from it
 */
export function selectHit({ store }: Uses<'store'>, hit: Hit | undefined, adds: boolean): void {
  const { selection } = store;
  const { characterId } = selection;
  if (!hit) {
    if (!adds) store.select(characterId === undefined ? NOTHING_SELECTED : { characterId });
    return;
  }
  const { joint, placement } = hit;
  if (adds && joint !== undefined)
    store.select(withJointToggled(selection, { characterId: hit.characterId, placement, joint }));
  else store.select(hit);
}

/** Before a drag: a joint that is selected becomes active, with the others; another one is selected alone. */
export function activateJoint({ store }: Uses<'store'>, pick: JointPick): void {
  store.select(withJointActive(store.selection, pick));
}

/** After a drag that was cancelled: the selection that it has replaced, if that still exists. */
export function reselect({ store }: Uses<'store'>, before: Selection): void {
  const { characterId, joint } = before;
  const skeleton = findCharacter(store.document, characterId)?.skeleton;
  const isThere = joint === undefined || joint < (skeleton?.joints.length ?? 0);
  if (characterId === undefined || (findCharacter(store.document, characterId) && isThere)) store.select(before);
}
