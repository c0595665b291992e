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
import { baseName } from '../../../model/files.ts';
import { lineNow } from '../../../model/text-changes.ts';
import type { TimelineTab } from '../../state/timeline.ts';
import type { Uses } from '../../state/workbench.ts';
import { element, setText, write } from '../../widgets/dom.ts';
import { focusPanel } from '../../widgets/focus/focus.ts';
import { oncePerFrame } from '../../widgets/frame.ts';
import { count, plural } from '../../widgets/numbers/number-text.ts';
import { changeBar } from './change-bar.ts';
import { Editing } from './editing.ts';
import { findLine } from './find-text.ts';
import { MarkedLines } from './marked-lines.ts';
import { noteOf } from './note.ts';
import { OpenedSource } from './opened-source.ts';
import { sourcesOf } from './places.ts';
import { problemsIn } from './problems.ts';
import { SelectedLines } from './selected-lines.ts';
import { TextChanges } from './text-changes.ts';
import { TextInView } from './text-in-view.ts';
import { type SourceTools, sourceTools } from './tools.ts';

type Parts = Uses<'store' | 'timeline' | 'files' | 'messages' | 'posing' | 'transport'>;

export function sourcePanel(wb: Parts): TimelineTab {
  return new SourcePanel(wb);
}

class SourcePanel implements TimelineTab {
  readonly element: HTMLElement;
  readonly tools: HTMLElement;
  private readonly controls: SourceTools;
  private readonly empty = element('p', { class: 'empty source-empty', hidden: true });
  private readonly bar = changeBar({
    goTo: (step) => this.goToChange(step),
    toggle: () => this.showChanges(!this.text.showsChanges),
  });
  private readonly changes: TextChanges;
  private readonly text: TextInView;
  private readonly lines: MarkedLines;
  private readonly selected: SelectedLines;
  private readonly editing: Editing;
  private visible = false;
  /** A line to be shown once it is read. */
  private wanted: number | undefined;
  private status = '';
  private search: AbortController | undefined;
  private readonly followSoon = oncePerFrame(() => this.follow());

