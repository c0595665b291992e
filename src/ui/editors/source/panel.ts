/**
 * The tab *Source*: the text of an open file with line numbers. What is selected lights up its lines; a click on a line
 * selects what it holds. Once the page has changed something that is saved in the file, the text is that with the
 * changes, which are marked.
 *
 *     arrows, Page Up, Page Down, Home, End   to another line       Enter    selects what it holds, shows what it was
 *     Ctrl+G                                  the number of a line  Ctrl+F   a text
 *     F7, Shift+F7                            to another change
 *
 * The text can also be edited (`editing.ts`).
 */
import type { Diagnostic } from '../../../model/diagnostic.ts';
import { baseName } from '../../../model/files.ts';
import {
  type LineRange,
  lastUpTo,
  linesOf,
  type SourceMap,
  type SourceTarget,
  targetAt,
} from '../../../model/source-map.ts';
import { lineNow } from '../../../model/text-changes.ts';
import { element, setText } from '../../kit/dom.ts';
import { focusPanel } from '../../kit/focus.ts';
import { oncePerFrame } from '../../kit/frame.ts';
import { count, plural } from '../../kit/number-text.ts';
import type { TimelineTab } from '../../state/timeline.ts';
import type { Uses } from '../../state/workbench.ts';
import { frameThen, type Known, type Origins, originsIn, pickNow, targetsThen } from './as-opened.ts';
import { changeBar, changesInWords } from './change-bar.ts';
import { ChangedRows } from './changed-rows.ts';
import { Editing } from './editing.ts';
import { findLine } from './find-text.ts';
import type { ShownLine } from './line-text.ts';
import { LineView, type ShownRow } from './line-view.ts';
import { OpenedSource } from './opened-source.ts';
import { partsFrom, sourcesOf } from './places.ts';
import { worstFirst } from './problems.ts';
import { type ChangedText, TextChanges } from './text-changes.ts';
import { type SourceTools, sourceTools } from './tools.ts';

type Parts = Uses<'store' | 'timeline' | 'files' | 'messages' | 'posing' | 'transport'>;

const NO_LINES: readonly LineRange[] = [];
const NO_ROWS = new ChangedRows(0, [], new Set());

/** A text in view: the file as it came, or with the changes. */
interface ShownText {
  readonly map: SourceMap | undefined;
  readonly text: Blob | undefined;
  readonly count: number;
  line(line: number): ShownLine | undefined;
}

export function sourcePanel(wb: Parts): TimelineTab {
  return new SourcePanel(wb);
}

class SourcePanel implements TimelineTab {
  readonly element: HTMLElement;
  readonly tools: HTMLElement;
  private readonly view: LineView;
  private readonly controls: SourceTools;
  private readonly empty = element('p', { class: 'empty source-empty', hidden: true });
  /** That the text isn't what is in the page, or what of it was changed there. */
  private readonly bar = changeBar({
    goTo: (step) => this.goToChange(step),
    toggle: () => this.showChanges(!this.showsChanges),
  });
  private readonly changes: TextChanges;
  private readonly editing: Editing;
  private showsChanges = true;
  private rows = NO_ROWS;
  /** Changes whose old lines are shown. */
  private readonly open: Set<number> = new Set();
  private visible = false;
  private opened: OpenedSource | undefined;
  private lit: readonly LineRange[] = NO_LINES;
  private litStarts: readonly number[] = [];
  private now: number | undefined;
  private problems: ReadonlyMap<number, Diagnostic> = new Map();
  /** A line to be shown once it is read. */
  private wanted: number | undefined;
  /** What was clicked here is in view already. */
  private isOwnPick = false;
  private status = '';
  private readonly known: Known;
  private search: AbortController | undefined;
  private readonly followSoon = oncePerFrame(() => this.follow());

