/**
 * The dope sheet: the timing of all keys of a character at a glance. Names and counts of the rows to the left, their
 * keys on canvases to the right; both follow the document, the selection and the timeline's view, and redraw once a
 * frame what has changed, only while visible.
 */

import { keyCount, selectedCount, spanOf } from '../../../edit/keys/row-keys.ts';
import { allKeys, NO_KEY_SELECTION, unionKeys } from '../../../edit/keys/selection.ts';
import { withSelectedKeys } from '../../../edit/store.ts';
import { compileChannels, compileTake } from '../../../evaluate/compiled-take.ts';
import { NOTHING_SELECTED } from '../../../model/session.ts';
import { withPart } from '../../../model/skeleton/joint-selection.ts';
import { jointsIn, partOf } from '../../../model/skeleton/selected-joints.ts';
import { motionsOf } from '../../../model/takes/layers.ts';
import type { Motion, Take } from '../../../model/takes/take.ts';
import type { TimelineTab } from '../../state/timeline.ts';
import type { Uses } from '../../state/workbench.ts';
import { element, setAttribute, setText, write } from '../../widgets/dom.ts';
import { HAS_KEYS } from '../../widgets/focus/focus.ts';
import { oncePerFrame } from '../../widgets/frame.ts';
import { panWindow, type TimeWindow, zoomWindow } from '../../widgets/time/time-window.ts';
import { selectedKeys, selectedKeysInView, selectKeys } from '../timeline/current-take.ts';
import { allFolds, type DopeRow, leadingJoint, sameRows } from '../timeline/dope-rows.ts';
import { selectedText } from '../timeline/key-edits.ts';
import { rowsOfAll } from '../timeline/rows-of-all.ts';
import {
  changeChannelView,
  channelViewOf,
  keysOfPart,
  type TimelinePart,
  type TimelineTake,
  timelineTake,
} from '../timeline/timeline-take.ts';
import { emptyText } from './empty-text.ts';
import type { SheetKeys } from './hit.ts';
import { rowMenu, sheetMenu } from './menus.ts';
import { DopeNames } from './names.ts';
import { DopePicture } from './picture.ts';
import { SheetPointer, type SheetPointerHost } from './pointer.ts';
import type { AttachedSpan, DopeScene } from './scene.ts';
import type { Sheet } from './sheet.ts';
import { dopeFilter, dopeTools } from './tools.ts';

export function dopePanel(
  wb: Uses<'store' | 'actions' | 'transport' | 'timeline' | 'settings' | 'messages'>,
): TimelineTab {
  return new DopePanel(wb);
}

const NO_CURVES = compileChannels([]);
/** Window around a single time. */
const AROUND_SECONDS = 0.5;

class DopePanel implements TimelineTab, SheetPointerHost {
  readonly element: HTMLElement;
  readonly tools: HTMLElement;
  readonly names: HTMLElement;
  private readonly rowNames: DopeNames;
  private readonly picture = new DopePicture();
  private readonly plot = element('div', {
    class: 'dope-sheet',
    role: 'application',
    tabindex: 0,
    [HAS_KEYS]: true,
    'aria-roledescription': 'dope sheet',
  });
  private readonly empty = element('p', { class: 'empty dope-empty', hidden: true });
  private readonly pointer: SheetPointer;
  private take: TimelineTake | undefined;
  private rows: readonly DopeRow[] = [];
  private visible = false;
  private size = { width: 0, height: 0 };
  private stale = true;
  private readonly drawSoon = oncePerFrame(() => this.draw());

  constructor(readonly wb: Uses<'store' | 'actions' | 'transport' | 'timeline' | 'settings' | 'messages'>) {
    this.rowNames = new DopeNames(
      {
        fold: (row, open, every) => this.fold(row, open, every),
        choose: (row) => this.choose(row),
        selectKeys: (row, adds) => this.selectRow(row, adds),
        menu: (row, at) => rowMenu(wb, row, at),
        scrolled: () => this.redraw(),
      },
      (row) => this.count(row),
    );
    this.plot.append(this.picture.element, this.empty);
    this.pointer = new SheetPointer(this.plot, this);
    this.tools = dopeTools(wb);
    this.names = dopeFilter(wb);
    const left = element('div', { class: 'dope-left' }, this.rowNames.element);
    this.element = element('div', { class: 'dope' }, left, this.plot);
    this.follow();
  }

