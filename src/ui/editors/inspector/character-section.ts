/** The character's section: name, take, limits, placement and start time. */

import type { GUI } from 'lil-gui';
import { placeCharacter, removeCopy, renameCharacter, setTimeOffset } from '../../../edit/commands/characters.ts';
import { setClamping } from '../../../edit/commands/pose.ts';
import {
  type Character,
  DEFAULT_PLACEMENT,
  findCharacter,
  type Placement,
  shownTake,
  startSeconds,
} from '../../../model/document.ts';
import { lengthStep } from '../../../model/skeleton/reach.ts';
import { findAction, reasonNot, tryById } from '../../state/actions/action.ts';
import type { HandEdit } from '../../state/actions/hand-edit.ts';
import { followWithNumbers } from '../../state/follow-time.ts';
import { shownPerUnit, typedUnits, withoutNoise } from '../../state/joints/angles.ts';
import type { Workbench } from '../../state/workbench.ts';
import { button, element, setAttribute, setText } from '../../widgets/dom.ts';
import type { Units } from '../../widgets/numbers/arithmetic.ts';
import { exact } from '../../widgets/numbers/number-text.ts';
import { removeControllers, Slider, showIn } from '../../widgets/numbers/slider.ts';
import { contentOf } from '../../widgets/section.ts';
import { setTooltip } from '../../widgets/tooltip.ts';
import { movedButtons } from '../retarget/moved.ts';
import { followsAt } from '../retarget/moved-text.ts';
import { addSpaceRows } from './space-rows.ts';
import { addTakeRows, askForTakeName } from './take-rows.ts';

type Axis = 0 | 1 | 2;
const AXES: readonly Axis[] = [0, 1, 2];

export class CharacterSection {
  private character: Character | undefined;
  private copy = 0;
  private rows: (() => void)[] = [];
  /** Of those, what also changes with the time. */
  private timed: (() => void)[] = [];
  /** Rows made of several lil-gui controllers. */
  private lines: HTMLElement[] = [];
  private readonly buttons = element('div', { class: 'row-buttons' });

  constructor(
    private readonly wb: Workbench,
    private readonly edit: HandEdit,
    private readonly section: GUI,
  ) {
    this.buttons.append(
      button('Add an instance next to it', { class: 'plain' }, 'Add instance', () => tryById(wb, 'character.copy')),
      button('Remove this instance', { class: 'plain remove-copy' }, 'Remove instance', () => this.removeShownCopy()),
    );
    followWithNumbers(wb.transport, () => this.updateTimed());
    wb.timeline.takeRenameAsked.subscribe(() => askForTakeName(wb, section));
  }

  /** Rebuilds the rows. */
  rebuild(character: Character | undefined): void {
    removeControllers(this.section);
    this.buttons.remove();
    for (const line of this.lines) line.remove();
    this.lines = [];
    this.rows = [];
    this.timed = [];
    this.section.show(character !== undefined);
    if (this.character?.id !== character?.id) this.copy = 0;
    this.character = character;
    if (!character) return;
    this.copy = Math.min(this.copy, character.placements.length - 1);
    this.addName(character);
    this.addTake(character);
    this.addLimits(character);
    this.addStart(character);
    this.addPlacement(character);
    this.rows.push(addSpaceRows(this.wb, this.edit, this.section, character));
    contentOf(this.section).append(this.buttons);
    this.buttons.classList.toggle('single', character.placements.length === 1);
  }

  /** Updates the values of the rows. */
  update(character: Character | undefined): void {
    this.character = character;
    if (character) for (const row of this.rows) row();
  }

  private readonly refuse = (reason: string) => {
    // After Escape, the typed text is discarded without a message.
    if (!this.edit.cancelled) this.wb.messages.note(reason, 'warning');
  };

  private get id(): string {
    return this.character?.id ?? '';
  }

  private get placement(): Placement {
    return this.character?.placements[this.copy] ?? DEFAULT_PLACEMENT;
  }

  private addName(character: Character): void {
    const binding = { name: character.name };
    const row = this.section.add(binding, 'name').name('Name');
    row.onFinishChange((name: string) => {
      const trimmed = name.trim();
      if (!trimmed) this.refuse('A character needs a name.');
      else if (findCharacter(this.wb.store.document, this.id)) {
        this.wb.store.apply(renameCharacter, { characterId: this.id, name: trimmed });
      }
    });
    this.rows.push(() => {
      if (binding.name === this.character?.name || row.domElement.contains(document.activeElement)) return;
      binding.name = this.character?.name ?? '';
      row.updateDisplay();
    });
  }

  private addTake(character: Character): void {
    if (character.driver) {
      this.addMoved(movedButtons(this.wb, () => this.character?.id));
      return;
    }
    const take = shownTake(character);
    if (!take) return;
    const { line, update } = addTakeRows(this.wb, this.section, character, take);
    this.lines.push(line);
    this.rows.push(update);
    if (!take.attached) return;
    const act = (label: string, tooltip: string, id: string) => {
      const made = button(tooltip, { class: 'plain' }, label, () => tryById(this.wb, id));
      const action = findAction(this.wb, id);
      const reason = () => action && reasonNot(this.wb, action);
      setTooltip(made, () => reason() ?? tooltip);
      this.timed.push(() => setAttribute(made, 'aria-disabled', reason() && 'true'));
      return made;
    };
    this.addMoved(
      element(
        'span',
        { class: 'moved-buttons' },
        act('Put down', 'Put down at the current time, where it is', 'character.putDown'),
        act('Detach', 'Detach, so that its root has its own motion again', 'character.detach'),
      ),
    );
  }