  constructor(private readonly wb: Parts) {
    const { store, timeline, files, posing, transport, messages } = wb;
    this.changes = new TextChanges(files.source, {
      onChange: () => this.changed(),
      onText: () => this.lines.drawSoon(),
      inView: () => this.lines.inView,
    });
    this.text = new TextInView(this.changes);
    this.lines = new MarkedLines(this.text, (line) => this.pick(line));
    this.selected = new SelectedLines(wb, this.text);
    this.editing = new Editing(wb, {
      edits: () => this.changes.edits(),
      onChange: () => this.showEditing(),
      say: (text) => this.say(text),
    });
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
      this.lines.element,
      this.editing.element,
    );
    this.element.addEventListener('keydown', (event) => this.onKey(event));
    store.subscribe((now, before) => {
      if (now.document === before.document && now.selection === before.selection) return;
      this.followSoon();
    });
    posing.chosenDof.subscribe(this.followSoon);
    files.unsaved.subscribe(this.followSoon);
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
      if (this.text.opened?.state.kind === 'reading') this.closeFile();
      return;
    }
    this.showAsked();
    this.follow();
    this.lines.drawSoon();
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
      files.source.pathOf(place.file) ?? this.paths().find((p) => baseName(p) === place.file) ?? this.text.opened?.path;
    if (path === undefined || baseName(path) !== place.file) {
      this.say(`The text of ${place.file} is no longer available. Open it again.`);
      return;
    }
    this.openFile(path, place.line);
    // A message opened the file to be looked at here.
    focusPanel(this.lines.element);
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
        if (this.text.opened === opened) this.showLines();
      },
      onText: () => this.lines.drawSoon(),
      onState: () => {
        if (this.text.opened === opened) this.showState();
      },
    });
    this.text.opened = opened;
    this.lines.show(true);
    this.status = '';
    this.readProblems();
    this.showFiles();
    this.showState();
    void opened.read();
  }

  private closeFile(): void {
    this.editing.end();
    this.text.opened?.close();
    this.text.opened = undefined;
    this.changes.follow(undefined, [], false);
    this.search?.abort();
    this.lines.unmark();
  }

  private showLines(): void {
    const { text, lines, wanted } = this;
    const { opened } = text;
    if (!opened) return;
    lines.show();
    if (opened.map) this.follow(wanted === undefined);
    if (wanted === undefined || (wanted > opened.count && !opened.map)) return;
    lines.goTo(lineNow(text.hunks, wanted) ?? wanted);
    if (opened.map) this.wanted = undefined;
  }

  private showState(): void {
    const { opened, shown } = this.text;
    const state = opened?.state;
    const failed = state?.kind === 'failed' ? `${baseName(opened?.path ?? '')} can’t be shown. ${state.message}` : '';
    const isEdited = this.editing.path !== undefined;
    write(this.empty, 'hidden', isEdited || (opened !== undefined && !failed));
    write(this.lines.element, 'hidden', isEdited || !this.empty.hidden);
    setText(this.empty, failed || 'Open a file to see its text, with line numbers.');
    if (state?.kind === 'reading') this.controls.say(`Reading ${Math.round(100 * state.share)} %`);
    else this.controls.say(this.status || (shown?.map ? plural(shown.count, 'line') : ''));
  }

  private say(text: string): void {
    this.status = text;
    this.showState();
  }

  private showFiles(): void {
    const paths = this.paths();
    const own = this.text.opened?.path;
    this.controls.showFiles(own === undefined || paths.includes(own) ? paths : [own, ...paths], own);
  }

  /** The lines of what is selected; the file that has it, if this one has nothing of it. */
  private follow(reveals = true): void {
    if (!this.visible) return;
    const { text, lines, selected, editing } = this;
    const { opened } = text;
    const isEdited = editing.path !== undefined;
    if (opened?.isOld && !isEdited) {
      this.openFile(opened.path, lines.currentLine);
      return;
    }
    this.showFiles();
    const own = selected.targets;
    const isOwnPick = selected.takeOwnPick();
    if (isEdited) void editing.follow(opened);
    else if (own.length === 0 && !isOwnPick && this.wanted === undefined && (selected.isAnew() || !opened)) {
      // A selection is followed to another file once: the file that is chosen afterwards stays.
      const paths = this.paths();
      const other = paths.find((path) => selected.hasSelected(path)) ?? (opened ? undefined : paths[0]);
      if (other !== undefined && other !== opened?.path) {
        this.openFile(other);
        return;
      }
    }
    this.showTime();
    this.showNote();
    if (opened) lines.light(own, reveals && !isOwnPick);
    else this.showState();
  }

  /** The frame of the current time, of a capture. */
  private showTime(): void {
    if (this.visible) this.lines.markNow(this.selected.frameLine);
  }

  private showNote(): void {
    const { text, lines, editing, changes, selected, bar } = this;
    const { opened, showsChanges } = text;
    const { hasErrors } = lines;
    const { state, origins } = selected.inFile;
    const characters = origins.map(({ now }) => now.character);
    changes.follow(opened?.path, characters, state === 'edited' && showsChanges);
    const isEdited = editing.path !== undefined;
    this.controls.showEditing(isEdited, editing.whyNot(opened, state, hasErrors));
    const hasDraft = opened !== undefined && editing.hasDraft(opened.path);
    const note = noteOf({ state, isEdited, hasDraft, hasErrors, showsChanges, changes });
    bar.show(note.text, note.isOn, note.hasSteps);
  }

  private readProblems(): void {
    const { opened, hunks } = this.text;
    const all = this.wb.messages.list.get().flatMap(({ diagnostics }) => diagnostics);
    this.lines.markProblems(problemsIn(all, opened && baseName(opened.path), hunks));
  }

  private showChanges(shows: boolean): void {
    this.text.showsChanges = shows;
    if (shows) this.follow(false);
    this.changed();
  }

  /** There are other changes. */
  private changed(): void {
    this.lines.closeChanges();
    this.readProblems();
    this.lines.show();
    this.follow(false);
    this.showState();
  }

  private goToChange(step: 1 | -1): void {
    const hunk = this.lines.goToChange(step);
    if (hunk === undefined) return;
    this.say(`Change ${count(hunk + 1)} of ${count(this.text.hunks.length)}`);
    focusPanel(this.lines.element);
  }

  private edit(): void {
    const { editing, selected } = this;
    const { opened } = this.text;
    const { hasErrors } = this.lines;
    if (editing.path !== undefined) {
      editing.leave();
      return;
    }
    const why = editing.whyNot(opened, selected.inFile.state, hasErrors);
    if (why !== undefined || !opened) this.say(why ?? '');
    else void editing.begin(opened, !hasErrors);
  }

  private showEditing(): void {
    this.status = '';
    this.showState();
    this.showNote();
    this.lines.drawSoon();
    // A text that was corrected is another one now.
    this.followSoon();
    if (this.editing.path === undefined && this.visible) focusPanel(this.lines.element);
  }

  private pick(line: number): void {
    const found = this.selected.pick(line);
    if (!found) return;
    this.say(found.text);
    if (found.isPicked) this.followSoon();
  }

  private goTo(line: number): void {
    const { lines, editing } = this;
    const { shown } = this.text;
    if (!shown) return;
    if (editing.path !== undefined) {
      editing.goTo(line);
      return;
    }
    if (line > shown.count) this.say(`The last line is ${count(shown.count)}.`);
    lines.goTo(Math.min(line, shown.count));
    focusPanel(lines.element);
  }

  private async find(text: string): Promise<void> {
    const { shown } = this.text;
    if (!shown?.map || !shown.text || text === '') return;
    if (this.editing.path !== undefined) {
      this.say(this.editing.find(text) ? `Found “${text}”` : `“${text}” was not found.`);
      return;
    }
    this.search?.abort();
    const search = new AbortController();
    this.search = search;
    try {
      const line = await findLine(shown.text, shown.map.index, text, this.lines.currentLine, search.signal);
      if (search.signal.aborted) return;
      if (line === undefined) this.say(`“${text}” was not found.`);
      else {
        this.lines.goTo(line);
        this.say(`Found on line ${count(line)}`);
      }
    } catch (error) {
      if (!search.signal.aborted) this.say(`The file can’t be searched: ${String(error)}`);
    }
  }

  private onKey(event: KeyboardEvent): void {
    if (event.key === 'F7' && this.text.hunks.length > 0 && this.editing.path === undefined) {
      event.preventDefault();
      event.stopPropagation();
      this.goToChange(event.shiftKey ? -1 : 1);
      return;
    }
    if (event.defaultPrevented || !(event.ctrlKey || event.metaKey) || event.altKey || event.shiftKey) return;
    const isEdited = this.editing.path !== undefined;
    const key = event.key.toLowerCase();
    if (key === 'g') this.controls.askLine();
    else if (key === 'f' && isEdited) this.editing.askText();
    else if (key === 'f') this.controls.askText();
    else return;
    event.preventDefault();
    event.stopPropagation();
  }
}