  constructor(private readonly wb: Parts) {
    const { source, unsaved } = wb.files;
    this.known = {
      opened: (file) => source.opened(file),
      given: (path) => source.given(path),
      isUnsaved: (id, path) =>
        unsaved.get().some(({ characterId, name }) => characterId === id && name === baseName(path)),
    };
    this.changes = new TextChanges(source, {
      onChange: () => this.changed(),
      onText: () => this.view.drawSoon(),
      inView: () => this.view.inView,
    });
    this.editing = new Editing(wb, {
      edits: () => this.changes.edits(),
      onChange: () => this.showEditing(),
      say: (text) => this.say(text),
    });
    this.view = new LineView({ row: (row) => this.row(row), pick: (row) => this.pickRow(row) });
    this.controls = sourceTools({
      choose: (path) => this.openFile(path),
      find: (text) => void this.find(text),
      goTo: (line) => this.goTo(line),
      edit: () => this.edit(),
      leave: () => focusPanel(this.element),
    });
    this.tools = this.controls.element;
    this.element = element(
      'div',
      { class: 'source', 'data-panel': 'source' },
      this.bar.element,
      this.empty,
      this.view.element,
      this.editing.element,
    );
    this.element.addEventListener('keydown', (event) => this.onKey(event));
    const { store, timeline, posing, transport, messages } = wb;
    store.subscribe((now, before) => {
      if (now.document === before.document && now.selection === before.selection) return;
      this.followSoon();
    });
    posing.chosenDof.subscribe(this.followSoon);
    unsaved.subscribe(this.followSoon);
    transport.subscribe((now, before) => {
      if (now.timeSeconds !== before.timeSeconds) this.showTime();
    });
    messages.list.subscribe(() => {
      this.readProblems();
      this.followSoon();
    });
    timeline.sourceAsked.subscribe(() => this.showAsked());
  }

  setVisible(visible: boolean): void {
    if (visible === this.visible) return;
    this.visible = visible;
    if (!visible) {
      this.search?.abort();
      // What isn't read to the end is read again when it is shown.
      if (this.opened?.state.kind === 'reading') this.closeFile();
      return;
    }
    this.showAsked();
    this.follow();
    this.view.drawSoon();
  }

  // This tab shows no time to fit.
  fitAll(): void {}
  fitSelected(): void {}
  recolour(): void {}

  private showAsked(): void {
    const { timeline, files } = this.wb;
    const place = timeline.sourceAsked.get();
    if (!this.visible || !place) return;
    timeline.sourceAsked.set(undefined);
    const path =
      files.source.pathOf(place.file) ?? this.paths().find((p) => baseName(p) === place.file) ?? this.opened?.path;
    if (path === undefined || baseName(path) !== place.file) {
      this.say(`The text of ${place.file} is no longer at hand. Open it again.`);
      return;
    }
    this.openFile(path, place.line);
    // A message opened the file to be looked at here.
    focusPanel(this.view.element);
  }

  private paths(): readonly string[] {
    const { store, files } = this.wb;
    return sourcesOf(store.document, store.selection.characterId)
      .filter(({ name }) => files.source.isText(name))
      .map(({ path }) => path);
  }

  private openFile(path: string, line?: number): void {
    this.wanted = line;
    // A file that was given again under its path is another one.
    this.closeFile();
    const opened = new OpenedSource(path, this.wb.files.source, {
      onLines: () => {
        if (this.opened === opened) this.showLines();
      },
      onText: () => this.view.drawSoon(),
      onState: () => {
        if (this.opened === opened) this.showState();
      },
    });
    this.opened = opened;
    this.showRows(true);
    this.status = '';
    this.readProblems();
    this.showFiles();
    this.showState();
    void opened.read();
  }

  private closeFile(): void {
    this.editing.end();
    this.opened?.close();
    this.opened = undefined;
    this.changes.follow(undefined, [], false);
    this.search?.abort();
    this.light(NO_LINES);
    this.now = undefined;
  }

  private showLines(): void {
    const { opened, view, wanted } = this;
    if (!opened) return;
    this.showRows();
    if (opened.map) this.follow(wanted === undefined);
    if (wanted === undefined || (wanted > opened.count && !opened.map)) return;
    const line = this.hunks.length > 0 ? (lineNow(this.hunks, wanted) ?? wanted) : wanted;
    view.goTo(this.rows.rowOf(line));
    if (opened.map) this.wanted = undefined;
  }

  /** The text with the changes, if it is shown. */
  private get changedText(): ChangedText | undefined {
    return this.showsChanges ? this.changes.text : undefined;
  }

  private get shown(): ShownText | undefined {
    return this.changedText ?? this.opened;
  }

  private get hunks(): ChangedText['hunks'] {
    return this.changedText?.hunks ?? [];
  }