  /** Shows what moves it, with what can be done about that. */
  private addMoved(buttons: HTMLElement): void {
    const text = element('span', { class: 'moved-by' });
    const line = element('div', { class: 'moved-row' }, text, buttons);
    contentOf(this.section).append(line);
    this.lines.push(line);
    this.timed.push(() => {
      setText(text, this.character ? followsAt(this.character, this.wb.transport.get().timeSeconds) : '');
      setTooltip(text, text.textContent ?? '');
    });
    this.rows.push(() => this.updateTimed());
  }

  private updateTimed(): void {
    for (const row of this.timed) row();
  }

  private addLimits(character: Character): void {
    const binding = { clamps: character.clampsToLimits };
    const row = this.section.add(binding, 'clamps').name('Enforce limits');
    row.onChange((clamps: boolean) => this.wb.store.apply(setClamping, { characterId: this.id, clamps }));
    this.rows.push(() => {
      showIn(row, this.character?.clampsToLimits ?? true);
    });
  }

  /** Not the stored offset: it is added to the transport's time, so that 1.5 starts 1.5 s earlier. */
  private addStart(character: Character): void {
    const options = { step: 0.01, decimals: 3, suffix: ' s' };
    const row = new Slider(this.section, 'Start time', startSeconds(character), options, this.refuse);
    setTooltip(row.domElement, 'When its take starts on the timeline, in seconds');
    row.onChange((atSeconds: number) => {
      const { character: now } = this;
      if (!now) return;
      // Plus 0: avoids an offset of −0.
      const seconds = withoutNoise(startSeconds(now) + now.timeOffsetSeconds - atSeconds) + 0;
      this.edit.preview(setTimeOffset, { characterId: this.id, seconds });
    });
    row.onTakenBack(() => this.edit.cancel()).onFinishChange(() => this.finish());
    this.rows.push(() => row.showValue(withoutNoise(this.character ? startSeconds(this.character) : 0)));
  }

  private addPlacement(character: Character): void {
    if (character.placements.length > 1) {
      const binding = { copy: this.copy };
      const names = Object.fromEntries(
        character.placements.map((_, i) => [`${i + 1} of ${character.placements.length}`, i]),
      );
      const row = this.section.add(binding, 'copy', names).name('Instance');
      row.onChange((copy: number) => {
        this.copy = copy;
        this.update(this.character);
      });
    }
    const { angles } = this.wb.settings.get();
    const degrees = shownPerUnit('angle', angles);
    const step = lengthStep(character.skeleton);
    this.addVector(
      'Position',
      1,
      { step },
      (p) => p.position,
      (p, position) => ({ ...p, position }),
    );
    const turnStep = angles === 'degrees' ? 0.1 : 0.001;
    this.addVector(
      'Rotation',
      degrees,
      { step: turnStep, suffix: angles === 'degrees' ? '°' : '', units: typedUnits('angle', angles) },
      (p) => p.turn,
      (p, turn) => ({ ...p, turn }),
    );
    const scale = new Slider(
      this.section,
      'Scale',
      this.placement.scale,
      { step: 0.01, decimals: 3, suffix: '×' },
      this.refuse,
    );
    let typed = this.placement.scale;
    scale.onChange((value: number) => {
      typed = value;
      // Typing passes through 0 on its way to 0.5.
      if (value > 0) this.place({ ...this.placement, scale: value });
    });
    scale.onTakenBack(() => this.edit.cancel());
    scale.onFinishChange(() => {
      if (typed <= 0) this.refuse(`The scale must be greater than 0; you entered ${exact(typed)}.`);
      this.finish();
      typed = this.placement.scale;
    });
    this.rows.push(() => scale.showValue(this.placement.scale));
  }

  private addVector(
    label: string,
    factor: number,
    { step, suffix = '', units }: { readonly step: number; readonly suffix?: string; readonly units?: Units },
    read: (p: Placement) => Placement['position'],
    write: (p: Placement, value: Placement['position']) => Placement,
  ): void {
    const decimals = Math.max(2, -Math.floor(Math.log10(step)));
    const line = element('div', { class: 'vector-row' }, element('span', { class: 'vector-name' }, label));
    for (const axis of AXES) {
      const letter = 'xyz'[axis];
      const start = read(this.placement)[axis] * factor;
      const options = { step, decimals, suffix, ...(units && { units }) };
      const row = new Slider(this.section, `${label} ${letter}`, start, options, this.refuse);
      row.showName(`${label} ${letter}`, element('span', { class: `dof-name axis-${letter}` }, letter));
      line.append(row.domElement);
      row.onChange((value: number) => {
        const now = read(this.placement);
        const next = AXES.map((a) => (a === axis ? value / factor : now[a]));
        this.place(write(this.placement, [next[0], next[1], next[2]]));
      });
      row.onTakenBack(() => this.edit.cancel()).onFinishChange(() => this.finish());
      this.rows.push(() => row.showValue(withoutNoise(read(this.placement)[axis] * factor)));
    }
    contentOf(this.section).append(line);
    this.lines.push(line);
  }

  /** After a cancelled drag the controls still show the last mouse position. */
  private finish(): void {
    this.edit.commit();
    this.update(this.character && findCharacter(this.wb.store.document, this.character.id));
  }

  private place(placement: Placement): void {
    this.edit.preview(placeCharacter, { characterId: this.id, index: this.copy, placement });
  }

  private removeShownCopy(): void {
    if (this.character && this.character.placements.length > 1) {
      this.wb.store.apply(removeCopy, { characterId: this.id, index: this.copy });
    }
  }
}
