/**
 * The compared joints, largest distance first: maximum and mean distance. Picked ones are drawn in colour. A double
 * click, Enter, or a click on the maximum goes to the time of the largest distance.
 */
import type { Distances } from '../../../evaluate/compare/distance.ts';
import type { DistanceView } from '../../state/takes.ts';
import { element, setAttribute, setText, uniqueId } from '../../widgets/dom.ts';
import { isMac } from '../../widgets/focus/keyboard.ts';
import { setTooltip } from '../../widgets/tooltip.ts';
import { JOINT_COLOURS } from '../timeline/time-plot.ts';
import { columnText, type DistanceUnit, distanceNumber } from './distance-text.ts';

export interface ListEvents {
  /** @param adds toggles it in the selection */
  pick(pair: number, adds: boolean): void;
  hover(pair: number | undefined): void;
  /** To the time of its largest distance. */
  goTo(pair: number): void;
  order(order: DistanceView['order']): void;
}

/** Texts of a pair of joints. */
export interface JointLabel {
  readonly name: string;
  /** The second one's name if it differs. */
  readonly partner: string;
  readonly tooltip: string;
  /** When its distance is largest. */
  readonly worst: string;
}

const HEADS: readonly (readonly [DistanceView['order'], string, string])[] = [
  ['name', 'Joint', 'Sort by name'],
  ['mean', 'Mean', 'Sort by mean distance'],
  ['most', 'Max', 'Sort by largest distance'],
];

export class DistanceList {
  readonly element = element('div', { class: 'distance-list' });
  private readonly rows = element('div', { class: 'distance-rows', role: 'listbox', tabindex: 0 });
  private readonly heads: readonly HTMLElement[];
  private readonly idPrefix = uniqueId('distance');
  /** Pairs in the order of the rows. */
  private order: readonly number[] = [];
  private options = new Map<number, HTMLElement>();
  private focused = -1;

  constructor(private readonly events: ListEvents) {
    setAttribute(this.rows, 'aria-label', 'Joints by distance');
    setAttribute(this.rows, 'aria-multiselectable', 'true');
    this.heads = HEADS.map(([order, label, tooltip]) => {
      const made = element('button', { type: 'button', tabindex: -1, tooltip, 'data-order': order }, label);
      made.addEventListener('mousedown', (event) => event.preventDefault());
      made.addEventListener('click', () => events.order(order));
      return made;
    });
    const head = element('div', { class: 'distance-row distance-head' }, element('span'), ...this.heads);
    this.element.append(head, this.rows);
    this.rows.addEventListener('click', (event) => {
      const pair = pairAt(event);
      if (pair === undefined) return;
      this.focused = this.order.indexOf(pair);
      const adds = event.shiftKey || (isMac ? event.metaKey : event.ctrlKey);
      events.pick(pair, adds);
      if (!adds && isOn(event, '.distance-most')) events.goTo(pair);
    });
    this.rows.addEventListener('dblclick', (event) => {
      const pair = pairAt(event);
      if (pair !== undefined) events.goTo(pair);
    });
    this.rows.addEventListener('pointerover', (event) => events.hover(pairAt(event)));
    this.rows.addEventListener('pointerleave', () => events.hover(undefined));
    this.rows.addEventListener('keydown', (event) => this.onKey(event));
  }

  show(
    distances: Distances,
    labels: readonly JointLabel[],
    unit: DistanceUnit,
    { picked, order }: Pick<DistanceView, 'picked' | 'order'>,
  ): void {
    const before = this.order[this.focused];
    this.order = inOrder(distances, labels, order);
    this.focused = before === undefined ? -1 : this.order.indexOf(before);
    for (const [i, head] of this.heads.entries()) {
      const [of, label] = HEADS[i];
      setText(head, of === 'name' ? label : columnText(label, unit));
      setAttribute(head, 'aria-pressed', String(of === order));
    }
    const options = new Map<number, HTMLElement>();
    for (const pair of this.order) {
      const option = this.options.get(pair) ?? this.option(pair);
      const [mark, name, mean, most] = option.children;
      const ordinal = picked.indexOf(pair);
      const { name: own, partner, tooltip, worst } = labels[pair];
      setText(name.children[0], own || 'unnamed');
      setText(name.children[1], partner);
      setTooltip(name, tooltip);
      setTooltip(most, worst);
      setText(mean, distanceNumber(distances.jointMean[pair], unit));
      setText(most, distanceNumber(distances.jointMost[pair], unit));
      setAttribute(option, 'aria-selected', String(ordinal >= 0));
      if (mark instanceof HTMLElement) {
        mark.style.background = ordinal >= 0 ? `var(${JOINT_COLOURS[ordinal % JOINT_COLOURS.length]})` : '';
      }
      options.set(pair, option);
    }
    this.options = options;
    // Only if they differ: a double click needs its row to stay.
    const rows = [...options.values()];
    const { children } = this.rows;
    if (rows.length !== children.length || rows.some((row, i) => row !== children[i]))
      this.rows.replaceChildren(...rows);
    this.point();
  }

  private option(pair: number): HTMLElement {
    const made = element(
      'div',
      { class: 'distance-row', role: 'option', id: `${this.idPrefix}-${pair}`, 'data-pair': pair },
      element('span', { class: 'take-mark' }),
      element('span', { class: 'label' }, element('span'), element('span', { class: 'distance-partner' })),
      element('span', { class: 'number' }),
      element('span', { class: 'number distance-most' }),
    );
    return made;
  }

  private onKey(event: KeyboardEvent): void {
    const steps: Readonly<Record<string, number>> = { ArrowUp: -1, ArrowDown: 1 };
    const step = steps[event.key];
    const { order } = this;
    if (step !== undefined) this.focused = Math.max(0, Math.min(order.length - 1, this.focused + step));
    else if (event.key === 'Home') this.focused = 0;
    else if (event.key === 'End') this.focused = order.length - 1;
    else if (event.key !== 'Enter' && event.key !== ' ') return;
    const pair = order[this.focused];
    if (pair === undefined) return;
    event.preventDefault();
    if (event.key === 'Enter') {
      this.events.goTo(pair);
      return;
    }
    const adds = event.key === ' ' || (event.shiftKey && step !== undefined);
    this.events.pick(pair, adds);
    this.options.get(pair)?.scrollIntoView({ block: 'nearest' });
  }

  private point(): void {
    const pair = this.order[this.focused];
    for (const [p, option] of this.options) option.classList.toggle('focused', p === pair);
    setAttribute(this.rows, 'aria-activedescendant', pair === undefined ? undefined : `${this.idPrefix}-${pair}`);
  }
}

function inOrder(
  { jointMost, jointMean }: Distances,
  labels: readonly JointLabel[],
  order: DistanceView['order'],
): readonly number[] {
  const pairs = [...jointMost.keys()];
  const byName = (a: number, b: number) => labels[a].name.localeCompare(labels[b].name, 'en', { numeric: true });
  if (order === 'name') return pairs.sort(byName);
  const by = order === 'mean' ? jointMean : jointMost;
  return pairs.sort((a, b) => by[b] - by[a]);
}

function isOn({ target }: Event, selector: string): boolean {
  return target instanceof Element && target.closest(selector) !== null;
}

function pairAt(event: Event): number | undefined {
  const row = event.target instanceof Element ? event.target.closest<HTMLElement>('[data-pair]') : null;
  return row ? Number(row.dataset.pair) : undefined;
}
