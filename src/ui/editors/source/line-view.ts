/**
 * The lines of a file as rows, of which only those in view are in the page. They hang in a layer that doesn't scroll:
 *
 *     scroller ┌──────────────────┐
 *              │ layer: lines     │   sticky; its lines are placed by the line at the top, which need not be a whole one
 *              └──────────────────┘
 *       space  as high as `tall-scroll.ts` says
 */
import type { Severity } from '../../../model/diagnostic.ts';
import type { LineRange } from '../../../model/source-map.ts';
import type { HunkKind } from '../../../model/text-changes.ts';
import { element, setAttribute, setText, uniqueId, write } from '../../widgets/dom.ts';
import { HAS_KEYS } from '../../widgets/focus/focus.ts';
import { oncePerFrame } from '../../widgets/frame.ts';
import { plural } from '../../widgets/numbers/number-text.ts';
import { setTooltip } from '../../widgets/tooltip.ts';
import { rowAfterKey } from '../../widgets/windowed-list.ts';
import { type ShownLine, WORDS } from './line-text.ts';
import { clampTop, MAX_HEIGHT, scrollHeight, scrollTopOf, type TallList, topAt, topToReveal } from './tall-scroll.ts';

/** As in the styles. */
const LINE_HEIGHT = 18;

/** A problem with a line. */
export interface LineProblem {
  readonly severity: Severity;
  readonly text: string;
}

/** What a row shows: as a rule a line. */
export interface ShownRow {
  /** Its number in the text; absent for a row that isn't in it. */
  readonly line?: number;
  /** Undefined while it is read. */
  readonly text: ShownLine | undefined;
  readonly isLit: boolean;
  /** Of the current time. */
  readonly isNow: boolean;
  readonly problem?: LineProblem;
  readonly change?: RowChange;
}

/** `old`: what a changed or removed line was. */
export type RowChange = HunkKind | 'old';

export interface LineSource {
  /** A row, from 1. */
  row(row: number): ShownRow;
  /** Clicked, or Enter on it. */
  pick(row: number): void;
}

const CHANGES: { readonly [K in RowChange]: { readonly sign: string; readonly word: string } } = {
  added: { sign: '+', word: 'Added' },
  changed: { sign: '~', word: 'Changed' },
  removed: { sign: '−', word: 'Removed' },
  old: { sign: '−', word: 'Was' },
};

interface Row {
  readonly element: HTMLElement;
  readonly margin: HTMLElement;
  readonly number: HTMLElement;
  readonly sign: HTMLElement;
  /** What the sign says. */
  readonly word: HTMLElement;
  readonly text: HTMLElement;
  shown: string | undefined;
}

export class LineView {
  readonly element = element('div', {
    ...{ class: 'source-lines', role: 'listbox', tabindex: 0, 'aria-label': 'Lines', [HAS_KEYS]: true },
  });
  private readonly space = element('div', { class: 'source-space', role: 'presentation' });
  private readonly layer = element('div', { class: 'source-layer', role: 'presentation' });
  private readonly rows: Row[] = [];
  private readonly idPrefix = uniqueId('source-line');
  private lines = 0;
  /** Index of the line at the top, from 0. */
  private top = 0;
  /** The position of the scroll bar as set here: an event that finds it there brings no news. */
  private ownScrollTop = 0;
  private currentLine = 1;
  readonly drawSoon: () => void = oncePerFrame(() => this.draw());

  constructor(private readonly source: LineSource) {
    this.space.append(this.layer);
    this.element.append(this.space);
    this.element.addEventListener('scroll', () => this.onScroll());
    this.element.addEventListener('wheel', (event) => this.onWheel(event), { passive: false });
    this.element.addEventListener('keydown', (event) => this.onKey(event));
    this.element.addEventListener('click', (event) => this.onClick(event));
    new ResizeObserver(() => this.resized()).observe(this.element);
  }

  /** The row with the keyboard's mark, from 1. */
  get current(): number {
    return this.currentLine;
  }

  /** The first and the last row in view. */
  get inView(): readonly [number, number] {
    const first = Math.floor(this.top) + 1;
    return [first, Math.max(first, Math.min(this.lines, Math.ceil(this.top + this.list.room / LINE_HEIGHT)))];
  }

  /** Another file, or more of its rows. */
  setLines(lines: number, isNewFile: boolean): void {
    this.lines = lines;
    if (isNewFile) {
      this.top = 0;
      this.currentLine = 1;
      this.layer.style.minWidth = '';
    }
    this.resized();
  }

  /** Moves the mark to a row, from 1, and shows it. */
  goTo(line: number): void {
    this.currentLine = Math.max(1, Math.min(this.lines, line));
    this.reveal({ from: this.currentLine, to: this.currentLine });
  }

  /** Shows rows; the first one if there is no room for all. */
  reveal({ from, to }: LineRange): void {
    this.setTop(topToReveal(this.list, topToReveal(this.list, this.top, to - 1), from - 1));
  }

  private get list(): TallList {
    return { lines: this.lines, lineHeight: LINE_HEIGHT, room: this.element.clientHeight };
  }

  private setTop(top: number): void {
    this.top = clampTop(this.list, top);
    this.element.scrollTop = scrollTopOf(this.list, this.top);
    this.ownScrollTop = this.element.scrollTop;
    this.drawSoon();
  }

  private resized(): void {
    this.space.style.height = `${scrollHeight(this.list)}px`;
    this.setTop(this.top);
  }

