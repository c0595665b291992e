/** Formulas on the page: a symbol under the pointer or with the focus lights up what it stands for; a click selects it. */

import type { Character } from '../../../model/document.ts';
import { characterDofs } from '../../../model/skeleton/dofs.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import type { Formula, FormulaSymbol, Meaning } from '../../../teaching/steps/formula.ts';
import type { Uses } from '../../state/workbench.ts';
import { element } from '../../widgets/dom.ts';
import { chooseDof } from '../posing/active-dof.ts';

export class FormulaView {
  private isLit = false;

  constructor(private readonly wb: Uses<'store' | 'viewport' | 'posing'>) {}

  /** Symbols are buttons. */
  make(formula: Formula, character: Character): HTMLElement {
    const made = element('span', { class: 'formula' });
    for (const part of formula) made.append(typeof part === 'string' ? part : this.symbol(part, character));
    return made;
  }

  symbol({ text, means }: FormulaSymbol, character: Character): HTMLButtonElement {
    const tooltip = meaningText(means, character);
    const label = `${text}: ${tooltip}`;
    const made = element('button', { type: 'button', class: 'symbol', tooltip, 'aria-label': label }, text);
    const on = () => this.light(means, character);
    const off = () => this.lightNothing();
    made.addEventListener('pointerenter', on);
    made.addEventListener('focus', on);
    made.addEventListener('pointerleave', off);
    made.addEventListener('blur', off);
    made.addEventListener('click', () => this.choose(means, character));
    return made;
  }

  /** Call when symbols are removed. */
  lightNothing(): void {
    if (!this.isLit) return;
    this.isLit = false;
    this.wb.viewport.pointing.hover(undefined);
    this.wb.posing.litDof.set(undefined);
  }

  private light(means: Meaning, character: Character): void {
    const { viewport, posing } = this.wb;
    this.isLit = true;
    const { id: characterId } = character;
    if (means.kind === 'dof') posing.litDof.set({ characterId, dof: means.dof });
    else viewport.pointing.hover({ characterId, placement: viewport.pickedCopy(character), joint: means.joint });
  }

  private choose(means: Meaning, character: Character): void {
    if (means.kind === 'joint') this.wb.store.select({ characterId: character.id, joint: means.joint });
    else chooseDof(this.wb, means.dof);
  }
}

/** `W₇` is `Joint hip_03_r`, `rz` is `DOF rz of hip_03_r`. */
export function meaningText(means: Meaning, { skeleton, morphs }: Character): string {
  if (means.kind === 'joint') return `Joint ${jointName(skeleton, means.joint)}`;
  const dof = characterDofs(skeleton, morphs)[means.dof];
  if (!dof) return 'DOF';
  return dof.joint < 0 ? `Weight of morph ${dof.name}` : `DOF ${dof.name} of ${jointName(skeleton, dof.joint)}`;
}