  private showRows(isNewFile = false): void {
    this.rows = new ChangedRows(this.shown?.count ?? 0, this.hunks, this.open);
    this.view.setLines(this.rows.count, isNewFile);
  }

  private showChanges(shows: boolean): void {
    this.showsChanges = shows;
    if (shows) this.follow(false);
    this.changed();
  }

  private edit(): void {
    const { opened, editing } = this;
    if (editing.path !== undefined) {
      editing.leave();
      return;
    }
    const { state } = this.originsInFile();
    const why = editing.whyNot(opened, state, this.hasErrors);
    if (why !== undefined || !opened) this.say(why ?? '');
    else void editing.begin(opened, !this.hasErrors);
  }

  private get hasErrors(): boolean {
    return [...this.problems.values()].some(({ severity }) => severity === 'error');
  }

  /** What was opened from the file, whatever text is shown. */
  private originsInFile(): Origins {
    const { opened, wb } = this;
    return opened ? originsIn(wb.store.document, opened.path, this.known) : { state: 'same', origins: [] };
  }

  private showEditing(): void {
    this.status = '';
    this.showState();
    this.showNote();
    this.view.drawSoon();
    // A text that was corrected is another one now.
    this.followSoon();
    if (this.editing.path === undefined && this.visible) focusPanel(this.view.element);
  }

  /** There are other changes. */
  private changed(): void {
    this.open.clear();
    this.readProblems();
    this.showRows();
    this.follow(false);
    this.showState();
  }

  private goToChange(step: 1 | -1): void {
    const hunk = this.rows.hunkFrom(this.view.current, step);
    if (hunk === undefined) return;
    this.view.goTo(this.rows.rowOfHunk(hunk));
    this.say(`Change ${count(hunk + 1)} of ${count(this.hunks.length)}`);
    focusPanel(this.view.element);
  }

  private row(row: number): ShownRow {
    const found = this.rows.at(row);
    if (found.kind === 'line') {
      const { line, change } = found;
      const problem = this.problems.get(line);
      return {
        line,
        change,
        text: this.shown?.line(line),
        isLit: isIn(this.lit, this.litStarts, line),
        isNow: line === this.now,
        problem: problem && { severity: problem.severity, text: problem.message },
      };
    }
    const plain = { isLit: false, isNow: false };
    if (found.kind === 'old') return { ...plain, text: this.opened?.line(found.line), change: 'old' };
    const text = `${plural(found.count, 'line')} removed`;
    return { ...plain, text: { text, more: 0, isAbout: false }, change: 'removed' };
  }

  private pickRow(row: number): void {
    const found = this.rows.at(row);
    if (found.hunk !== undefined && this.hunks[found.hunk].oldFrom < this.hunks[found.hunk].oldTo) {
      const line = found.kind === 'line' ? found.line : undefined;
      if (!this.open.delete(found.hunk)) this.open.add(found.hunk);
      this.showRows();
      this.view.goTo(line === undefined ? this.rows.rowOfHunk(found.hunk) : this.rows.rowOf(line));
    }
    if (found.kind === 'line') this.pick(found.line);
  }

  private showState(): void {
    const { opened } = this;
    const state = opened?.state;
    const failed = state?.kind === 'failed' ? `${baseName(opened?.path ?? '')} can’t be shown. ${state.message}` : '';
    const isEdited = this.editing.path !== undefined;
    this.empty.hidden = isEdited || (opened !== undefined && !failed);
    this.view.element.hidden = isEdited || !this.empty.hidden;
    setText(this.empty, failed || 'Open a file to see its text, with line numbers.');
    if (state?.kind === 'reading') this.controls.say(`Reading ${Math.round(100 * state.share)} %`);
    else this.controls.say(this.status || (this.shown?.map ? plural(this.shown.count, 'line') : ''));
  }

  private say(text: string): void {
    this.status = text;
    this.showState();
  }

  private showFiles(): void {
    const paths = this.paths();
    const own = this.opened?.path;
    this.controls.showFiles(own === undefined || paths.includes(own) ? paths : [own, ...paths], own);
  }