  private onScroll(): void {
    const { scrollTop } = this.element;
    if (Math.abs(scrollTop - this.ownScrollTop) >= 1) {
      this.top = topAt(this.list, scrollTop);
      this.ownScrollTop = scrollTop;
    }
    // Also to the side.
    this.draw();
  }

  /** In a file higher than the scroll bar can say, a turn of the wheel is still a few lines. */
  private onWheel(event: WheelEvent): void {
    if (this.lines * LINE_HEIGHT <= MAX_HEIGHT || event.ctrlKey || event.deltaY === 0) return;
    event.preventDefault();
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? event.deltaY / LINE_HEIGHT : event.deltaY;
    this.setTop(this.top + lines);
  }

  private onKey(event: KeyboardEvent): void {
    if (event.altKey || event.shiftKey || this.lines === 0) return;
    const isJump = event.key === 'Home' || event.key === 'End';
    if ((event.ctrlKey || event.metaKey) && !isJump) return;
    const page = Math.max(1, Math.floor(this.list.room / LINE_HEIGHT) - 1);
    const to = rowAfterKey(event.key, this.currentLine - 1, this.lines, page);
    if (to !== undefined) this.goTo(to + 1);
    else if (event.key === 'Enter') this.source.pick(this.currentLine);
    else return;
    event.preventDefault();
  }

  private onClick({ target }: MouseEvent): void {
    const row = target instanceof Element ? target.closest<HTMLElement>('[data-row]') : null;
    // Text was selected, to be copied.
    if (!row || !(document.getSelection()?.isCollapsed ?? true)) return;
    this.currentLine = Number(row.dataset.row);
    this.drawSoon();
    this.source.pick(this.currentLine);
  }

  private draw(): void {
    const { rows, layer, lines, top } = this;
    const { room } = this.list;
    const first = Math.floor(top);
    const count = room ? Math.min(lines - first, Math.ceil(room / LINE_HEIGHT) + 1) : 0;
    while (rows.length < count) {
      const row = makeRow();
      rows.push(row);
      layer.append(row.element);
    }
    while (rows.length > Math.max(0, count)) rows.pop()?.element.remove();
    rows.forEach((row, i) => {
      row.element.style.top = `${(first + i - top) * LINE_HEIGHT}px`;
      this.fill(row, first + i + 1);
    });
    const width = Math.max(...rows.map(({ text }) => text.offsetLeft + text.scrollWidth), 0);
    // It only grows, so that the scroll bar stays as one scrolls.
    if (width > layer.offsetWidth) layer.style.minWidth = `${width}px`;
    this.element.style.setProperty('--source-digits', String(Math.max(3, String(lines).length)));
    const isShown = this.currentLine > first && this.currentLine <= first + count;
    setAttribute(this.element, 'aria-activedescendant', isShown ? `${this.idPrefix}-${this.currentLine}` : undefined);
  }

  private fill(row: Row, at: number): void {
    const { line, text: shown, isLit, isNow, problem, change } = this.source.row(at);
    const { element: own } = row;
    own.id = `${this.idPrefix}-${at}`;
    write(own.dataset, 'row', String(at));
    setAttribute(own, 'data-line', line === undefined ? undefined : String(line));
    setText(row.number, line === undefined ? '' : String(line));
    own.classList.toggle('is-lit', isLit);
    setAttribute(own, 'aria-selected', String(isLit));
    own.classList.toggle('is-now', isNow);
    own.classList.toggle('is-current', at === this.currentLine);
    setAttribute(own, 'data-severity', problem?.severity);
    setTooltip(row.margin, problem?.text ?? '');
    setAttribute(own, 'data-change', change);
    setText(row.sign, change ? CHANGES[change].sign : '');
    const cut = shown && shown.more > 0 ? cutNote(shown) : '';
    const text = `${shown?.text ?? ''}${cut}`;
    const isEmpty = text.trim() === '';
    // The sign isn't read.
    setText(row.word, change ? `${CHANGES[change].word}: ` : '');
    // Nothing else would be read of an empty line.
    setAttribute(own, 'aria-label', isEmpty ? `${row.word.textContent}Line ${line ?? ''}, empty`.trim() : undefined);
    if (row.shown === text) return;
    row.shown = text;
    row.text.replaceChildren(...coloured(shown?.text ?? ''));
    if (cut) row.text.append(element('span', { class: 'source-cut' }, cut));
  }
}

function cutNote({ more, isAbout }: ShownLine): string {
  return ` … ${isAbout ? 'about ' : ''}${plural(more, 'more character')}`;
}

function makeRow(): Row {
  const number = element('span', { class: 'source-digits' });
  const sign = element('span', { class: 'source-sign' });
  const margin = element('span', { class: 'source-number', 'aria-hidden': 'true' }, number, sign);
  const word = element('span', { class: 'off-screen' });
  const text = element('span', { class: 'source-text' });
  return {
    element: element('div', { class: 'source-line', role: 'option' }, margin, word, text),
    word,
    margin,
    number,
    sign,
    text,
    shown: undefined,
  };
}

function coloured(text: string): (Node | string)[] {
  const parts: (Node | string)[] = [];
  let at = 0;
  for (const { 0: word, index } of text.matchAll(WORDS)) {
    if (index > at) parts.push(text.slice(at, index));
    parts.push(element('span', { class: 'source-word' }, word));
    at = index + word.length;
  }
  if (at < text.length) parts.push(text.slice(at));
  return parts;
}
