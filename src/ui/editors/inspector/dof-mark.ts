/**
 * The mark before a DOF's name, as it stands at the moment shown; a click keys the DOF there, or takes its key away.
 *
 *     ◆ keyed        it has a key at this moment
 *     ◇ driven       its keys are at other moments
 *     ● unkeyed      set by hand over its keys; goes when time moves
 *     ▸ moved        another character's take moves it; no key can be made
 *       free         no keys: it stays where it is put. A faint ◇ under the pointer says that a click keys it
 */
import { channelOf, isDriven } from '../../../evaluate/pose.ts';
import { type Character, findCharacter } from '../../../model/document.ts';
import { button, keepsFocusElsewhere, setAttribute } from '../../kit/dom.ts';
import { setTooltip } from '../../kit/tooltip.ts';
import { attempt } from '../../state/attempt.ts';
import type { Uses } from '../../state/workbench.ts';
import { deleteKeysNow, isKeyedNow, keyNow } from '../posing/pose-edits.ts';

export type DofState = 'keyed' | 'driven' | 'unkeyed' | 'moved' | 'free';

export class DofMark {
  readonly element: HTMLButtonElement;

  /**
   * @param row carries the state as `data-driver`
   * @param name of the DOF, as it is spoken: `rx of leg_fl`
   */
  constructor(
    private readonly wb: Uses<'store' | 'transport' | 'timeline' | 'settings' | 'messages'>,
    private readonly row: HTMLElement,
    private readonly characterId: string,
    private readonly dof: number,
    private readonly name: string,
  ) {
    // Out of the order of Tab, which goes from number to number; the keyboard has the row's menu for the same.
    const mark = button(`Key ${name}`, { class: 'mark', tabindex: -1 }, undefined, () =>
      toggleKey(wb, characterId, dof),
    );
    this.element = keepsFocusElsewhere(mark);
  }

  show(character: Character): void {
    const state = dofState(this.wb, character, this.dof);
    if (this.row.dataset.driver === state) return;
    this.row.dataset.driver = state;
    setTooltip(this.element, TITLES[state]);
    this.element.disabled =
      !character.skeleton || findCharacter(this.wb.store.document, this.characterId) === undefined;
    setAttribute(this.element, 'aria-label', markLabel(state, this.name));
  }
}

const TITLES: Readonly<Record<DofState, string>> = {
  keyed: 'Keyed at current time. Click to delete the key',
  driven: 'Animated, not keyed at current time. Click to key it',
  unkeyed: 'Unkeyed change, lost when the time changes. Click to key it',
  moved: 'Retargeted from another character. Bake it to key it',
  free: 'Not animated. Click to key it',
};

/** What a screen reader says of a click: among hundreds of marks it tells which one is meant. */
export function markLabel(state: DofState, name: string): string {
  if (state === 'moved') return `${name} is retargeted from another character`;
  return state === 'keyed' ? `Delete key of ${name} at current time` : `Key ${name}`;
}

export function dofState(wb: Uses<'transport'>, character: Character, dof: number): DofState {
  const { unkeyed } = character;
  if (unkeyed?.timeSeconds === wb.transport.get().timeSeconds && unkeyed.dofs.includes(dof)) return 'unkeyed';
  if (!isDriven(character, dof)) return 'free';
  if (!channelOf(character, dof)) return 'moved';
  return isKeyedNow(wb, character, dof) ? 'keyed' : 'driven';
}

/** Keys the DOF as it is shown; where it is keyed so already, takes the key away. */
export function toggleKey(
  wb: Uses<'store' | 'transport' | 'timeline' | 'settings' | 'messages'>,
  characterId: string,
  dof: number,
): void {
  const character = findCharacter(wb.store.document, characterId);
  if (!character?.skeleton) return;
  if (dofState(wb, character, dof) === 'keyed') deleteKeysNow(wb, character, [dof]);
  // Refused where another character's take moves the joint.
  else attempt(wb.messages, () => keyNow(wb, characterId, [dof]));
}
