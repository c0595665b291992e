/** A row of buttons below the tree of the outliner: the selection sets of the current character. Hidden without any. */
import type { Character } from '../../../model/document.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import { keyNameOf } from '../../state/actions/tooltips.ts';
import { addsToSelection } from '../../state/joints/select-joints.ts';
import { selectedJointsOf } from '../../state/joints/selected-joint.ts';
import { onDemand } from '../../state/on-demand.ts';
import type { Workbench } from '../../state/workbench.ts';
import { button, element, setAttribute, setStyle, write } from '../../widgets/dom.ts';
import { asksForMenu, type MenuEntry, type MenuPlace, openMenu } from '../../widgets/menu.ts';
import { plural } from '../../widgets/numbers/number-text.ts';
import { setTooltip } from '../../widgets/tooltip.ts';
import { isSetSelected, selectSet } from './select-set.ts';

export function setsStrip(wb: Workbench): HTMLElement {
  return new SetsStrip(wb).element;
}

class SetsStrip {
  readonly element = element('div', {
    class: 'sets-strip',
    role: 'toolbar',
    'aria-label': 'Selection sets',
    hidden: true,
  });
  private buttons: readonly HTMLButtonElement[] = [];
  private shown: Character['sets'];

  constructor(private readonly wb: Workbench) {
    wb.store.subscribe(() => this.show());
    this.show();
  }

  private show(): void {
    const { wb, element: strip } = this;
    const character = currentCharacter(wb);
    const sets = character?.sets?.sets ?? [];
    write(strip, 'hidden', sets.length === 0);
    if (this.shown !== character?.sets) {
      this.shown = character?.sets;
      this.buttons = sets.map((_, at) => this.button(at));
      strip.replaceChildren(...this.buttons);
    }
    for (const [at, one] of this.buttons.entries()) {
      const isOn = character !== undefined && isSetSelected(wb, character, at);
      setAttribute(one, 'aria-pressed', String(isOn));
    }
  }

  private button(at: number): HTMLButtonElement {
    const { wb } = this;
    const { name, color, joints } = this.shown?.sets[at] ?? { name: '', joints: [] };
    const dot = element('span', { class: 'set-dot', 'aria-hidden': 'true' });
    // What is no colour leaves it as it is.
    if (color) setStyle(dot, 'background-color', color);
    const label = element('span', { class: 'set-name' }, name || 'Unnamed');
    const made = button(`Select ${name || 'unnamed set'}`, { class: 'tool text-tool set' }, dot, () => undefined);
    made.append(label);
    made.addEventListener('click', (event) => {
      const character = currentCharacter(wb);
      if (character) selectSet(wb, character, at, addsToSelection(wb, event) || event.shiftKey);
    });
    const key = keyNameOf(wb, `sets.select${at + 1}`);
    setTooltip(made, `${plural(joints.length, 'joint')}${key ? ` (${key})` : ''}. Shift+click adds them`);
    made.addEventListener('contextmenu', (event) => {
      event.preventDefault();
      this.menu(at, made, { x: event.clientX, y: event.clientY });
    });
    made.addEventListener('keydown', (event) => {
      if (event.key === 'F2') this.rename(at, made);
      else if (asksForMenu(event)) {
        const { left, bottom } = made.getBoundingClientRect();
        this.menu(at, made, { x: left, y: bottom, byKeyboard: true });
      } else return;
      event.preventDefault();
    });
    return made;
  }

  private menu(at: number, opener: HTMLElement, place: MenuPlace): void {
    const { wb } = this;
    const character = currentCharacter(wb);
    const set = character?.sets?.sets[at];
    if (!character || !set) return;
    const item = (label: string, run: () => void, enabled = true): MenuEntry => ({ kind: 'item', label, enabled, run });
    const edit = (run: (edits: typeof import('./edits.ts'), character: Character) => void) => () => void this.edit(run);
    const list: MenuEntry[] = [
      item('Add to selection', () => selectSet(wb, character, at, true)),
      item('Rename', () => this.rename(at, opener)),
      item(
        'Set to selected joints',
        edit((edits, now) => edits.setJoints(wb, now, at)),
        selectedJointsOf(wb, character.id).length > 0,
      ),
      item(
        'Next colour',
        edit((edits, now) => edits.nextColour(wb, now, at)),
      ),
      { kind: 'line' },
      item(
        `Remove ${set.name}`,
        edit((edits, now) => edits.remove(wb, now, at)),
      ),
    ];
    openMenu(place, list, { label: set.name, opener });
  }

  /** Enter names it, Escape and an empty field leave its name. */
  private rename(at: number, replaced: HTMLElement): void {
    const name = this.shown?.sets[at]?.name ?? '';
    const field = element('input', { class: 'set-field', 'aria-label': 'Name of the set', value: name });
    let isOver = false;
    const end = (takes: boolean) => {
      if (isOver) return;
      isOver = true;
      field.replaceWith(replaced);
      if (takes && field.value !== name) void this.edit((edits, now) => edits.renameSet(this.wb, now, at, field.value));
    };
    field.addEventListener('keydown', (event) => {
      if (event.key !== 'Enter' && event.key !== 'Escape') return;
      event.stopPropagation();
      end(event.key === 'Enter');
      replaced.focus();
    });
    field.addEventListener('blur', () => end(true));
    replaced.replaceWith(field);
    field.focus();
    field.select();
  }

  private async edit(run: (edits: typeof import('./edits.ts'), character: Character) => void): Promise<void> {
    const { wb } = this;
    const edits = await onDemand(wb.messages, 'Selection sets', () => import('./edits.ts'));
    const character = currentCharacter(wb);
    if (edits && character) run(edits, character);
  }
}
