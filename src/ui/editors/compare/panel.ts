/**
 * *Compare*: where another program's numbers differ from ours, and which mistakes explain it. Follows the comparison at
 * the time shown; where none was compared near it, the first that differs is told. Escape ends the comparison.
 */
import type { FirstWrong, FrameComparison } from '../../../teaching/compare/compare.ts';
import { firstWrongOf } from '../../../teaching/compare/first-wrong.ts';
import type { ComparedResult, CompareState, DumpComparison } from '../../state/dump-comparison.ts';
import { takeTimeShown } from '../../state/dump-times.ts';
import { endComparison } from '../../state/shown-comparison.ts';
import type { TimelineTab } from '../../state/timeline.ts';
import type { Uses } from '../../state/workbench.ts';
import { button, element, setAttribute, setText, write } from '../../widgets/dom.ts';
import { isTextField } from '../../widgets/focus/focus.ts';
import { toolbar } from '../../widgets/focus/roving.ts';
import { oncePerFrame } from '../../widgets/frame.ts';
import { shown } from '../../widgets/numbers/number-text.ts';
import {
  type ComparedRow,
  countsOf,
  hasRows,
  kindsIn,
  MAX_VERTICES,
  type RowKind,
  rowsOf,
  rowTitle,
} from './compared-rows.ts';
import { Detail, type JointNumbers, jointNumbersIn } from './detail.ts';
import { Findings } from './findings.ts';
import { listenToPaste } from './paste-keys.ts';
import { startPage } from './start.ts';
import { ComparedTable } from './table.ts';

type Parts = Uses<'actions' | 'comparing' | 'store' | 'transport' | 'timeline' | 'posing' | 'files' | 'messages'>;

export function comparePanel(wb: Parts): TimelineTab {
  return new ComparePanel(wb);
}

const KIND_LABELS: Readonly<Record<RowKind, string>> = {
  joints: 'Joints',
  vertices: 'Worst vertices',
  normals: 'Worst normals',
  channels: 'Channels',
};
const KIND_OF: Readonly<Record<FirstWrong['what'], RowKind>> = {
  joint: 'joints',
  vertex: 'vertices',
  normal: 'normals',
  channel: 'channels',
};
const NUMBER_LABELS: Readonly<Record<JointNumbers, string>> = {
  world: 'World',
  local: 'Local',
  positions: 'Position',
};

class ComparePanel implements TimelineTab {
  readonly element = element('div', { class: 'compare', 'data-panel': 'compare', tabindex: -1 });
  readonly tools: HTMLElement;
  private readonly start: HTMLElement;
  private readonly body: HTMLElement;
  private readonly findings: Findings;
  private readonly table = new ComparedTable((row) => this.choose(row));
  private readonly detail = new Detail();
  private readonly kinds = toolbar(element('div', { class: 'compare-kinds tools', 'aria-label': 'Table' }));
  private readonly numbersBar = toolbar(element('div', { class: 'compare-kinds tools', 'aria-label': 'Matrices' }));
  private readonly when = element('span', { class: 'faint compare-when' });
  private readonly detailName = element('h3', { class: 'compare-name' });
  private readonly steps: HTMLButtonElement;
  private readonly right: HTMLElement;
  private readonly paste: HTMLElement;
  /** The field for numbers is shown over the comparison. */
  private asksForNumbers = false;
  private visible = false;
  /** While it is visible. */
  private pasting: AbortController | undefined;
  private kind: RowKind = 'joints';
  private numbers: JointNumbers = 'world';
  /** Of the vertex, normal or channel; joints are selected on the page. */
  private picked: number | undefined;
  private listed: { readonly key: readonly unknown[]; readonly rows: readonly ComparedRow[] } | undefined;
  private stops: (() => void)[] = [];
  private readonly showSoon = oncePerFrame(() => this.show());

  constructor(private readonly wb: Parts) {
    this.findings = new Findings(wb);
    this.start = startPage(wb);
    this.steps = button('', { class: 'link', tooltip: undefined }, '', () => this.explain());
    this.right = element(
      'div',
      { class: 'compare-detail' },
      element('div', { class: 'compare-bar' }, this.detailName, this.numbersBar, this.steps),
      this.detail.element,
    );
    this.body = element(
      'div',
      { class: 'compare-body' },
      this.findings.element,
      element(
        'div',
        { class: 'compare-list' },
        element('div', { class: 'compare-bar' }, this.kinds, this.when),
        this.table.element,
      ),
      this.right,
    );
    const act = (label: string, tooltip: string, run: () => void) =>
      button(label, { class: 'tool text-tool', tooltip }, label, run);
    this.paste = act('Paste numbers', 'Or press Ctrl+V while this tab is shown', () => {
      this.asksForNumbers = !this.asksForNumbers;
      this.show();
      // Earlier text is replaced by what is pasted.
      if (this.asksForNumbers) this.start.querySelector('textarea')?.select();
    });
    this.tools = element(
      'div',
      { class: 'compare-tools' },
      this.paste,
      act('Stop comparing', 'Discards the pasted and dropped numbers (Esc)', () => endComparison(wb)),
    );
    this.element.append(this.start, this.body);
    this.element.addEventListener('keydown', (event) => this.onKey(event));
    wb.comparing.subscribe((comparing) => this.follow(comparing));
    wb.store.subscribe((now, before) => {
      if (now.document !== before.document || now.selection !== before.selection) this.showSoon();
    });
    this.setKind(this.kind);
    this.follow(wb.comparing.get());
  }

