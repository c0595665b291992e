/**
 * The takes tab: the table, and beside it the layers of the shown take, or while two takes are compared, the distances
 * of their joints. All follow the document and redraw only while visible.
 */
import { placeCharacter } from '../../../edit/commands/characters.ts';
import { findCharacter } from '../../../model/document.ts';
import { findAction } from '../../state/actions/action.ts';
import { attempt } from '../../state/actions/attempt.ts';
import { sectionsOf } from '../../state/actions/menu-entries.ts';
import { shortcutsFor, shortcutText } from '../../state/shortcuts.ts';
import { type Compared, type Comparison, comparedIn } from '../../state/takes.ts';
import type { TimelineTab } from '../../state/timeline.ts';
import type { Workbench } from '../../state/workbench.ts';
import { element, setText, write } from '../../widgets/dom.ts';
import { isMac } from '../../widgets/focus/keyboard.ts';
import { oncePerFrame } from '../../widgets/frame.ts';
import { type MenuEntry, type MenuPlace, openMenu } from '../../widgets/menu.ts';
import { zoomWindow } from '../../widgets/time/time-window.ts';
import { LayersPane } from '../layers/pane.ts';
import { movedEntries } from '../retarget/moved.ts';
import { compareWith } from './compare-menu.ts';
import { type CompareSwitch, compareSwitch } from './compare-switch.ts';
import { endComparison } from './compared-takes.ts';
import { DistancePane } from './distance-pane.ts';
import {
  chosenTakes,
  listOfTakes,
  playAlone,
  playTogether,
  removeTakeRows,
  selectCharacter,
  startAt,
  toggleShown,
} from './play.ts';
import { shownKey, type TakeRow, takeKey } from './rows.ts';
import { compareTakes } from './start-comparison.ts';
import { TakeTable } from './table.ts';
import { arrangeEntries, takeTools } from './tools.ts';
import { followSelection } from './which-takes.ts';

export function takesPanel(wb: Workbench): TimelineTab {
  return new TakesPanel(wb);
}

/** Beside the rows. */
const MENU_OF_ALL = [
  ['file.open', 'file.openFolder'],
  ['take.new', 'take.duplicate'],
  ['Play/Loop', 'Play/Speed'],
];

class TakesPanel implements TimelineTab {
  readonly element: HTMLElement;
  readonly tools: HTMLElement;
  private readonly table: TakeTable;
  private readonly distances: DistancePane;
  private readonly layers: LayersPane;
  private readonly parts: CompareSwitch;
  private readonly empty = element('p', { class: 'empty take-empty', hidden: true });
  private visible = false;
  private readonly showSoon = oncePerFrame(() => this.show());

  constructor(private readonly wb: Workbench) {
    const { takes } = wb.timeline;
    this.table = new TakeTable({
      toggle: (row) => this.toggle(row),
      play: (row) => playAlone(wb, row),
      startAt: (row, seconds) => startAt(wb, row, seconds),
      place: (row, to) => this.place(row, to),
      refuse: (reason) => wb.messages.note(reason, 'warning'),
      sort(order) {
        const { order: _before, ...view } = takes.view.get();
        takes.view.set({ ...view, ...(order && { order }) });
      },
      choose(chosen, row) {
        takes.change({ chosen, focused: row.key });
        selectCharacter(wb, row.characterId);
      },
      remove: (rows) => removeTakeRows(wb, rows),
      menu: (row, at) => (row ? this.menu(row, at) : openMenu(at, sectionsOf(wb, MENU_OF_ALL), { label: 'Takes' })),
    });
    this.distances = new DistancePane(wb);
    this.layers = new LayersPane(wb);
    this.tools = takeTools(wb);
    this.element = element(
      'div',
      { class: 'takes', 'data-panel': 'takes' },
      this.empty,
      this.table.element,
      this.distances.element,
      this.layers.element,
    );
    this.parts = compareSwitch(this.element);
    this.element.prepend(this.parts.element);
    this.follow();
  }

  private follow(): void {
    const { wb } = this;
    const { takes } = wb.timeline;
    followSelection(wb);
    wb.store.subscribe((now, before) => {
      if (now.selection.characterId !== before.selection.characterId) {
        this.goToSelected();
        this.showSoon();
      }
      if (now.document !== before.document) this.showSoon();
    });
    // At once, since the next key continues from this row.
    takes.view.subscribe(() => this.show());
    takes.comparison.subscribe(() => {
      this.show();
      this.parts.choose('graph');
      this.distances.setVisible(this.visible);
    });
    wb.transport.subscribe((now, before) => {
      if (now.framesPerSecond !== before.framesPerSecond) this.showSoon();
    });
  }

  setVisible(visible: boolean): void {
    if (visible === this.visible) return;
    this.visible = visible;
    if (visible) this.goToSelected();
    this.show();
    this.distances.setVisible(visible);
    if (!visible) this.layers.setVisible(false);
  }

  fitAll(): void {
    if (!this.distances.fitAll()) this.wb.timeline.fit(this.wb.transport.get().range);
  }

  fitSelected(): void {
    this.fitAll();
  }