  private follow(): void {
    const { wb } = this;
    wb.store.subscribe((now, before) => {
      if (!this.visible || (now.document === before.document && now.selection === before.selection)) return;
      this.refresh();
      const { joint, characterId } = now.selection;
      const isSame = joint === before.selection.joint && characterId === before.selection.characterId;
      if (joint !== undefined && !isSame) this.rowNames.reveal(now.selection);
    });
    wb.timeline.view.subscribe((now, before) => {
      if (!this.visible) return;
      const { unfolded, others, allRows, filter } = before;
      const isFolded = now.unfolded !== unfolded || now.others !== others;
      if (isFolded || now.allRows !== allRows || now.filter !== filter) this.refresh(true);
      this.redraw();
    });
    wb.transport.subscribe((now, before) => {
      if (!this.visible) return;
      if (now.framesPerSecond !== before.framesPerSecond || now.range !== before.range) this.redraw();
      this.drawSoon();
    });
    wb.settings.subscribe((now, before) => {
      if (now.timeDisplay !== before.timeDisplay) this.redraw();
    });
    new ResizeObserver(() => this.measure()).observe(this.plot);
  }

  // A tab of the timeline.

  setVisible(visible: boolean): void {
    if (visible === this.visible) return;
    this.visible = visible;
    if (visible) this.refresh(true);
  }

  fitAll(): void {
    const span = this.wholeSpan();
    if (span) this.wb.timeline.fit(span);
  }

  fitSelected(): void {
    const span = this.shown().selectedSpan ?? this.jointSpan();
    if (!span) this.fitAll();
    else if (span[1] > span[0]) this.wb.timeline.fit(span);
    else this.look({ from: span[0] - AROUND_SECONDS, to: span[0] + AROUND_SECONDS });
  }

  zoom(timeFactor: number): void {
    const { window } = this.wb.timeline.view.get();
    const { timeSeconds } = this.wb.transport.get();
    const span = this.shown().selectedSpan;
    const about = span ? (span[0] + span[1]) / 2 : timeSeconds;
    const inside = about >= window.from && about <= window.to;
    this.look(zoomWindow(window, inside ? about : (window.from + window.to) / 2, timeFactor));
  }

  pan(timePart: number, valuePart: number): void {
    const { window } = this.wb.timeline.view.get();
    if (timePart) this.look(panWindow(window, timePart * (window.to - window.from)));
    if (valuePart) this.scrollBy(-valuePart * this.size.height);
  }

  recolour(): void {
    this.picture.recolour();
    this.redraw();
  }

  // For gestures and pointer.

  sheet(): Sheet {
    const { window } = this.wb.timeline.view.get();
    const { rowHeight, scrollTop } = this.rowNames;
    return { ...this.size, window, rowHeight, rowCount: this.rows.length, scrollTop };
  }

  shown(): SheetKeys {
    const { take: current, rows } = this;
    const offsetSeconds = current?.character.timeOffsetSeconds ?? 0;
    const channels = current?.take.channels ?? [];
    const span = spanOf(channels, this.selected());
    const selectedSpan = span && ([span[0] - offsetSeconds, span[1] - offsetSeconds] as const);
    return { rows, channels, offsetSeconds, selectedSpan };
  }

  look(window: TimeWindow): void {
    this.wb.timeline.change({ window });
  }

  scrollBy(pixels: number): void {
    this.rowNames.scrollTo(this.rowNames.scrollTop + pixels);
  }

  menu(...[hit, at]: Parameters<SheetPointerHost['menu']>): void {
    sheetMenu(this.wb, this.rows, hit, at);
  }

  overlayChanged(): void {
    this.drawSoon();
  }

  // Rows.

  private selected() {
    return this.take ? selectedKeysInView(this.wb) : NO_KEY_SELECTION;
  }

  private count(row: DopeRow): { keys: number; selected: number } {
    const channels = this.take?.take.channels ?? [];
    return { keys: keyCount(channels, row.channels), selected: selectedCount(channels, row.channels, this.selected()) };
  }

  /** Rebuilds the rows if they have changed; always redraws. */
  private refresh(force = false): void {
    const before = this.take;
    this.take = timelineTake(this.wb);
    const { take: current } = this;
    if (force || !sameTakes(before, current)) {
      this.rows = current ? rowsOfAll(current, this.wb.timeline.view.get()) : [];
      this.rowNames.show(this.rows);
      const text = this.rows.length ? '' : emptyText(this.wb, current);
      setText(this.empty, text);
      write(this.empty, 'hidden', !text);
    }
    this.rowNames.refresh((row) => this.isSelected(row));
    this.redraw();
  }

  private isSelected({ joint, characterId = this.take?.character.id }: DopeRow): boolean {
    const part = partOf(this.wb.store.selection, characterId);
    return joint !== undefined && part !== undefined && jointsIn(part).includes(joint);
  }

  /** All keys and the take's range, seconds of the transport. */
  private wholeSpan(): readonly [number, number] | undefined {
    const { take: current } = this;
    if (!current) return undefined;
    const { channels, range } = current.take;
    const offset = current.character.timeOffsetSeconds;
    let [from, to] = range;
    for (const channel of channels) {
      if (channel.kind !== 'keys') continue;
      const { times } = channel;
      from = Math.min(from, times[0]);
      to = Math.max(to, times[times.length - 1]);
    }
    return [from - offset, to - offset];
  }