  setVisible(visible: boolean): void {
    if (visible === this.visible) return;
    this.visible = visible;
    this.pasting?.abort();
    if (!visible) return;
    this.pasting = new AbortController();
    listenToPaste(this.wb, this.pasting.signal);
    this.showSoon();
  }

  // This tab shows no time to fit.
  fitAll(): void {}
  fitSelected(): void {}
  recolour(): void {
    // The styles do.
  }

  private follow(comparing: DumpComparison | undefined): void {
    for (const stop of this.stops) stop();
    const ofDumps = (now: CompareState, before: CompareState) => {
      // Numbers that were asked for have come.
      if (now.dumps !== before.dumps) this.asksForNumbers = false;
      this.showSoon();
    };
    this.stops = comparing ? [comparing.state.subscribe(ofDumps), comparing.shown.subscribe(this.showSoon)] : [];
    this.listed = undefined;
    this.told = undefined;
    this.picked = undefined;
    this.asksForNumbers = false;
    this.findings.forget();
    this.showSoon();
  }

  private show(): void {
    if (!this.visible) return;
    const comparing = this.wb.comparing.get();
    const character = comparing?.character;
    const state = comparing?.state.get();
    // Beside numbers that don't fit it helps to see what would.
    const isMisfit = state?.phase.kind === 'misfit' && !state.result;
    const isAsking = !state || isMisfit || this.asksForNumbers;
    write(this.start, 'hidden', !isAsking);
    write(this.body, 'hidden', isAsking);
    write(this.tools, 'hidden', comparing === undefined);
    write(this.paste, 'hidden', isMisfit);
    setAttribute(this.paste, 'aria-pressed', String(this.asksForNumbers));
    if (!comparing || !state) return;
    const { result } = state;
    const hasCome = result && state.phase.kind === 'done';
    if (hasCome && state.newest !== this.told)
      this.showNewest(result, state.newest, comparing.shown.get()?.index ?? -1);
    const kinds = result ? kindsIn(result) : [];
    if (kinds.length > 0 && !kinds.includes(this.kind)) this.setKind(kinds[0]);
    const told = result ? toldFrame(comparing, result, this.kind) : -1;
    this.findings.show(comparing, told);
    const isListed = result !== undefined && character !== undefined;
    this.body.classList.toggle('no-rows', !isListed);
    if (!isListed) return;
    fillChoices(this.kinds, kinds, this.kind, KIND_LABELS, (kind) => {
      this.setKind(kind);
      this.showSoon();
    });
    const frame: FrameComparison | undefined = result.comparison.frames[told];
    setText(this.when, this.kind === 'channels' || !frame ? '' : listText(this.kind, frame, result.tolerance));
    const key = [result, this.kind, told];
    if (!this.listed || key.some((part, i) => part !== this.listed?.key[i])) {
      this.listed = { key, rows: rowsOf(this.kind, result, frame, character) };
    }
    const { rows } = this.listed;
    const index = this.indexIn(rows, comparing);
    this.table.show(rows, index);
    this.showDetail(
      result,
      told,
      rows.find((row) => row.index === index),
    );
  }

  /** What is wrong first in dumps that were just given is what is listed. */
  private showNewest(result: ComparedResult, newest: readonly string[], frame: number): void {
    this.told = newest;
    const names = result.targets.origins?.fileNames ?? [];
    const dumps = names.flatMap((name, dump) => (newest.includes(name) ? [dump] : []));
    const placed = firstWrongOf(result, dumps.length > 0 ? new Set(dumps) : undefined, frame);
    if (placed) this.setKind(KIND_OF[placed.first.what]);
  }
  private told: readonly string[] | undefined;

  /** The row that is shown in detail: the selected one, else the first that differs. */
  private indexIn(rows: readonly ComparedRow[], { characterId }: DumpComparison): number | undefined {
    const { selection } = this.wb.store;
    const isOwn = selection.characterId === characterId;
    const asked = this.kind === 'joints' ? (isOwn ? selection.joint : undefined) : this.picked;
    const vertex = this.kind === 'vertices' || this.kind === 'normals' ? selection.vertex : undefined;
    for (const index of [isOwn ? vertex : undefined, asked]) {
      if (index !== undefined && rows.some((row) => row.index === index)) return index;
    }
    const wrong = rows.filter(({ mark }) => mark !== 'agrees').map((row) => row.index);
    return wrong.length > 0 ? Math.min(...wrong) : rows.at(0)?.index;
  }

