/**
 * The list of layers, beside that of takes: the topmost layer first, the base last. A click or an arrow key makes a
 * layer active, which poses and keys go into.
 *
 *     F2, double click   names a layer        Alt+↑ ↓, drag   moves it
 *     M   S              mutes, solos it      Delete          removes it
 */
import { type Character, shownTake } from '../../../model/document.ts';
import type { LayerInfo } from '../../../model/takes/layer-code.ts';
import { countingLayers } from '../../../model/takes/layers.ts';
import type { Take } from '../../../model/takes/take.ts';
import { currentCharacter, findAction, isEnabled, tryAction } from '../../state/actions/action.ts';
import { HandEdit } from '../../state/actions/hand-edit.ts';
import { sectionsOf } from '../../state/actions/menu-entries.ts';
import { setActionTooltip } from '../../state/actions/tooltips.ts';
import { selectedJointsOf } from '../../state/joints/selected-joint.ts';
import { manualLink } from '../../state/manual-link.ts';
import type { Workbench } from '../../state/workbench.ts';
import { button, element, keepsFocusElsewhere, setAttribute, setText, write } from '../../widgets/dom.ts';
import { HAS_KEYS } from '../../widgets/focus/focus.ts';
import { toolbar } from '../../widgets/focus/roving.ts';
import { oncePerFrame } from '../../widgets/frame.ts';
import { asksForMenu, type MenuEntry, type MenuPlace, openMenu } from '../../widgets/menu.ts';
import { plural } from '../../widgets/numbers/number-text.ts';
import { RowSelection } from '../../widgets/table/row-selection.ts';
import { WindowedList } from '../../widgets/windowed-list.ts';
import * as edits from './edits.ts';
import { letRowsBeMoved } from './order-drag.ts';
import { type LayerRow, LayerRowView } from './row.ts';

/** Buttons with texts. */
const BUTTONS: readonly (readonly [id: string, text: string])[] = [
  ['layer.add', '+ Layer'],
  ['layer.mergeDown', 'Merge down'],
  ['layer.flatten', 'Flatten'],
];
const MENU = [
  ['layer.add', 'layer.addMasked'],
  ['layer.raise', 'layer.lower'],
  ['layer.mute', 'layer.solo', 'layer.override', 'layer.mask'],
  ['layer.mergeDown', 'layer.flatten', 'layer.remove'],
];

export class LayersPane {
  readonly element: HTMLElement;
  private readonly title = element('b', { class: 'layers-title' });
  private readonly space = element('div', { class: 'sort-space', role: 'rowgroup' });
  private readonly grid = element(
    'div',
    { class: 'layer-rows sort-table', role: 'grid', tabindex: 0, [HAS_KEYS]: true, 'data-panel': 'layers' },
    this.space,
  );
  private readonly hint = element(
    'p',
    { class: 'empty' },
    'A layer changes a take, and its own keys stay as they are: a wave over a walk, an arm of a capture. Add one, pose, and press K. ',
  );
  private readonly list: WindowedList<LayerRowView>;
  private readonly picks: RowSelection<LayerRow>;
  private readonly refreshing: (() => void)[] = [];
  private rows: readonly LayerRow[] = [];
  private weightEdit: HandEdit | undefined;
  private visible = false;
  private readonly showSoon = oncePerFrame(() => this.show());

  constructor(private readonly wb: Workbench) {
    this.hint.append(manualLink('More about layers', 'layers'));
    const head = element('div', { class: 'layers-head' }, this.title, this.tools());
    this.element = element(
      'section',
      { class: 'layers', 'aria-label': 'Layers', hidden: true },
      head,
      this.hint,
      this.grid,
    );
    this.picks = new RowSelection<LayerRow>({
      keyOf: ({ index }) => String(index),
      selectOnly: ({ index }) => edits.activate(wb, index),
    });
    this.list = new WindowedList({
      scroller: this.grid,
      space: this.space,
      rowHeight: ['--layer-row', 26],
      rowsAbove: 0,
      make: (index) => new LayerRowView(this.rows[index], this.rowEvents()),
      fill: (view, index) => this.rows[index] && view.show(this.rows[index], this.rows[index].isActive),
    });
    this.listen();
    wb.store.subscribe((now, before) => {
      if (now.document !== before.document || now.selection !== before.selection) this.showSoon();
    });
    wb.transport.subscribe((now, before) => {
      if (now.timeSeconds !== before.timeSeconds && this.rows.some((row) => row.isWeightKeyed)) this.showSoon();
    });
  }

