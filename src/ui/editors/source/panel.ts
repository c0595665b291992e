/**
 * The tab *Source*: the text of an open file with line numbers. What is selected lights up its lines; a click on a line
 * selects what it holds.
 *
 *     arrows, Page Up, Page Down, Home, End   to another line       Enter    selects what it holds
 *     Ctrl+G                                  the number of a line  Ctrl+F   a text
 */
import type { Diagnostic } from '../../../model/diagnostic.ts';
import { baseName } from '../../../model/files.ts';
import { type LineRange, lastUpTo, linesOf, type SourceTarget, targetAt } from '../../../model/source-map.ts';
import { element, setText } from '../../kit/dom.ts';
import { focusPanel } from '../../kit/focus.ts';
import { oncePerFrame } from '../../kit/frame.ts';
import { count, plural } from '../../kit/number-text.ts';
import type { TimelineTab } from '../../state/timeline.ts';
import type { Uses } from '../../state/workbench.ts';
import { frameThen, type Known, type Origins, originsIn, pickNow, type TextState, targetsThen } from './as-opened.ts';
import { findLine } from './find-text.ts';
import { LineView } from './line-view.ts';
import { OpenedSource } from './opened-source.ts';
import { sourcesOf } from './places.ts';
import { worstFirst } from './problems.ts';
import { type SourceTools, sourceTools } from './tools.ts';

type Parts = Uses<'store' | 'timeline' | 'files' | 'messages' | 'posing' | 'transport'>;

const NO_LINES: readonly LineRange[] = [];

export function sourcePanel(wb: Parts): TimelineTab {
  return new SourcePanel(wb);
}

