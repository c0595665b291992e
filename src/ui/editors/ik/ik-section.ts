/**
 * The IK section of the inspector: whether the root may move, how the selected joint bends, and the list of pins. Shown
 * in IK mode, or if there are pins.
 */

import type { GUI } from 'lil-gui';
import { ikOf } from '../../../evaluate/ik/set-up.ts';
import { type Character, findCharacter } from '../../../model/document.ts';
import type { Pin } from '../../../model/ik.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import { jointsIn } from '../../../model/skeleton/selected-joints.ts';
import { currentCharacter, tryById } from '../../state/actions/action.ts';
import type { PinRef } from '../../state/ik-hand.ts';
import type { Uses } from '../../state/workbench.ts';
import { button, element, setAttribute, setText, write } from '../../widgets/dom.ts';
import { icon } from '../../widgets/icons.ts';
import { middleCut } from '../../widgets/middle-cut.ts';
import { NumberField } from '../../widgets/numbers/number-field.ts';
import { shown } from '../../widgets/numbers/number-text.ts';
import { contentOf } from '../../widgets/section.ts';
import { setTooltip } from '../../widgets/tooltip.ts';
import { changePin, freeRoot, selectPin, stiffen, unpinByHand } from './pin-edits.ts';
import { pointName } from './pin-picture.ts';
import { selectedPin } from './selected-pin.ts';

/** Initial value when stiffness is switched on. */
const USUAL_STIFFNESS = 4;

type Bending = 'usual' | 'stiff' | 'locked';
const BENDING: readonly (readonly [Bending, string])[] = [
  ['usual', 'Default'],
  ['stiff', 'Stiff'],
  ['locked', 'Locked'],
];

/** A pin's row, kept as long as the pin. */
interface Row {
  readonly element: HTMLElement;
  show(pin: Pin, character: Character): void;
}

export class IkSection {
  private readonly root = element('input', { type: 'checkbox', id: 'ik-root' });
  private readonly joint = middleCut('ik-joint');
  private readonly bending = element(
    'select',
    { 'aria-label': 'Bending of selected joint' },
    ...BENDING.map(([value, text]) => element('option', { value }, text)),
  );
  private readonly stiffness: NumberField;
  private readonly jointRow: HTMLElement;
  private readonly list = element('ul', { class: 'ik-pins', 'aria-label': 'Pins' });
  private readonly empty = element(
    'p',
    { class: 'faint' },
    'No pins. In IK mode, click a point on the character to pin it.',
  );
  private readonly note = element(
    'p',
    { class: 'faint' },
    'In IK mode, pinned points stay in place while you pose. In FK mode they move.',
  );
  private readonly hold: HTMLButtonElement;
  private readonly rows = new Map<number, Row>();
  private characterId: string | undefined;

  constructor(
    private readonly wb: Uses<'store' | 'actions' | 'posing' | 'messages'>,
    private readonly section: GUI,
  ) {
    this.stiffness = new NumberField({
      label: 'Stiffness (1 default, 4 moves half as far)',
      text: (value) => shown(value),
      commit: (value) => this.bend(value),
      refuse: (reason) => wb.messages.note(reason, 'warning'),
      step: 1,
    });
    const bends = element('label', { class: 'ik-bends' }, element('span', { class: 'faint' }, 'Bending'), this.bending);
    this.jointRow = element('div', { class: 'ik-row' }, this.joint.element, bends, this.stiffness.element);
    this.hold = button('Hold pins over range', { class: 'plain ik-hold' }, undefined, () => tryById(wb, 'ik.holdPins'));
    this.hold.textContent = 'Hold pins over range…';
    const rootRow = element('label', { class: 'ik-row', for: 'ik-root' }, this.root, 'Allow root to move');
    contentOf(section).append(
      element('div', { class: 'ik-section' }, rootRow, this.jointRow, this.list, this.empty, this.note, this.hold),
    );
    this.root.addEventListener('change', () => {
      if (this.characterId) freeRoot(wb, this.characterId, this.root.checked);
    });
    this.bending.addEventListener('change', () => {
      const chosen = BENDING.find(([value]) => value === this.bending.value)?.[0] ?? 'usual';
      this.bend(chosen === 'stiff' ? USUAL_STIFFNESS : chosen);
    });
    this.list.addEventListener('keydown', (event) => this.onKey(event));
    wb.posing.ik.selected.subscribe(() => this.update());
    wb.posing.mode.subscribe(() => this.update());
  }

  /** Updates all values. */
  update(): void {
    const character = currentCharacter(this.wb);
    const setup = character?.skeleton && ikOf(character);
    this.section.show(setup !== undefined && (this.wb.posing.mode.get() === 'ik' || setup.pins.length > 0));
    if (character?.id !== this.characterId) this.clear();
    this.characterId = character?.id;
    if (!character || !setup) {
      this.clear();
      return;
    }
    this.root.checked = setup.rootIsFree;
    this.showJoint(character);
    this.showPins(character, setup.pins);
  }

