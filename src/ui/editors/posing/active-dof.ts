/**
 * The active DOF of the selected joint: the one changed by dragging its bone, and by keys. Chosen by its handle, button
 * or slider; on another joint, the DOF of the same name is active.
 */
import { matchingDofs, sameChange } from '../../../edit/pose/same-change.ts';
import { dofCountOf, poseAt } from '../../../evaluate/pose.ts';
import type { Character } from '../../../model/document.ts';
import { coupleOf } from '../../../model/skeleton/couples.ts';
import { type CharacterDof, characterDofs, firstDofs } from '../../../model/skeleton/dofs.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import { quaternionDofs } from '../../../model/skeleton/joint-types.ts';
import { lengthStep } from '../../../model/skeleton/reach.ts';
import type { Skeleton } from '../../../model/skeleton/skeleton.ts';
import { addKeyed } from '../../state/add-keys.ts';
import { dofValueText, limitNote } from '../../state/joints/dof-text.ts';
import { type ResolvedJoint, selectedJoint, selectedJoints } from '../../state/joints/selected-joint.ts';
import { pausePlayback } from '../../state/pause-playback.ts';
import type { Uses } from '../../state/workbench.ts';
import { autoKey, jointDofs, posingCommand } from './pose-edits.ts';

/** Radians: change per key press, and the step that Ctrl snaps to. */
const KEY_ANGLE = Math.PI / 180;
export const SNAP_ANGLE = Math.PI / 36;

/** All DOFs of a joint, as indices into the character's; for the root including the root translation. */
export function dofsOfJoint({ character, joint }: ResolvedJoint): readonly number[] {
  return jointDofs(character, joint);
}

/** Those that can be edited one by one: no linked DOFs, no quaternion components. */
export function dofsByHand(selected: ResolvedJoint): readonly number[] {
  const { skeleton, joint } = selected;
  const first = firstDofs(skeleton)[joint];
  const parts = quaternionDofs(skeleton.joints[joint].motion).map((d) => first + d);
  return dofsOfJoint(selected).filter((dof) => !coupleOf(skeleton, dof) && !parts.includes(dof));
}

/** Whether a DOF can't change: limits are enforced, and both are the same. */
export function isLockedDof({ character, skeleton }: ResolvedJoint, dof: number): boolean {
  const { limit } = characterDofs(skeleton, [])[dof];
  return character.clampsToLimits && limit.min === limit.max;
}

/** Those of `dofsByHand` that can change. */
export function freeDofs(selected: ResolvedJoint): readonly number[] {
  return dofsByHand(selected).filter((dof) => !isLockedDof(selected, dof));
}

/** Undefined if the selected joint has none. */
export function activeDof(wb: Uses<'store' | 'posing'>): number | undefined {
  const selected = selectedJoint(wb);
  if (!selected) return undefined;
  const dofs = freeDofs(selected);
  const own = characterDofs(selected.skeleton, []);
  const chosen = wb.posing.chosenDof.get();
  if (chosen?.characterId === selected.character.id && dofs.includes(chosen.dof)) return chosen.dof;
  const sameName = dofs.find((dof) => own[dof].name === chosen?.name);
  // For a root, prefer rotation.
  return sameName ?? dofs.find((dof) => own[dof].unit === 'angle') ?? dofs[0];
}

export function chooseDof(wb: Uses<'store' | 'posing'>, dof: number): void {
  const selected = selectedJoint(wb);
  if (!selected || !freeDofs(selected).includes(dof)) return;
  const { name } = characterDofs(selected.skeleton, [])[dof];
  wb.posing.chosenDof.set({ characterId: selected.character.id, dof, name });
}

/** The next or previous one, cyclically. */
export function chooseNextDof(wb: Uses<'store' | 'posing'>, way: 1 | -1): void {
  const selected = selectedJoint(wb);
  const now = activeDof(wb);
  if (!selected || now === undefined) return;
  const dofs = freeDofs(selected);
  chooseDof(wb, dofs[(dofs.indexOf(now) + way + dofs.length) % dofs.length]);
}

/** A character's DOFs at the current time. */
export function shownDofs(wb: Uses<'transport'>, character: Character): Float64Array {
  const dofs = new Float64Array(dofCountOf(character));
  poseAt(character, wb.transport.get().timeSeconds, dofs);
  return dofs;
}

/**
 * Rotates the active DOF by a degree, or moves it by a small step; with it that of the other selected joints. Says the
 * value, which no other part of the page may show.
 */
export function nudgeDof(
  wb: Uses<'store' | 'transport' | 'timeline' | 'posing' | 'settings' | 'messages'>,
  way: 1 | -1,
): void {
  const index = activeDof(wb);
  const selected = selectedJoint(wb);
  if (!selected || index === undefined) return;
  pausePlayback(wb);
  const { character, skeleton } = selected;
  const step = nudgeOf(characterDofs(skeleton, [])[index], skeleton);
  const shown = shownDofs(wb, character);
  const own = { index, value: shown[index] + way * step };
  const matching = matchingDofs(skeleton, selectedJoints(wb)?.joints ?? [], index);
  const dofs = [own, ...sameChange(shown, own, matching)];
  const { timeSeconds } = wb.transport.get();
  addKeyed(wb, posingCommand(wb), { characterId: character.id, dofs, timeSeconds, key: autoKey(wb) });
  // Also where nothing has changed, at a limit.
  wb.messages.note(activeDofText(wb));
}

/** `forearm_l rx 42.5°`, and the limit that it is at. */
function activeDofText(wb: Uses<'store' | 'transport' | 'posing' | 'settings'>): string {
  const index = activeDof(wb);
  const selected = selectedJoint(wb);
  if (!selected || index === undefined) return '';
  const { character, skeleton, joint } = selected;
  const { angles } = wb.settings.get();
  const dof = characterDofs(skeleton, [])[index];
  const value = shownDofs(wb, character)[index];
  const held = character.clampsToLimits ? [dof.limit.min, dof.limit.max].find((limit) => limit === value) : undefined;
  const told = `${jointName(skeleton, joint)} ${dofValueText(dof, value, character, angles)}`;
  return held === undefined ? told : `${told}, ${limitNote(dof, held, true, character, angles)}`;
}

function nudgeOf({ unit }: CharacterDof, skeleton: Skeleton): number {
  if (unit === 'angle') return KEY_ANGLE;
  return unit === 'length' ? lengthStep(skeleton) : 0.01;
}

/** Step of snapping with Ctrl. */
export function snapStep({ unit }: CharacterDof, skeleton: Skeleton): number {
  if (unit === 'angle') return SNAP_ANGLE;
  return unit === 'length' ? lengthStep(skeleton) : 0.1;
}