  /** Whether there is a take that could have layers. */
  get isUseful(): boolean {
    const character = currentCharacter(this.wb);
    return character !== undefined && shownTake(character) !== undefined;
  }

  setVisible(visible: boolean): void {
    this.visible = visible;
    write(this.element, 'hidden', !visible);
    this.show();
  }

  private tools(): HTMLElement {
    const { wb } = this;
    const buttons = BUTTONS.map(([id, text]) => {
      const action = findAction(wb, id);
      const made = keepsFocusElsewhere(
        button(text, { class: 'tool text-tool' }, text, () => action && tryAction(wb, action)),
      );
      setActionTooltip(wb, made, id, text);
      this.refreshing.push(() => write(made, 'disabled', !(action && isEnabled(wb, action))));
      return made;
    });
    return toolbar(element('div', { class: 'tools', 'aria-label': 'Layers' }, ...buttons));
  }

  private rowEvents() {
    const { wb } = this;
    return {
      toggleMode: ({ index }: LayerRow) => edits.toggleMode(wb, index),
      toggle: ({ index }: LayerRow, what: 'mute' | 'solo') => edits.toggle(wb, what, index),
      previewWeight: ({ index }: LayerRow, weight: number) => {
        this.weightEdit ??= new HandEdit(wb.store, wb.messages);
        edits.previewWeight(wb, this.weightEdit, index, weight);
      },
      commitWeight: () => {
        this.weightEdit?.commit();
        this.weightEdit = undefined;
        // After Escape the slider is where it was let go.
        this.showSoon();
      },
      keyWeight: ({ index }: LayerRow) => edits.keyWeight(wb, index),
      maskMenu: (row: LayerRow) => this.maskMenu(row),
      rename: ({ index }: LayerRow, name: string) => edits.rename(wb, index, name),
      refuse: (reason: string) => wb.messages.note(reason, 'warning'),
    };
  }

  private listen(): void {
    const { grid, wb } = this;
    grid.addEventListener('click', (event) => {
      const row = this.rowAt(event);
      if (row) this.picks.pressed(row, event);
    });
    grid.addEventListener('dblclick', (event) => {
      const row = this.rowAt(event);
      if (row) this.rename(row.index);
    });
    grid.addEventListener('contextmenu', (event) => {
      if (event.target instanceof HTMLInputElement) return;
      event.preventDefault();
      this.menu(this.rows[this.list.indexOf(event)], { x: event.clientX, y: event.clientY });
    });
    grid.addEventListener('keydown', (event) => this.onKey(event));
    letRowsBeMoved({
      element: grid,
      space: this.space,
      indexOf: (event) => this.list.indexOf(event),
      move: (from, to) => edits.moveTo(wb, this.rows[from].index, this.rows[to].index),
      rowHeight: () => this.list.rowHeight,
      movable: () => this.rows.length - 1,
    });
  }

  private rowAt(event: Event): LayerRow | undefined {
    const isControl = event.target instanceof Element && event.target.closest('input,button') !== null;
    return isControl ? undefined : this.rows[this.list.indexOf(event)];
  }

  private onKey(event: KeyboardEvent): void {
    const { wb, grid } = this;
    if (event.target !== grid || event.isComposing) return;
    const up = event.key === 'ArrowUp' ? 1 : event.key === 'ArrowDown' ? -1 : 0;
    const active = this.rows.find((row) => row.isActive);
    if (asksForMenu(event)) this.menuByKey();
    else if (event.altKey && up) edits.move(wb, up);
    else if (event.key === 'F2' && active) this.rename(active.index);
    else if ((event.key === 'Delete' || event.key === 'Backspace') && active?.info) edits.remove(wb);
    else if (!this.picks.takesKey(event, this.list.page)) return;
    event.preventDefault();
    event.stopPropagation();
  }

  private rename(layer: number): void {
    const at = this.rows.findIndex((row) => row.index === layer);
    this.list.row(at)?.edit(() => this.grid.focus());
  }

  private menuByKey(): void {
    const active = this.rows.find((row) => row.isActive);
    const view = this.list.row(this.picks.place);
    const { left, bottom } = (view?.element ?? this.grid).getBoundingClientRect();
    this.menu(active, { x: left + 24, y: bottom, byKeyboard: true });
  }

