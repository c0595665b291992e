/**
 * The mark before a DOF's name, as it stands at the moment shown; a click keys the DOF there, or takes its key away.
 *
 *     ◆ keyed        it has a key at this moment
 *     ◇ driven       its keys are at other moments
 *     ● unkeyed      set by hand over its keys; goes when time moves
 *       free         no keys: it stays where it is put. A faint ◇ under the pointer says that a click keys it
 */
import { isDriven } from '../../evaluate/pose.ts';
import { type Character, findCharacter } from '../../model/document.ts';
import { button, keepsFocusElsewhere, setAttribute } from '../dom.ts';
import { deleteKeysNow, isKeyedNow, keyNow } from '../pose-edits.ts';
import type { Workbench } from '../workbench.ts';

export type DofState = 'keyed' | 'driven' | 'unkeyed' | 'free';

export class DofMark {
  readonly element: HTMLButtonElement;

  /** @param row carries the state as `data-driver` */
  constructor(
    private readonly wb: Workbench,
    private readonly row: HTMLElement,
    private readonly characterId: string,
    private readonly dof: number,
  ) {
    // Out of the order of Tab, which goes from number to number; the keyboard has the row's menu for the same.
    const mark = button('Key', { class: 'mark', tabindex: -1 }, undefined, () => toggleKey(wb, characterId, dof));
    this.element = keepsFocusElsewhere(mark);
  }

  show(character: Character): void {
    const state = dofState(this.wb, character, this.dof);
    if (this.row.dataset.driver === state) return;
    this.row.dataset.driver = state;
    const { title, label } = TEXTS[state];
    this.element.title = title;
    this.element.disabled =
      !character.skeleton || findCharacter(this.wb.store.document, this.characterId) === undefined;
    setAttribute(this.element, 'aria-label', label);
  }
}

const TEXTS: Readonly<Record<DofState, { readonly title: string; readonly label: string }>> = {
  keyed: { title: 'Keyed at this moment. Click to delete the key', label: 'Delete the key at this moment' },
  driven: { title: 'Driven by keys at other moments. Click to key it here', label: 'Key it at this moment' },
  unkeyed: { title: 'Set by hand, not keyed: goes when time moves. Click to key it', label: 'Key it at this moment' },
  free: { title: 'Not animated. Click to key it here', label: 'Key it at this moment' },
};

export function dofState(wb: Workbench, character: Character, dof: number): DofState {
  const { unkeyed } = character;
  if (unkeyed?.timeSeconds === wb.transport.get().timeSeconds && unkeyed.dofs.includes(dof)) return 'unkeyed';
  if (!isDriven(character, dof)) return 'free';
  return isKeyedNow(wb, character, dof) ? 'keyed' : 'driven';
}

/** Keys the DOF as it is shown; where it is keyed so already, takes the key away. */
export function toggleKey(wb: Workbench, characterId: string, dof: number): void {
  const character = findCharacter(wb.store.document, characterId);
  if (!character?.skeleton) return;
  if (dofState(wb, character, dof) === 'keyed') deleteKeysNow(wb, character, [dof]);
  else keyNow(wb, characterId, [dof]);
}