  /** The lines of what is selected; the file that has it, if this one has nothing of it. */
  private follow(reveals = true): void {
    if (!this.visible) return;
    if (this.opened?.isOld && this.editing.path === undefined) {
      this.openFile(this.opened.path, this.view.current);
      return;
    }
    const { store, posing } = this.wb;
    const { document, selection } = store;
    const paths = this.paths();
    this.showFiles();
    const chosen = posing.chosenDof.get();
    const targetsIn = (path: string) =>
      originsIn(document, path, this.known).origins.flatMap((origin) => targetsThen(origin, selection, chosen));
    const own = this.originsHere().origins.flatMap((origin) => targetsThen(origin, selection, chosen));
    const isOwnPick = this.isOwnPick;
    this.isOwnPick = false;
    const isEdited = this.editing.path !== undefined;
    if (isEdited) void this.editing.follow(this.opened);
    if (!isEdited && own.length === 0 && !isOwnPick && this.wanted === undefined && this.isAnewSelected()) {
      const other = paths.find((path) => targetsIn(path).length > 0) ?? (this.opened ? undefined : paths[0]);
      if (other !== undefined && other !== this.opened?.path) {
        this.openFile(other);
        return;
      }
    }
    this.showTime();
    this.showNote();
    if (!this.opened) {
      this.showState();
      return;
    }
    this.lightTargets(own, reveals && !isOwnPick);
  }

  /** A selection is followed to another file once: the file that is chosen afterwards stays. */
  private seen: unknown;
  private isAnewSelected(): boolean {
    const { selection } = this.wb.store;
    const isNew = this.seen !== selection;
    this.seen = selection;
    return isNew || !this.opened;
  }

  private lightTargets(targets: readonly SourceTarget[], reveals: boolean): void {
    const map = this.shown?.map;
    if (!map) return;
    const before = this.lit;
    const all = targets.flatMap((target) => linesOf(map, target));
    const ascending = [...all].sort((a, b) => a.from - b.from);
    this.light(ascending);
    const isSame = before.length === ascending.length && before.every((l, i) => l.from === ascending[i].from);
    if (!reveals || isSame || all.length === 0) return;
    const [{ from, to }] = all;
    this.view.reveal({ from: this.rows.rowOf(from), to: this.rows.rowOf(to) });
  }

  private light(lines: readonly LineRange[]): void {
    this.lit = lines;
    this.litStarts = lines.map(({ from }) => from);
    this.view.drawSoon();
  }

  private originsHere(): Origins {
    const { opened, wb } = this;
    if (!opened || !this.changedText) return this.originsInFile();
    // The text is what is in the page.
    const parts = partsFrom(wb.store.document, opened.path);
    return { state: 'edited', origins: parts.map((now) => ({ now, file: now })) };
  }

  private showNote(): void {
    const { opened, changes, showsChanges, bar } = this;
    const { state, origins } = this.originsInFile();
    const isFollowed = state === 'edited' && showsChanges;
    changes.follow(
      opened?.path,
      origins.map(({ now }) => now.character),
      isFollowed,
    );
    this.controls.showEditing(this.editing.path !== undefined, this.editing.whyNot(opened, state, this.hasErrors));
    // The field says itself what is edited.
    if (this.editing.path !== undefined) {
      bar.show('');
      return;
    }
    if (opened && this.editing.hasDraft(opened.path)) {
      bar.show('Edits of this text were not applied. Edit shows them again.');
      return;
    }
    if (state !== 'edited') {
      bar.show(state === 'other' ? otherNote(this.hasErrors) : '');
      return;
    }
    const { text, problem, isComparing } = changes;
    if (!showsChanges) bar.show(`Edited since it was opened: ${AS_IT_CAME}`, false);
    else if (text)
      bar.show(`${changesInWords(text.hunks)} since it was opened. Click one to see what it was.`, true, true);
    else if (problem !== undefined && !isComparing) bar.show(`${problem} ${capital(AS_IT_CAME)}`);
    else bar.show('Edited since it was opened. Comparing…', true);
  }

  /** The frame of the current time, of a capture. */
  private showTime(): void {
    const map = this.shown?.map;
    if (!this.visible || !map) return;
    if (!map.rows.some(({ of }) => of === 'frame')) {
      this.now = undefined;
      return;
    }
    const origin = this.originsHere().origins.find(({ file }) => file.hasClip);
    const frame = origin && frameThen(origin, this.wb.transport.get().timeSeconds);
    const line = frame && linesOf(map, frame)[0]?.from;
    if (line === this.now) return;
    this.now = line;
    this.view.drawSoon();
  }

