/**
 * On a phone there is room for one part of the comparison at a time: the takes, the chart or the list of joints. A
 * switch chooses it; on wider pages all are side by side (`compare-narrow.css`).
 */
import { element, keepsFocusElsewhere, setAttribute, write } from '../../widgets/dom.ts';

const PARTS = { takes: 'Takes', graph: 'Graph', joints: 'Joints' } as const;

/** A part of the comparison. */
export type ComparePart = keyof typeof PARTS;

export interface CompareSwitch {
  readonly element: HTMLElement;
  /** Chooses a part, as a press does. */
  choose(part: ComparePart): void;
}

/** @param panel gets the chosen part as `data-part` */
export function compareSwitch(panel: HTMLElement): CompareSwitch {
  const group = element('div', {
    class: 'compare-switch',
    role: 'group',
    'aria-label': 'What to show of the comparison',
  });
  const choose = (part: ComparePart) => {
    write(panel.dataset, 'part', part);
    for (const [name, made] of buttons) setAttribute(made, 'aria-pressed', String(name === part));
  };
  const make = (part: ComparePart): readonly [ComparePart, HTMLElement] => {
    const made = keepsFocusElsewhere(element('button', { type: 'button', class: 'tool text-tool' }, PARTS[part]));
    made.addEventListener('click', () => choose(part));
    return [part, made];
  };
  const buttons = [make('takes'), make('graph'), make('joints')];
  group.append(...buttons.map(([, made]) => made));
  choose('graph');
  return { element: group, choose };
}
