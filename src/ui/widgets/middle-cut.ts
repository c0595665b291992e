/** Names that are cut before their last letters, since takes of one series begin alike: `boxing-ext…cmu-01_01`. */
import { cutText } from '../../model/names/cut-text.ts';
import { element, setAttribute, setText } from './dom.ts';
import { setTooltip } from './tooltip.ts';

/** Letters at the end that are kept. */
const TAIL = 6;
/** Letters before them that there is always room for. */
const SHORT = 4;

export interface MiddleCut {
  readonly element: HTMLElement;
  show(name: string): void;
}

/** The full name belongs in a tooltip. */
export function middleCut(className: string): MiddleCut {
  const head = element('span', { class: 'cut-head' });
  const tail = element('span', { class: 'cut-tail' });
  const whole = element('span', { class: `middle-cut ${className}` }, head, tail);
  return {
    element: whole,
    show(name) {
      const letters = [...cutText(name)];
      const end = letters.length > TAIL + SHORT ? TAIL : 0;
      setText(head, letters.slice(0, letters.length - end).join(''));
      setText(tail, end ? letters.slice(-end).join('') : '');
      // Read as one word.
      setAttribute(whole, 'role', end ? 'img' : undefined);
      setAttribute(whole, 'aria-label', end ? name : undefined);
    },
  };
}

/** A name of so many letters fits in a row as narrow as they get. */
const FITS = 16;

/** A row's label, with the whole name as its tooltip. One that fits is plain text, which is read and copied as such. */
export function cutLabel(name: string): HTMLElement {
  if ([...cutText(name)].length <= FITS) return element('span', { class: 'label', tooltip: name }, name);
  const { element: label, show } = middleCut('label');
  show(name);
  setTooltip(label, name);
  return label;
}
