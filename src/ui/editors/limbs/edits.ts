/** Edits of limbs and their goals, for menus and the inspector. Loaded on first use. */
import {
  addLimb,
  flattenLimbs,
  keyLimb,
  removeLimb,
  setLimbSpace,
  switchLimb,
} from '../../../edit/commands/beside/limbs.ts';
import { inTurn } from '../../../edit/in-turn.ts';
import { canOrient, hasOtherSide, proposedJoints } from '../../../edit/limbs/propose.ts';
import { limbRows } from '../../../evaluate/limbs/infos.ts';
import { GOAL_OF, POLE_OF } from '../../../evaluate/limbs/posed.ts';
import { shownTake } from '../../../model/document.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import { attempt } from '../../state/actions/attempt.ts';
import { selectedJoints } from '../../state/joints/selected-joint.ts';
import { pausePlayback } from '../../state/pause-playback.ts';
import type { Uses } from '../../state/workbench.ts';
import { type SelectedLimbs, selectedLimbs } from './selected-limbs.ts';

type Parts = Uses<'store' | 'transport' | 'timeline' | 'messages'>;

/** A limb of the selected joints, whose end takes the goal's rotation if it can, and the one of the other side. */
export function make(wb: Parts): void {
  const selected = selectedJoints(wb);
  if (!selected) return;
  const { character, skeleton } = selected;
  const { id: characterId } = character;
  const joints = proposedJoints(skeleton, selected.joints);
  if (!joints) {
    wb.messages.note('A limb is a chain, such as thigh, shin and foot: select its joints, or the last of three.');
    return;
  }
  const mirrored = hasOtherSide(skeleton, joints, character.limbs?.list ?? []);
  attempt(wb.messages, () =>
    wb.store.apply(addLimb, { characterId, joints, orient: canOrient(skeleton, joints), mirrored }),
  );
}

/** Switches the limbs of the selected joints: to FK if the first is in IK now, else to IK. */
export function switchLimbs(wb: Parts): void {
  const selected = selectedLimbs(wb);
  if (!selected) return;
  pausePlayback(wb);
  const { timeSeconds } = wb.transport.get();
  const [{ index: first }] = selected.limbs;
  const to = (limbRows(selected.character, timeSeconds)[first].blend ?? 0) >= 0.5 ? 'fk' : 'ik';
  attempt(wb.messages, () => {
    const each = selected.limbs.map(({ index }) => ({ ...of(wb, selected), limb: index, to }) as const);
    wb.store.apply(inTurn(switchLimb, `Switch ${namesOf(selected)} to ${to.toUpperCase()}`), each);
  });
}

/** Keys the goals of the selected joints' limbs as they are. */
export function keyGoals(wb: Parts): void {
  const selected = selectedLimbs(wb);
  if (!selected) return;
  pausePlayback(wb);
  attempt(wb.messages, () => {
    const each = selected.limbs.map(({ index }) => ({ ...of(wb, selected), limb: index }));
    wb.store.apply(inTurn(keyLimb, `Key goal of ${namesOf(selected)}`), each);
  });
}

/**
 * Puts the goal of the first of the selected joints' limbs into another space without moving it: from now on if it has
 * keys, else for the whole take.
 */
export function putInSpace(wb: Parts, space: string): void {
  const selected = selectedLimbs(wb);
  if (!selected) return;
  pausePlayback(wb);
  const [{ index, limb }] = selected.limbs;
  const goal = shownTake(selected.character)?.goals?.list.find((one) => one.limb === limb.name);
  const names = [...GOAL_OF, ...POLE_OF];
  const isKeyed = goal !== undefined && names.some((name) => typeof (goal.channels[name]?.curve ?? 0) !== 'number');
  const command = isKeyed ? keyLimb : setLimbSpace;
  attempt(wb.messages, () => wb.store.apply(command, { ...of(wb, selected), limb: index, space }));
}

/** Removes the limbs of the selected joints. */
export function remove(wb: Parts): void {
  const selected = selectedLimbs(wb);
  if (!selected) return;
  const { id: characterId } = selected.character;
  // From the last, so that the others keep their places.
  const each = selected.limbs.map(({ index }) => ({ characterId, limb: index })).reverse();
  attempt(wb.messages, () => wb.store.apply(inTurn(removeLimb, `Remove ${namesOf(selected)}`), each));
}

/** Replaces the goals of the shown take by keys. */
export function flatten(wb: Parts): void {
  const character = currentCharacter(wb);
  if (character) attempt(wb.messages, () => wb.store.apply(flattenLimbs, { characterId: character.id }));
}

function of({ transport }: Parts, { character }: SelectedLimbs) {
  const { timeSeconds, range } = transport.get();
  return { characterId: character.id, timeSeconds, playedRange: range };
}

function namesOf({ limbs }: SelectedLimbs): string {
  return limbs.length === 1 ? limbs[0].limb.name : `${limbs.length} limbs`;
}