  private showJoint(character: Character): void {
    const { joint } = this.wb.store.selection;
    const isChosen = joint !== undefined && this.wb.store.selection.characterId === character.id;
    write(this.jointRow, 'hidden', !isChosen);
    if (!isChosen) return;
    const own = ikOf(character).stiff.find((one) => one.joint === joint);
    const now: Bending = !own ? 'usual' : own.stiffness === undefined ? 'locked' : 'stiff';
    this.joint.show(jointName(character.skeleton, joint));
    setTooltip(this.joint.element, `${jointName(character.skeleton, joint)}: bending`);
    this.bending.value = now;
    write(this.stiffness.element, 'hidden', now !== 'stiff');
    this.stiffness.show(own?.stiffness ?? Number.NaN);
  }

  private showPins(character: Character, pins: readonly Pin[]): void {
    for (const [id, row] of this.rows) {
      if (pins.some((pin) => pin.id === id)) continue;
      row.element.remove();
      this.rows.delete(id);
    }
    write(this.empty, 'hidden', pins.length > 0);
    for (const each of [this.hold, this.note]) write(each, 'hidden', pins.length === 0);
    for (const pin of pins) {
      let row = this.rows.get(pin.id);
      if (!row) {
        row = this.rowOf({ characterId: character.id, pin: pin.id });
        this.rows.set(pin.id, row);
        this.list.append(row.element);
      }
      row.show(pin, character);
    }
  }

  private rowOf(ref: PinRef): Row {
    const { wb } = this;
    const name = element('span', { class: 'ik-pin-joint' });
    const kind = element('span', { class: 'ik-pin-point' });
    const choose = button('Select pin', { class: 'ik-pin-name' }, undefined, () => {
      const pin = this.pinOf(ref);
      if (pin) selectPin(wb, ref, pin.joint);
    });
    choose.append(name, kind);
    const weight = new NumberField({
      label: 'Relative weight',
      text: (value) => shown(value),
      commit: (value) => {
        changePin(wb, ref, { weight: value });
        this.update();
      },
      refuse: (reason) => wb.messages.note(reason, 'warning'),
      step: 1,
    });
    const turn = button('Pin orientation too', { class: 'tool small', 'aria-pressed': 'false' }, icon('axes'), () => {
      const pin = this.pinOf(ref);
      if (pin) changePin(wb, ref, { holdsOrientation: !pin.holdsOrientation });
    });
    const free = button('Remove pin', { class: 'tool small' }, icon('close'), () => {
      const next = made.nextElementSibling ?? made.previousElementSibling;
      unpinByHand(wb, ref);
      // Moves the focus to a neighbour, so that it isn't lost.
      next?.querySelector<HTMLElement>('.ik-pin-name')?.focus();
    });
    const made = element('li', { class: 'ik-pin', 'data-pin': String(ref.pin) }, choose, weight.element, turn, free);
    const { pointedAt } = wb.posing.ik;
    made.addEventListener('pointerenter', () => pointedAt.set(ref));
    made.addEventListener('pointerleave', () => pointedAt.set(undefined));
    return {
      element: made,
      show(pin, character) {
        const text = `${jointName(character.skeleton, pin.joint)}, ${pointName(character, pin)}`;
        setText(name, jointName(character.skeleton, pin.joint));
        setText(kind, pointName(character, pin));
        setAttribute(choose, 'aria-label', `Select pin of ${text}`);
        setTooltip(choose, text);
        setAttribute(free, 'aria-label', `Remove pin of ${text}`);
        setAttribute(turn, 'aria-label', `Pin orientation of ${text} too`);
        setAttribute(turn, 'aria-pressed', String(pin.holdsOrientation));
        setAttribute(weight.element, 'aria-label', `Relative weight of ${text}`);
        weight.show(pin.weight);
        const chosen = selectedPin(wb);
        const isChosen = chosen?.pin.id === pin.id && chosen.character.id === character.id;
        made.classList.toggle('selected', isChosen);
        setAttribute(choose, 'aria-current', isChosen ? 'true' : undefined);
      },
    };
  }

  private onKey(event: KeyboardEvent): void {
    const row = event.target instanceof Element ? event.target.closest<HTMLElement>('.ik-pin') : null;
    const onName = event.target instanceof Element && event.target.matches('.ik-pin-name');
    if (!row || !onName || event.ctrlKey || event.metaKey || event.altKey) return;
    const to =
      event.key === 'ArrowDown' ? row.nextElementSibling : event.key === 'ArrowUp' ? row.previousElementSibling : null;
    if (event.key === 'Delete' || event.key === 'Backspace') {
      row.querySelector<HTMLButtonElement>('[aria-label^="Remove"]')?.click();
    } else if (to) to.querySelector<HTMLElement>('.ik-pin-name')?.focus();
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  private bend(stiffness: number | 'locked' | 'usual'): void {
    const joints = jointsIn(this.wb.store.selection);
    if (this.characterId && joints.length > 0) stiffen(this.wb, this.characterId, joints, stiffness);
    this.update();
  }

  private pinOf({ characterId, pin }: PinRef): Pin | undefined {
    const character = findCharacter(this.wb.store.document, characterId);
    return character && ikOf(character).pins.find(({ id }) => id === pin);
  }

  private clear(): void {
    for (const { element: row } of this.rows.values()) row.remove();
    this.rows.clear();
  }
}
