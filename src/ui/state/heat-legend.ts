/** The legend of a heat map: the colours of `view/heat.ts`, with what their ends mean. */
import { heatColour } from '../../view/skin/heat.ts';
import { element, setText } from '../widgets/dom.ts';

/** Between them, colours are blended; the map itself has more. */
const STOPS = 16;

export interface HeatLegend {
  readonly element: HTMLElement;
  /** Sets the text of the upper end; the lower one is 0. */
  show(upper: string): void;
}

/** @param label for screen readers: what the colours show */
export function heatLegend(label: string): HeatLegend {
  const colours = Array.from({ length: STOPS + 1 }, (_, i) => `rgb(${heatColour(i / STOPS).join(' ')})`);
  const bar = element('div', { class: 'heat-legend-bar', role: 'img', 'aria-label': label });
  bar.style.background = `linear-gradient(to right, ${colours.join(', ')})`;
  const end = element('span');
  const ends = element('div', { class: 'heat-legend-ends' }, element('span', {}, '0'), end);
  return { element: element('div', { class: 'heat-legend' }, bar, ends), show: (upper) => setText(end, upper) };
}
