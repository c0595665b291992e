/** One step: a formula, what it does in words, and its numbers. */

import { determinant3 } from '../../../math/mat4.ts';
import { orthonormalityError } from '../../../teaching/steps/matrix-facts.ts';
import { element, setText } from '../../widgets/dom.ts';
import { type GridOptions, NumberGrid } from '../../widgets/numbers/number-grid.ts';
import { errorSize } from '../../widgets/numbers/number-text.ts';
import { setTooltip } from '../../widgets/tooltip.ts';

/** Characters that fit into a card. */
const LONG_LAW = 42;

export class Card {
  readonly element: HTMLElement;
  private readonly note = element('p', { class: 'step-law' });

  /** @param title accessible name; the formula is what is seen */
  constructor(
    readonly title: string,
    formula: HTMLElement | string,
    law = '',
  ) {
    this.say(law);
    this.element = element(
      'section',
      { class: 'step-card', 'aria-label': title },
      element('h3', { class: 'step-head' }, formula),
      this.note,
    );
    this.element.classList.toggle('step-long', law.length > LONG_LAW);
  }

  /** What is said below the formula. */
  say(law: string): void {
    if (this.note.textContent === law) return;
    setText(this.note, law);
    setTooltip(this.note, law);
  }

  grid(options: Omit<GridOptions, 'label'>, label = this.title): NumberGrid {
    const made = new NumberGrid({ ...options, label });
    this.element.append(made.element);
    return made;
  }
}

/** Shows a matrix and how orthonormal it is. Returns a function that sets it. */
export function matrixCard(card: Card): (matrix: Float64Array) => void {
  card.element.classList.add('step-matrix');
  const grid = card.grid({ rows: 4, columns: 4 });
  const facts = card.grid(
    { rows: 1, columns: 2, columnLabels: ['|RᵀR − I|', 'det'], text: factText },
    `${card.title}: orthonormality error and determinant`,
  );
  return (matrix) => {
    grid.setMatrix(matrix);
    facts.setRow(0, [orthonormalityError(matrix), determinant3(matrix)]);
  };
}

function factText(value: number): string {
  return value < 0 ? `−${errorSize(-value)}` : errorSize(value);
}

/** Between cards. */
export function operator(text: string): HTMLElement {
  return element('span', { class: 'step-operator', 'aria-hidden': 'true' }, text);
}
