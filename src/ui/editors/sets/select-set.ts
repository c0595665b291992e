/** Selecting the joints of a set: by button, by key, or by a script with the arguments of `sets.select`. */
import { CommandError } from '../../../edit/command-error.ts';
import { boolean, index, optional, record } from '../../../edit/schema/shape.ts';
import type { Character } from '../../../model/document.ts';
import { withJoints, withPart } from '../../../model/skeleton/joint-selection.ts';
import { jointsIn } from '../../../model/skeleton/selected-joints.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import type { Uses } from '../../state/workbench.ts';

const ARGS = record({
  /** Index in the list. */
  set: index,
  /** To what is selected; default false. */
  add: optional(boolean),
});

/** Whether exactly the joints of a set are selected. */
export function isSetSelected({ store }: Uses<'store'>, { id, sets }: Character, at: number): boolean {
  const joints = sets?.sets[at]?.joints ?? [];
  const selected = store.selection.characterId === id ? jointsIn(store.selection) : [];
  return joints.length > 0 && joints.length === selected.length && joints.every((joint) => selected.includes(joint));
}

/**
 * Selects the joints of a set of the current character.
 * @param add to those selected, of other characters, too; a set that is selected already is taken out of them
 */
export function selectSet({ store }: Uses<'store'>, character: Character, at: number, add = false): void {
  const { id, sets } = character;
  const joints = sets?.sets[at]?.joints ?? [];
  const { selection } = store;
  const before = add && selection.characterId === id ? jointsIn(selection) : [];
  const isThere = joints.every((joint) => before.includes(joint));
  const next = isThere ? before.filter((joint) => !joints.includes(joint)) : [...before, ...joints];
  const { placement } = selection.characterId === id ? selection : {};
  const part = withJoints({ characterId: id, ...(placement !== undefined && { placement }) }, next);
  store.select(add ? withPart(selection, part) : part);
}

/** @param given without arguments: the set after the one that is selected, or the first */
export function selectByScript(wb: Uses<'store'>, given: unknown): void {
  const character = currentCharacter(wb);
  const { length } = character?.sets?.sets ?? [];
  if (!character || length === 0) return;
  if (typeof given !== 'object' || given === null || Object.keys(given).length === 0) {
    const now = [...Array(length).keys()].find((at) => isSetSelected(wb, character, at)) ?? -1;
    selectSet(wb, character, (now + 1) % length);
    return;
  }
  const { set, add } = ARGS.read(given, '');
  if (set >= length) throw new CommandError(`"set" must be the index of a set: there are ${length}, found ${set}.`);
  selectSet(wb, character, set, add);
}
