/** The mark after the name of a DOF of several joints whose values differ: the slider shows only the active one's. */
import type { CharacterDof } from '../../../model/skeleton/dofs.ts';
import { shownPerUnit, unitText } from '../../state/joints/angles.ts';
import type { Settings } from '../../state/settings.ts';
import { element, setAttribute, write } from '../../widgets/dom.ts';
import { shown } from '../../widgets/numbers/number-text.ts';
import type { Slider } from '../../widgets/numbers/slider.ts';
import { setTooltip } from '../../widgets/tooltip.ts';

/** Differences that a number with three decimals wouldn't show. */
const SAME = 1e-6;

export class DifferMark {
  readonly element = element('span', { class: 'dof-differs', hidden: true }, '≠');
  private text = '';

  constructor(
    private readonly slider: Slider,
    private readonly dof: CharacterDof,
    private readonly angles: Settings['angles'],
  ) {}

  /** @param of indices of the DOFs into `dofs` */
  show(dofs: ArrayLike<number>, of: readonly number[]): void {
    let low = Number.POSITIVE_INFINITY;
    let high = Number.NEGATIVE_INFINITY;
    for (const index of of) {
      const value = dofs[index] ?? 0;
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
    const differs = high - low > SAME;
    write(this.element, 'hidden', !differs);
    const text = differs ? `Mixed: ${this.valueText(low)} to ${this.valueText(high)}` : '';
    if (text === this.text) return;
    this.text = text;
    setTooltip(this.element, text || undefined);
    setAttribute(this.slider.field, 'aria-description', text || undefined);
  }

  private valueText(value: number): string {
    const { unit } = this.dof;
    return `${shown(value * shownPerUnit(unit, this.angles))}${unitText(unit, this.angles)}`;
  }
}
