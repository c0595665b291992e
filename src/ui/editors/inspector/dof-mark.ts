/**
 * The mark before a DOF's name, at the current time; a click keys the DOF, or deletes its key.
 *
 *     ◆ keyed        has a key at the current time
 *     ◇ driven       has keys at other times
 *     ● unkeyed      changed over its keys; lost when the time changes
 *     ▸ moved        retargeted from another character; can't be keyed
 *     ▪ locked       posing and keying leave it alone; a click unlocks it
 *       free         no keys, keeps its value. A faint ◇ on hover shows that a click keys it
 */
import { channelOf, isDriven } from '../../../evaluate/pose.ts';
import { type Character, findCharacter } from '../../../model/document.ts';
import { lockedDofs } from '../../../model/sets.ts';
import { attempt } from '../../state/actions/attempt.ts';
import type { Uses } from '../../state/workbench.ts';
import { button, keepsFocusElsewhere, setAttribute, write } from '../../widgets/dom.ts';
import { setTooltip } from '../../widgets/tooltip.ts';
import { deleteKeysNow, isKeyedNow, isSampled, keyNow } from '../posing/pose-edits.ts';
import { toggleLocks } from '../sets/toggle-locks.ts';

export type DofState = 'locked' | 'keyed' | 'driven' | 'unkeyed' | 'moved' | 'free';

export class DofMark {
  readonly element: HTMLButtonElement;
  private tip = '';

  /**
   * @param row has the state as `data-driver`
   * @param dofs keyed together; the first one's state is shown
   * @param name of the DOF for screen readers: `rx of leg_fl`
   */
  constructor(
    private readonly wb: Uses<'store' | 'transport' | 'timeline' | 'settings' | 'messages'>,
    private readonly row: HTMLElement,
    private readonly characterId: string,
    private readonly dofs: readonly number[],
    private readonly name: string,
  ) {
    // Not a tab stop: Tab moves from number to number, and the row's menu does the same by keyboard.
    const mark = button(`Key ${name}`, { class: 'mark', tabindex: -1 }, undefined, () =>
      toggleKey(wb, characterId, dofs),
    );
    this.element = keepsFocusElsewhere(mark);
  }

  show(character: Character): void {
    const [dof] = this.dofs;
    const state = dofState(this.wb, character, dof);
    const tip = (isSampled(character, dof) && SAMPLED_TITLES[state]) || TITLES[state];
    if (this.row.dataset.driver === state && this.tip === tip) return;
    write(this.row.dataset, 'driver', state);
    this.tip = tip;
    setTooltip(this.element, tip);
    const isGone = !character.skeleton || findCharacter(this.wb.store.document, this.characterId) === undefined;
    write(this.element, 'disabled', isGone);
    setAttribute(this.element, 'aria-label', markLabel(state, this.name));
  }
}

const TITLES: Readonly<Record<DofState, string>> = {
  locked: 'Locked: posing and keying leave it alone. Click to unlock it',
  keyed: 'Keyed at current time. Click to delete the key',
  driven: 'Animated, not keyed at current time. Click to key it',
  unkeyed: 'Unkeyed change, lost when the time changes. Click to key it',
  moved: 'Retargeted from another character. Bake it to key it',
  free: 'Not animated. Click to key it',
};

/** Of sampled channels. */
const SAMPLED_TITLES: Partial<Record<DofState, string>> = {
  driven: 'Sampled at every frame. Click to convert it to keys',
  unkeyed: 'Unkeyed change over samples, lost when the time changes. Click to convert them to keys',
};

/** What a click does, for screen readers; names the DOF, as there are hundreds of marks. */
export function markLabel(state: DofState, name: string): string {
  if (state === 'moved') return `${name} is retargeted from another character`;
  if (state === 'locked') return `Unlock ${name}`;
  return state === 'keyed' ? `Delete key of ${name} at current time` : `Key ${name}`;
}

export function dofState(wb: Uses<'transport'>, character: Character, dof: number): DofState {
  if (lockedDofs(character).has(dof)) return 'locked';
  const { unkeyed } = character;
  if (unkeyed?.timeSeconds === wb.transport.get().timeSeconds && unkeyed.dofs.includes(dof)) return 'unkeyed';
  if (!isDriven(character, dof)) return 'free';
  if (!channelOf(character, dof)) return 'moved';
  return isKeyedNow(wb, character, dof) ? 'keyed' : 'driven';
}

/** Keys the DOFs as shown; deletes their keys if all are keyed so already. */
export function toggleKey(
  wb: Uses<'store' | 'transport' | 'timeline' | 'settings' | 'messages'>,
  characterId: string,
  dofs: readonly number[],
): void {
  const character = findCharacter(wb.store.document, characterId);
  if (!character?.skeleton) return;
  const each = [...dofs].sort((a, b) => a - b);
  if (each.every((dof) => dofState(wb, character, dof) === 'locked')) toggleLocks(wb, characterId, each);
  else if (each.every((dof) => dofState(wb, character, dof) === 'keyed'))
    deleteKeysNow(wb, [{ character, dofs: each }]);
  // Refused if the joint is retargeted from another character.
  else attempt(wb.messages, () => keyNow(wb, [{ character, dofs: each }]));
}