  zoom(timeFactor: number): void {
    const { timeSeconds } = this.wb.transport.get();
    const { timeline } = this.wb;
    timeline.change({ window: zoomWindow(timeline.view.get().window, timeSeconds, timeFactor) });
  }

  recolour(): void {
    this.distances.recolour();
  }

  private show(): void {
    if (!this.visible) return;
    const { wb } = this;
    const { takes } = wb.timeline;
    const { order, chosen, focused, filter } = takes.view.get();
    const comparison = takes.comparison.get();
    const compared = comparedIn(wb.store.document, comparison);
    const [first, second] = compared && comparison ? keysOf(compared, comparison) : [];
    const isComparing = compared !== undefined;
    const rows = listOfTakes(wb);
    this.element.classList.toggle('comparing', isComparing);
    const hasLayers = !isComparing && this.layers.isUseful;
    this.element.classList.toggle('with-layers', hasLayers);
    this.layers.setVisible(hasLayers);
    write(this.distances.element, 'hidden', !isComparing);
    write(this.empty, 'hidden', rows.length > 0);
    write(this.table.element, 'hidden', rows.length === 0);
    this.table.element.classList.toggle(
      'same-names',
      rows.every((row) => !row.character),
    );
    setText(
      this.empty,
      filter
        ? `No take matches “${filter}”.`
        : 'No takes yet. Drop BVH files, a folder of them, or a character with its .anim files.',
    );
    this.table.show(rows, {
      order,
      chosen,
      focused,
      framesPerSecond: wb.transport.get().framesPerSecond,
      compared: ({ key }) => (key === first ? 'first' : key === second ? 'second' : undefined),
    });
  }

  /** Another character was selected elsewhere: the list moves to its take. */
  private goToSelected(): void {
    const { store, timeline } = this.wb;
    const character = findCharacter(store.document, store.selection.characterId);
    const key = character && shownKey(character);
    const { focused } = timeline.takes.view.get();
    // Stays if the list is at any of its takes.
    if (!key || focused?.startsWith(`${character.id}/`)) return;
    timeline.takes.change({ focused: key, chosen: new Set([key]) });
  }

  /** The second take of one compared character is hidden with it. */
  private toggle(row: TakeRow): void {
    const { store, timeline } = this.wb;
    const comparison = timeline.takes.comparison.get();
    const compared = comparedIn(store.document, comparison);
    const keys = compared && comparison ? keysOf(compared, comparison) : [];
    const isDrawn = keys.includes(row.key) && !row.isHidden;
    toggleShown(this.wb, isDrawn ? { ...row, isShown: true } : row);
  }

  private place(row: TakeRow, { x = row.x, z = row.z }: { readonly x?: number; readonly z?: number }): void {
    const { store, messages } = this.wb;
    const placement = findCharacter(store.document, row.characterId)?.placements[0];
    if (!placement) return;
    const position = [x, placement.position[1], z] as const;
    attempt(messages, () =>
      store.apply(placeCharacter, { characterId: row.characterId, index: 0, placement: { ...placement, position } }),
    );
  }

  private menu(row: TakeRow, at: MenuPlace): void {
    const { wb } = this;
    const chosen = chosenTakes(wb);
    const [first, second] = chosen;
    const isComparing = wb.timeline.takes.comparison.get() !== undefined;
    const item = (label: string, run: () => void, shortcut?: string, enabled = true): MenuEntry => ({
      kind: 'item',
      label,
      enabled,
      run,
      ...(shortcut && { shortcut }),
    });
    const keyOf = (id: string) => {
      const action = findAction(wb, id);
      const [key] = action ? shortcutsFor(action, wb.settings.get()) : [];
      return key && shortcutText(key, isMac);
    };
    const character = findCharacter(wb.store.document, row.characterId);
    const entries: MenuEntry[] = [
      ...(character ? movedEntries(wb, character) : []),
      item('Play alone', () => playAlone(wb, row), 'Enter'),
      ...(chosen.length > 1 ? [item(`Play these ${chosen.length} together`, () => playTogether(wb, chosen))] : []),
      item(row.isShown ? 'Hide' : 'Show', () => toggleShown(wb, row), keyOf('take.toggleShown')),
      ...(isComparing ? [item('Stop comparing', () => endComparison(wb))] : []),
      ...(first && second && chosen.length === 2
        ? [item('Compare these 2', () => compareTakes(wb, first, second))]
        : compareWith(wb, row)),
      { kind: 'menu', label: 'Arrange', entries: () => arrangeEntries(wb) },
      ...sectionsOf(wb, [['Edit/Edit takes']]),
      { kind: 'line' },
      item(chosen.length > 1 ? `Remove ${chosen.length} takes` : 'Remove', () => removeTakeRows(wb, chosen), 'Del'),
    ];
    openMenu(at, entries, { label: row.name });
  }
}

/** Keys of the rows of two compared takes: what the characters play; of one character, the second take as chosen. */
function keysOf([a, b]: readonly [Compared, Compared], { first, second }: Comparison): readonly (string | undefined)[] {
  const isOne = first.characterId === second.characterId;
  return [shownKey(a.character), isOne ? takeKey(second) : shownKey(b.character)];
}