  private readProblems(): void {
    const name = this.opened && baseName(this.opened.path);
    const all = this.wb.messages.list.get().flatMap(({ diagnostics }) => diagnostics);
    const inFile = all.filter(({ file, line }) => file === name && line > 0);
    const { hunks } = this;
    const shown = inFile.flatMap((found) => {
      const line = lineNow(hunks, found.line);
      return line === undefined ? [] : [{ ...found, line }];
    });
    this.problems = worstFirst(shown);
    this.view.drawSoon();
  }

  private pick(line: number): void {
    const map = this.shown?.map;
    if (!map) return;
    const target = targetAt(map, line);
    const picked = target && pickNow(this.originsHere().origins, target);
    if (picked && 'gone' in picked) {
      this.say(`Line ${count(line)} was ${picked.gone}, which was changed or deleted.`);
      return;
    }
    if (!picked) {
      this.say(target ? `Line ${count(line)} holds nothing that is shown.` : `Line ${count(line)} holds no part.`);
      return;
    }
    const { store, posing, transport } = this.wb;
    const { selection, dof, timeSeconds } = picked;
    this.isOwnPick = true;
    store.select(selection);
    if (dof) posing.chosenDof.set(dof);
    if (timeSeconds !== undefined) transport.update((now) => ({ ...now, timeSeconds, playing: false }));
    this.say(picked.text);
    this.followSoon();
  }

  private goTo(line: number): void {
    const { shown, rows, editing } = this;
    if (!shown) return;
    if (editing.path !== undefined) {
      editing.goTo(line);
      return;
    }
    if (line > shown.count) this.say(`The last line is ${count(shown.count)}.`);
    this.view.goTo(rows.rowOf(Math.min(line, shown.count)));
    focusPanel(this.view.element);
  }

  private async find(text: string): Promise<void> {
    const { shown } = this;
    if (!shown?.map || !shown.text || text === '') return;
    if (this.editing.path !== undefined) {
      this.say(this.editing.find(text) ? `Found “${text}”` : `“${text}” was not found.`);
      return;
    }
    this.search?.abort();
    const search = new AbortController();
    this.search = search;
    try {
      const line = await findLine(shown.text, shown.map.index, text, this.currentLine, search.signal);
      if (search.signal.aborted) return;
      if (line === undefined) this.say(`“${text}” was not found.`);
      else {
        this.view.goTo(this.rows.rowOf(line));
        this.say(`Found on line ${count(line)}`);
      }
    } catch (error) {
      if (!search.signal.aborted) this.say(`The file can’t be searched: ${String(error)}`);
    }
  }

  /** The line of the current row, or the one above it. */
  private get currentLine(): number {
    for (let row = this.view.current; row > 0; row--) {
      const found = this.rows.at(row);
      if (found.kind === 'line') return found.line;
    }
    return 1;
  }

  private onKey(event: KeyboardEvent): void {
    if (event.key === 'F7' && this.hunks.length > 0 && this.editing.path === undefined) {
      event.preventDefault();
      event.stopPropagation();
      this.goToChange(event.shiftKey ? -1 : 1);
      return;
    }
    if (!(event.ctrlKey || event.metaKey) || event.altKey || event.shiftKey) return;
    const key = event.key.toLowerCase();
    if (key === 'g') this.controls.askLine();
    else if (key === 'f') this.controls.askText();
    else return;
    event.preventDefault();
    event.stopPropagation();
  }
}

const AS_IT_CAME = 'lines are those of the file as it came.';

function otherNote(hasErrors: boolean): string {
  const why = hasErrors ? 'This text has errors and was not opened' : 'This text is not the version that is open';
  const how = hasErrors ? ' Edit corrects it here.' : '';
  return `${why}. The page has another version, so nothing lights up.${how}`;
}

const capital = (text: string) => text[0].toUpperCase() + text.slice(1);

/** @param starts of the ranges, which ascend */
function isIn(ranges: readonly LineRange[], starts: readonly number[], line: number): boolean {
  if (ranges.length === 0 || line < starts[0]) return false;
  return line <= ranges[lastUpTo(starts, line)].to;
}
