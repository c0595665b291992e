/** Names that are cut before their last letters, since takes of one series begin alike: `boxing-ext…cmu-01_01`. */
import { element, setText } from './dom.ts';

/** Letters at the end that are kept. */
const TAIL = 6;
/** Letters before them that there is always room for. */
const SHORT = 4;

export interface MiddleCut {
  readonly element: HTMLElement;
  show(name: string): void;
}

export function middleCut(className: string): MiddleCut {
  const head = element('span', { class: 'cut-head' });
  const tail = element('span', { class: 'cut-tail' });
  return {
    element: element('span', { class: `middle-cut ${className}` }, head, tail),
    show(name) {
      const letters = [...name];
      const end = letters.length > TAIL + SHORT ? TAIL : 0;
      setText(head, letters.slice(0, letters.length - end).join(''));
      setText(tail, end ? letters.slice(-end).join('') : '');
    },
  };
}