class SourcePanel implements TimelineTab {
  readonly element: HTMLElement;
  readonly tools: HTMLElement;
  private readonly view: LineView;
  private readonly controls: SourceTools;
  private readonly empty = element('p', { class: 'empty source-empty', hidden: true });
  /** That the text isn't what is in the page. */
  private readonly note = element('p', { class: 'source-note', role: 'status', hidden: true });
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
    this.view = new LineView({
      text: (line) => this.opened?.line(line),
      isLit: (line) => isIn(this.lit, this.litStarts, line),
      isNow: (line) => line === this.now,
      problem: (line) => {
        const found = this.problems.get(line);
        return found && { severity: found.severity, text: found.message };
      },
      pick: (line) => this.pick(line),
    });
    this.controls = sourceTools({
      choose: (path) => this.open(path),
      find: (text) => void this.find(text),
      goTo: (line) => this.goTo(line),
      leave: () => focusPanel(this.view.element),
    });
    this.tools = this.controls.element;
    this.element = element(
      'div',
      { class: 'source', 'data-panel': 'source' },
      this.note,
      this.empty,
      this.view.element,
    );
    this.element.addEventListener('keydown', (event) => this.onKey(event));
    const { store, timeline, posing, transport, messages } = wb;
    store.subscribe((now, before) => {
      if (now.document === before.document && now.selection === before.selection) return;
      this.followSoon();
    });
    posing.chosenDof.subscribe(this.followSoon);
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
    this.open(path, place.line);
    // A message opened the file to be looked at here.
    focusPanel(this.view.element);
  }

  private paths(): readonly string[] {
    const { store, files } = this.wb;
    return sourcesOf(store.document, store.selection.characterId)
      .filter(({ name }) => files.source.isText(name))
      .map(({ path }) => path);
  }

  private open(path: string, line?: number): void {
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
    this.view.setLines(0, true);
    this.status = '';
    this.readProblems();
    this.showFiles();
    this.showState();
    void opened.read();
  }

  private closeFile(): void {
    this.opened?.close();
    this.opened = undefined;
    this.search?.abort();
    this.light(NO_LINES);
    this.now = undefined;
  }

  private showLines(): void {
    const { opened, view, wanted } = this;
    if (!opened) return;
    view.setLines(opened.count, false);
    if (opened.map) this.follow(wanted === undefined);
    if (wanted === undefined || (wanted > opened.count && !opened.map)) return;
    view.goTo(wanted);
    if (opened.map) this.wanted = undefined;
  }

  private showState(): void {
    const { opened } = this;
    const state = opened?.state;
    const failed = state?.kind === 'failed' ? `${baseName(opened?.path ?? '')} can’t be shown. ${state.message}` : '';
    this.empty.hidden = opened !== undefined && !failed;
    this.view.element.hidden = !this.empty.hidden;
    setText(this.empty, failed || 'Open a file to see its text, with line numbers.');
    if (state?.kind === 'reading') this.controls.say(`Reading ${Math.round(100 * state.share)} %`);
    else this.controls.say(this.status || (opened?.map ? plural(opened.count, 'line') : ''));
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
    if (this.opened?.isOld) {
      this.open(this.opened.path, this.view.current);
      return;
    }
    const { store, posing } = this.wb;
    const { document, selection } = store;
    const paths = this.paths();
    this.showFiles();
    const chosen = posing.chosenDof.get();
    const targetsIn = (path: string) =>
      originsIn(document, path, this.known).origins.flatMap((origin) => targetsThen(origin, selection, chosen));
    const own = this.opened ? targetsIn(this.opened.path) : [];
    const isOwnPick = this.isOwnPick;
    this.isOwnPick = false;
    if (own.length === 0 && !isOwnPick && this.wanted === undefined && this.isAnewSelected()) {
      const other = paths.find((path) => targetsIn(path).length > 0) ?? (this.opened ? undefined : paths[0]);
      if (other !== undefined && other !== this.opened?.path) {
        this.open(other);
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
    const map = this.opened?.map;
    if (!map) return;
    const before = this.lit;
    const all = targets.flatMap((target) => linesOf(map, target));
    const ascending = [...all].sort((a, b) => a.from - b.from);
    this.light(ascending);
    const isSame = before.length === ascending.length && before.every((l, i) => l.from === ascending[i].from);
    if (reveals && !isSame && all.length) this.view.reveal(all[0]);
  }

  private light(lines: readonly LineRange[]): void {
    this.lit = lines;
    this.litStarts = lines.map(({ from }) => from);
    this.view.drawSoon();
  }

  private originsHere(): Origins {
    const { opened, wb } = this;
    return opened ? originsIn(wb.store.document, opened.path, this.known) : { state: 'same', origins: [] };
  }

  private showNote(): void {
    const { state } = this.originsHere();
    const hasErrors = [...this.problems.values()].some(({ severity }) => severity === 'error');
    const text = this.opened && noteOf(state, hasErrors);
    this.note.hidden = !text;
    setText(this.note, text ?? '');
  }

  /** The frame of the current time, of a capture. */
  private showTime(): void {
    if (!this.visible || !this.opened?.map) return;
    const { map } = this.opened;
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
    this.problems = worstFirst(all.filter(({ file, line }) => file === name && line > 0));
    this.view.drawSoon();
  }

  private pick(line: number): void {
    const map = this.opened?.map;
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
    if (!this.opened) return;
    const { count: lines } = this.opened;
    if (line > lines) this.say(`The last line is ${count(lines)}.`);
    this.view.goTo(line);
    focusPanel(this.view.element);
  }

  private async find(text: string): Promise<void> {
    const { opened } = this;
    if (!opened?.map || !opened.text || text === '') return;
    this.search?.abort();
    const search = new AbortController();
    this.search = search;
    try {
      const line = await findLine(opened.text, opened.map.index, text, this.view.current, search.signal);
      if (search.signal.aborted) return;
      if (line === undefined) this.say(`“${text}” was not found.`);
      else {
        this.view.goTo(line);
        this.say(`Found on line ${count(line)}`);
      }
    } catch (error) {
      if (!search.signal.aborted) this.say(`The file can’t be searched: ${String(error)}`);
    }
  }

  private onKey(event: KeyboardEvent): void {
    if (!(event.ctrlKey || event.metaKey) || event.altKey || event.shiftKey) return;
    const key = event.key.toLowerCase();
    if (key === 'g') this.controls.askLine();
    else if (key === 'f') this.controls.askText();
    else return;
    event.preventDefault();
    event.stopPropagation();
  }
}

function noteOf(state: TextState, hasErrors: boolean): string | undefined {
  if (state === 'same') return undefined;
  if (state === 'edited') return 'Edited since it was opened: lines are those of the file as it came.';
  const why = hasErrors ? 'This text has errors and was not opened' : 'This text is not the version that is open';
  return `${why}. The page has another version, so nothing lights up.`;
}

/** @param starts of the ranges, which ascend */
function isIn(ranges: readonly LineRange[], starts: readonly number[], line: number): boolean {
  if (ranges.length === 0 || line < starts[0]) return false;
  return line <= ranges[lastUpTo(starts, line)].to;
}