  private menu(row: LayerRow | undefined, at: MenuPlace): void {
    const { wb } = this;
    if (row && !row.isActive) edits.activate(wb, row.index);
    const item = (label: string, run: () => void): MenuEntry => ({ kind: 'item', label, enabled: true, run });
    const own: MenuEntry[] = row?.info
      ? [
          item('Rename', () => this.rename(row.index)),
          row.isWeightKeyed
            ? item('Same weight at all times', () => edits.unkeyWeight(wb, row.index))
            : item('Key weight', () => edits.keyWeight(wb, row.index)),
          { kind: 'line' },
        ]
      : [];
    openMenu(at, [...own, ...sectionsOf(wb, MENU)], { label: row?.name ?? 'Layers', opener: this.grid });
  }

  private maskMenu(row: LayerRow): MenuEntry[] {
    const { wb } = this;
    const { index, info } = row;
    const character = currentCharacter(wb);
    const joints = character ? selectedJointsOf(wb, character.id) : [];
    const part = (label: string, what: 'root' | 'morphs'): MenuEntry => ({
      ...{ kind: 'item', label, enabled: info?.joints !== undefined, checked: !info?.joints || info[what] },
      run: () => edits.toggleTouched(wb, index, what),
    });
    return [
      {
        ...{ kind: 'item', label: 'Everything', enabled: true, checked: info?.joints === undefined },
        run: () => edits.unmask(wb, index),
      },
      {
        kind: 'item',
        label: joints.length > 0 ? `Only ${plural(joints.length, 'selected joint')}` : 'Only the selected joints',
        enabled: joints.length > 0,
        refuse: () => wb.messages.note('Select joints first.'),
        run: () => edits.mask(wb, index),
      },
      { kind: 'line' },
      part('Root translation', 'root'),
      part('Morphs', 'morphs'),
    ];
  }

  private show(): void {
    if (!this.visible) return;
    const character = currentCharacter(this.wb);
    const take = character && shownTake(character);
    this.rows = character && take?.layers ? rowsOf(character, take, this.wb.transport.get().timeSeconds) : [];
    const { rows, grid } = this;
    for (const refresh of this.refreshing) refresh();
    setText(this.title, 'Layers');
    setAttribute(grid, 'aria-label', `Layers of ${take?.name ?? 'the take'}`);
    write(this.hint, 'hidden', rows.length > 0);
    write(grid, 'hidden', rows.length === 0);
    const active = rows.findIndex((row) => row.isActive);
    this.picks.show(rows);
    this.picks.focusedKey = rows[active] && String(rows[active].index);
    this.list.show(rows.length);
    this.list.focus(active);
  }
}

/** From the topmost layer down to the base. */
function rowsOf(character: Character, take: Take, timeSeconds: number): readonly LayerRow[] {
  const { list, active = -1, baseFile } = take.layers ?? { list: [] };
  const counting = new Set(countingLayers(list));
  const infos = edits.layersNow(character, timeSeconds);
  const layers = infos.map((info, index): LayerRow => {
    const [mask, maskText] = maskOf(info);
    const isWeightKeyed = typeof list[index].weight !== 'number';
    const state = { isActive: index === active, isSilent: !counting.has(index), isWeightKeyed };
    return { index, info, name: info.name, ...state, mask, maskText };
  });
  const base: LayerRow = {
    ...{ index: -1, name: `Base: ${baseFile ?? take.name}`, isActive: active < 0 },
    ...{ isSilent: false, isWeightKeyed: false, mask: '', maskText: '' },
  };
  return [...layers.toReversed(), base];
}

/** Joints that are named in a tooltip. */
const NAMED_JOINTS = 6;

/** What a layer touches, for its button; and in full. */
function maskOf({ joints, root, morphs }: LayerInfo): readonly [short: string, full: string] {
  if (!joints) return ['All', 'everything'];
  const parts = [...(root ? ['root'] : []), ...(morphs ? ['morphs'] : [])];
  const [name] = joints;
  const short = joints.length === 1 ? name : plural(joints.length, 'joint');
  const names = joints.slice(0, NAMED_JOINTS).join(', ');
  const full = joints.length > NAMED_JOINTS ? `${names} and ${joints.length - NAMED_JOINTS} more` : names;
  const isBare = joints.length === 0;
  return [
    isBare ? parts.join(', ') || 'Nothing' : short,
    [...(isBare ? [] : [full]), ...parts].join(', ') || 'nothing',
  ];
}
