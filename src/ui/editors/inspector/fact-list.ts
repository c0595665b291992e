/** Facts in two columns, with tables of numbers between them; used by `joint-facts` and `vertex-facts`. */
import { announce } from '../../widgets/announce.ts';
import { BLOCKED, copyText } from '../../widgets/clipboard.ts';
import { button, element, setText } from '../../widgets/dom.ts';
import { type GridOptions, NumberGrid } from '../../widgets/numbers/number-grid.ts';

/** A view with its update function. */
export interface FactView {
  readonly element: HTMLElement;
  fill(): void;
}

export class FactList {
  readonly element = element('div', { class: 'facts' });
  private readonly parts: (() => string)[] = [];

  constructor(title: string) {
    const copyAll = button('Copy all', { class: 'link copy-all', tooltip: 'Copy all values' }, 'Copy all', () => {
      void copyText(this.text()).then((done) => {
        announce(done ? `Copied ${title}` : BLOCKED);
        copyAll.textContent = done ? 'Copied' : 'Blocked';
        setTimeout(() => {
          copyAll.textContent = 'Copy all';
        }, 1200);
      });
    });
    this.element.append(element('div', { class: 'facts-head' }, element('span', { class: 'label' }, title), copyAll));
    this.parts.push(() => title);
  }

  /**
   * Adds a line; returns a function that sets its text.
   *
   * @param copied copied instead of the text shown: its numbers in full precision
   */
  fact(label: string, value: string | HTMLElement, copied?: string): (text: string) => void {
    const cell = element('span', { class: 'fact-value' }, value);
    this.element.append(element('div', { class: 'fact' }, element('span', { class: 'faint' }, label), cell));
    this.parts.push(() => `${label}: ${copied ?? cell.textContent}`);
    return (text) => setText(cell, text);
  }

  /** Adds a table under a heading; the note beside the heading can be set later. */
  grid(options: GridOptions): { readonly grid: NumberGrid; note(text: string): void } {
    const grid = new NumberGrid(options);
    const note = element('span', { class: 'grid-note' });
    this.element.append(
      element('div', { class: 'grid-head' }, element('span', { class: 'faint' }, options.label), note),
    );
    this.element.append(grid.element);
    this.parts.push(() => `${options.label}${note.textContent ? ` (${note.textContent})` : ''}\n${grid.text()}`);
    return { grid, note: (text) => setText(note, text) };
  }

  text(): string {
    return this.parts.map((part) => part()).join('\n');
  }
}