  private showDetail(result: ComparedResult, frame: number, row: ComparedRow | undefined): void {
    write(this.right, 'hidden', row === undefined);
    if (!row) return;
    const numbers = this.kind === 'joints' ? jointNumbersIn(result.targets.frames[frame]) : [];
    if (numbers.length > 0 && !numbers.includes(this.numbers)) this.numbers = numbers[0];
    write(this.numbersBar, 'hidden', numbers.length < 2);
    fillChoices(this.numbersBar, numbers, this.numbers, NUMBER_LABELS, (what) => {
      this.numbers = what;
      this.showSoon();
    });
    const title = rowTitle(this.kind, row);
    setText(this.detailName, title);
    const explains = this.kind === 'channels' ? 'Why this curve' : 'See its steps';
    setText(this.steps, explains);
    setAttribute(this.steps, 'aria-label', `${explains}: ${title}`);
    if (row.index !== this.explained?.index) this.right.scrollTop = 0;
    this.detail.show({ result, frame, kind: this.kind, index: row.index, numbers: this.numbers });
    this.explained = row;
  }
  private explained: ComparedRow | undefined;

  private setKind(kind: RowKind): void {
    this.kind = kind;
    this.picked = undefined;
    this.table.setLabel(KIND_LABELS[kind]);
    // What is wrong first is above.
    this.table.setOrder();
  }

  private choose(row: ComparedRow): void {
    const { store, comparing } = this.wb;
    const characterId = comparing.get()?.characterId;
    if (characterId === undefined) return;
    if (this.kind === 'joints') store.select({ characterId, joint: row.index });
    else {
      this.picked = row.index;
      if (this.kind !== 'channels') store.select({ characterId, vertex: row.index });
    }
    this.showSoon();
  }

  /** Shows how the number comes about: *Steps* of a joint or vertex, *Why this curve* of a channel. */
  private explain(): void {
    const { wb, explained: row } = this;
    const comparing = wb.comparing.get();
    if (!row || !comparing) return;
    const { characterId, character } = comparing;
    if (this.kind === 'channels') {
      if (row.firstTime !== undefined) comparing.goToTime(row.firstTime);
      void import('./show-channel.ts').then(({ showChannel }) => character && showChannel(wb, character, row.index));
      return;
    }
    const { result } = comparing.state.get();
    const frame = result ? toldFrame(comparing, result, this.kind) : -1;
    if (result && comparing.shown.get()?.index !== frame) comparing.goTo(frame);
    const time = result?.comparison.frames[frame]?.time;
    wb.timeline.stepsOfFile.set(time === undefined && takeTimeShown(wb, character) !== undefined);
    const isJoint = this.kind === 'joints';
    wb.store.select({ characterId, ...(isJoint ? { joint: row.index } : { vertex: row.index }) });
    wb.timeline.change({ tab: 'steps' });
  }

  private onKey(event: KeyboardEvent): void {
    if (event.key !== 'Escape' || event.defaultPrevented || event.isComposing || !this.wb.comparing.get()) return;
    if (isTextField(event.target instanceof Element ? event.target : null)) return;
    event.preventDefault();
    event.stopPropagation();
    endComparison(this.wb);
    this.element.focus();
  }
}

/**
 * The frame shown, else the first that differs, else the first, of those that have such numbers; −1 if there are none.
 */
function toldFrame(comparing: DumpComparison, { comparison: { frames } }: ComparedResult, kind: RowKind): number {
  const isFit = (frame: FrameComparison) => kind === 'channels' || hasRows(kind, frame);
  const shownIndex = comparing.shown.get()?.index;
  if (shownIndex !== undefined && isFit(frames[shownIndex])) return shownIndex;
  const wrong = frames.findIndex((frame) => !frame.agrees && isFit(frame));
  return wrong < 0 ? frames.findIndex(isFit) : wrong;
}

/** `100 of 347 that differ · at 1.5 s` */
function listText(kind: RowKind, frame: FrameComparison, tolerance: number): string {
  const at = frame.time === undefined ? 'file pose' : `at ${shown(frame.time, 4)} s`;
  if (kind === 'joints') return at;
  const { wrong } = countsOf(kind, frame, tolerance);
  return wrong > MAX_VERTICES ? `${MAX_VERTICES} of ${wrong} that differ · ${at}` : at;
}

/** Buttons of which one is pressed. */
function fillChoices<T extends string>(
  bar: HTMLElement,
  choices: readonly T[],
  chosen: T,
  labels: Readonly<Record<T, string>>,
  choose: (choice: T) => void,
): void {
  const key = choices.join();
  if (bar.dataset.choices !== key) {
    write(bar.dataset, 'choices', key);
    bar.replaceChildren(
      ...choices.map((choice) =>
        button(
          labels[choice],
          { class: 'tool text-tool', 'data-choice': choice, tooltip: undefined },
          labels[choice],
          () => choose(choice),
        ),
      ),
    );
  }
  for (const made of bar.children) {
    setAttribute(made, 'aria-pressed', String(made instanceof HTMLElement && made.dataset.choice === chosen));
  }
}
