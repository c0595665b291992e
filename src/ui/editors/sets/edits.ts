/** Edits of selection sets and locks, for menus and keys. Loaded on first use. */
import { addSet, changeSet, removeSet, setLocked } from '../../../edit/commands/beside/sets.ts';
import type { Character } from '../../../model/document.ts';
import { lockedDofs } from '../../../model/sets.ts';
import { attempt } from '../../state/actions/attempt.ts';
import { selectedJoints } from '../../state/joints/selected-joint.ts';
import type { Uses } from '../../state/workbench.ts';

/** Colours of new sets, in turn: told apart on light and dark ground. */
const COLOURS = ['#4a90e2', '#e2574a', '#3fa66b', '#d99a2b', '#9a6ce0', '#2fa5a8', '#d3619f', '#8a8f98'];

type Parts = Uses<'store' | 'messages'>;

/** A set of the selected joints. */
export function newSet(wb: Parts): void {
  const selected = selectedJoints(wb);
  if (!selected) return;
  const { character, joints } = selected;
  const sets = character.sets?.sets ?? [];
  const names = new Set(sets.map(({ name }) => name));
  let number = sets.length + 1;
  while (names.has(`Set ${number}`)) number++;
  const color = COLOURS[sets.length % COLOURS.length];
  attempt(wb.messages, () =>
    wb.store.apply(addSet, { characterId: character.id, name: `Set ${number}`, color, joints }),
  );
}

/** Gives a set the selected joints. */
export function setJoints(wb: Parts, { id: characterId }: Character, set: number): void {
  const selected = selectedJoints(wb);
  if (selected?.character.id !== characterId) return;
  attempt(wb.messages, () => wb.store.apply(changeSet, { characterId, set, joints: selected.joints }));
}

/** Names a set; a blank name changes nothing. */
export function renameSet(wb: Parts, { id: characterId }: Character, set: number, name: string): void {
  if (name.trim() === '') return;
  attempt(wb.messages, () => wb.store.apply(changeSet, { characterId, set, name: name.trim() }));
}

/** Gives a set the colour after its own. */
export function nextColour(wb: Parts, { id: characterId, sets }: Character, set: number): void {
  const color = COLOURS[(COLOURS.indexOf(sets?.sets[set]?.color ?? '') + 1) % COLOURS.length];
  attempt(wb.messages, () => wb.store.apply(changeSet, { characterId, set, color }));
}

/** Removes a set; its joints stay. */
export function remove(wb: Parts, { id: characterId }: Character, set: number): void {
  attempt(wb.messages, () => wb.store.apply(removeSet, { characterId, set }));
}

/** Locks DOFs; unlocks them if all are locked. */
export function toggleLocked(wb: Parts, character: Character, dofs: readonly number[]): void {
  const locks = lockedDofs(character);
  const locked = !dofs.every((dof) => locks.has(dof));
  attempt(wb.messages, () => wb.store.apply(setLocked, { characterId: character.id, dofs, locked }));
}
