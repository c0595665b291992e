/** The row above the text of an edited file: what has changed, the way from change to change, and a switch for them. */
import { countsOf, type LineHunk } from '../../../model/text-changes.ts';
import { button, element, keepsFocusElsewhere, setAttribute, setText, write } from '../../widgets/dom.ts';
import { icon } from '../../widgets/icons.ts';
import { plural } from '../../widgets/numbers/number-text.ts';
import { setTooltip } from '../../widgets/tooltip.ts';

export interface ChangeBar {
  readonly element: HTMLElement;
  /**
   * @param text what it says; empty: hidden
   * @param isOn whether changes are shown; undefined: there can be none
   * @param hasSteps whether there are changes to go to
   */
  show(text: string, isOn?: boolean, hasSteps?: boolean): void;
}

interface Calls {
  goTo(step: 1 | -1): void;
  /** Shows the changes, or the file as it came. */
  toggle(): void;
}

export function changeBar(calls: Calls): ChangeBar {
  const text = element('span', { class: 'source-note-text', role: 'status' });
  const step = (label: string, by: 1 | -1, name: 'previousTake' | 'nextTake', keys: string) => {
    const made = keepsFocusElsewhere(button(label, { class: 'tool small' }, icon(name), () => calls.goTo(by)));
    setTooltip(made, label, () => keys);
    return made;
  };
  const previous = step('Previous change', -1, 'previousTake', 'Shift+F7');
  const next = step('Next change', 1, 'nextTake', 'F7');
  const toggle = keepsFocusElsewhere(element('button', { type: 'button', class: 'tool source-toggle' }, 'Changes'));
  toggle.addEventListener('click', () => calls.toggle());
  setTooltip(toggle, 'Show what was changed in the page, compared with the original file');
  const own = element('div', { class: 'source-note', hidden: true }, text, previous, next, toggle);
  return {
    element: own,
    show(said, isOn, hasSteps = false) {
      write(own, 'hidden', said === '');
      setText(text, said);
      for (const each of [previous, next]) write(each, 'hidden', !hasSteps);
      write(toggle, 'hidden', isOn === undefined);
      setAttribute(toggle, 'aria-pressed', String(isOn === true));
    },
  };
}

/** `2 lines changed, 1 added`. */
export function changesInWords(hunks: readonly LineHunk[]): string {
  const { changed, added, removed } = countsOf(hunks);
  const parts: [number, string][] = [
    [changed, 'changed'],
    [added, 'added'],
    [removed, 'removed'],
  ];
  const found = parts.filter(([count]) => count > 0);
  return found
    .map(([count, word], i) => (i === 0 ? `${plural(count, 'line')} ${word}` : `${count} ${word}`))
    .join(', ');
}
