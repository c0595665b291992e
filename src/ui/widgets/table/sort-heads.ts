/** The header of a table whose columns can be sorted: a button each, with an arrow at the one of the order. */
import { element, setAttribute } from '../dom.ts';
import { icon } from '../icons.ts';

export type SortColumn<C extends string> = readonly [column: C, label: string, className: string, tooltip: string];

export interface SortOrder<C extends string> {
  readonly column: C;
  readonly descending: boolean;
}

export class SortHeads<C extends string> {
  /** The first row of a grid. */
  readonly element: HTMLElement;
  private readonly heads = new Map<C, HTMLElement>();

  /**
   * @param first header of a column before them that can't be sorted
   * @param sort a header was clicked
   */
  constructor(
    className: string,
    columns: readonly SortColumn<C>[],
    sort: (column: C) => void,
    first?: { readonly label: string },
  ) {
    this.element = element('div', { class: `sort-head ${className}`, role: 'row', 'aria-rowindex': 1 });
    if (first) {
      this.element.append(element('div', { role: 'columnheader', class: 'sort-cell', 'aria-label': first.label }));
    }
    for (const [column, label, cellClass, tooltip] of columns) {
      const made = element(
        'button',
        {
          type: 'button',
          role: 'columnheader',
          class: cellClass,
          tabindex: -1,
          tooltip: `${tooltip}. Click to sort`,
        },
        element('span', {}, label),
      );
      // The table keeps the focus.
      made.addEventListener('mousedown', (event) => event.preventDefault());
      made.addEventListener('click', () => sort(column));
      this.heads.set(column, made);
      this.element.append(made);
    }
  }

  /** CSS pixels. */
  get height(): number {
    return this.element.offsetHeight;
  }

  /** @param order absent: by no column */
  show(order: SortOrder<C> | undefined): void {
    for (const [column, head] of this.heads) {
      const isOrder = order?.column === column;
      setAttribute(head, 'aria-sort', isOrder ? (order.descending ? 'descending' : 'ascending') : undefined);
      const arrow = head.querySelector('.icon');
      if (isOrder && !arrow) head.append(icon('fold'));
      else if (!isOrder) arrow?.remove();
    }
  }
}