  private jointSpan(): readonly [number, number] | undefined {
    const { take: current } = this;
    if (!current) return undefined;
    const rows = this.rows.filter((row) => row.kind === 'joint' && this.isSelected(row));
    const channels = rows.flatMap((row) => row.channels);
    const span = channels.length ? spanOf(current.take.channels, allKeys(current.take, channels)) : undefined;
    const offset = current.character.timeOffsetSeconds;
    return span && [span[0] - offset, span[1] - offset];
  }

  private fold({ fold, characterId }: DopeRow, open: boolean, every: boolean): void {
    const { timeline } = this.wb;
    const part = this.take?.parts.find(({ character: { id } }) => id === (characterId ?? id));
    if (fold === undefined || !part) return;
    const { character, take } = part;
    const others = channelViewOf(timeline.view.get(), character.id).unfolded.filter((f) => f !== fold);
    const all = open ? allFolds(character, take) : [];
    changeChannelView(timeline, character.id, { unfolded: every ? all : open ? [...others, fold] : others });
  }

  /**
   * Selects the row's joint, of its character alone, and keeps the selected keys: one may be looking for the joint that
   * they belong to. Other characters stay selected, or their rows would go.
   */
  private choose({ joint, kind, characterId = this.take?.character.id }: DopeRow): void {
    const { take: current, wb } = this;
    const part = current?.parts.find(({ character: { id } }) => id === characterId);
    if (!part || (joint === undefined && kind !== 'character')) return;
    const { selection } = wb.store;
    const before = partOf(selection, characterId);
    const own = joint === undefined ? before : { characterId, joint };
    const from = before ? selection : NOTHING_SELECTED;
    wb.store.select(withPart(from, withSelectedKeys(own ?? { characterId }, keysOfPart(part, this.selected()))));
  }

  private selectRow(row: DopeRow, adds: boolean): void {
    const { take: current } = this;
    if (!current) return;
    const keys = allKeys(current.take, row.channels);
    selectKeys(this.wb, adds ? unionKeys(selectedKeys(this.wb), keys) : keys);
  }

  // Drawing.

  private measure(): void {
    this.size = { width: this.plot.clientWidth, height: this.plot.clientHeight };
    if (!this.size.width) return;
    this.redraw();
  }

  private redraw(): void {
    this.stale = true;
    this.drawSoon();
  }

  private draw(): void {
    if (!this.visible || !this.size.width) return;
    const scene = this.scene();
    if (this.stale) {
      this.picture.draw(scene);
      this.describe();
    }
    this.stale = false;
    const { timeSeconds } = this.wb.transport.get();
    this.picture.drawOverlay(scene, { timeSeconds, ...this.pointer.overlay });
  }

  private scene(): DopeScene {
    const { take: current } = this;
    const { framesPerSecond, range } = this.wb.transport.get();
    return {
      ...this.shown(),
      sheet: this.sheet(),
      curves: current ? compileTake(current.take) : NO_CURVES,
      others: current ? otherMotions(current.take) : [],
      attached: current?.parts.flatMap(attachedSpans) ?? [],
      selected: this.selected(),
      isSelected: (row) => this.isSelected(row),
      range,
      framesPerSecond,
      inFrames: this.wb.settings.get().timeDisplay === 'frames',
    };
  }

  private describe(): void {
    const { take: current } = this;
    const names = current?.parts.map(({ character }) => character.name).join(', ');
    const label = names === undefined ? 'Keys. No take.' : `Keys of ${names}. ${selectedText(this.wb)}`;
    setAttribute(this.plot, 'aria-label', label);
  }
}

function attachedSpans({ character, take }: TimelinePart): readonly AttachedSpan[] {
  const offset = character.timeOffsetSeconds;
  return (take.attached?.list ?? []).map((one) => ({
    characterId: character.id,
    ...{ from: one.span[0] - offset, to: one.span[1] - offset },
    label: leadingJoint(character, one),
  }));
}

/** What is below the active layer and above it. */
function otherMotions(take: Take): readonly Motion[] {
  return take.layers ? motionsOf(take).filter((_, i) => i - 1 !== take.layers?.active) : [];
}

/** Whether they have the same rows. */
function sameTakes(a: TimelineTake | undefined, b: TimelineTake | undefined): boolean {
  if (!a || !b || a.parts.length !== b.parts.length) return a === b;
  return a.parts.every((part, i) => sameTake(part, b.parts[i]));
}

function sameTake(a: TimelinePart, b: TimelinePart): boolean {
  return (
    a.first === b.first &&
    a.character.name === b.character.name &&
    a.character.timeOffsetSeconds === b.character.timeOffsetSeconds &&
    a.character.id === b.character.id &&
    a.character.skeleton === b.character.skeleton &&
    a.character.morphs === b.character.morphs &&
    a.character.limbs === b.character.limbs &&
    a.character.driver?.source.name === b.character.driver?.source.name &&
    sameRows(a.take, b.take)
  );
}
