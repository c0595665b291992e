/** The steps of a joint: its DOFs, the factors of its local matrix, and the way to its world matrix. */

import type { Character } from '../../../model/document.ts';
import { UNLIMITED } from '../../../model/skeleton/skeleton.ts';
import { type DofStep, stepsOfPose } from '../../../teaching/steps/dof-steps.ts';
import { dofSymbol, type Formula, formulaText, jointSymbol } from '../../../teaching/steps/formula.ts';
import { type JointSteps, stepsOfJoint } from '../../../teaching/steps/joint-steps.ts';
import { element } from '../../widgets/dom.ts';
import { shown } from '../../widgets/numbers/number-text.ts';
import { channelName, namedChannel } from '../timeline/channels.ts';
import { Card, matrixCard, operator } from './card.ts';
import type { FormulaView } from './formula-view.ts';
import { jointStages } from './stages.ts';
import type { StepsView } from './view.ts';

/** Undefined if the character has no such joint. */
export function jointView(formulas: FormulaView, character: Character, joint: number): StepsView | undefined {
  const first = stepsOfJoint(stepsOfPose(character, 0), joint);
  if (!first) return undefined;
  let steps: JointSteps = first;
  const fills: ((now: JointSteps) => void)[] = [];
  const row = element('div', { class: 'steps-row' });
  const matrix = (formula: Formula, law: string, of: (now: JointSteps) => Float64Array) => {
    const card = new Card(formulaText(formula), formulas.make(formula, character), law);
    const set = matrixCard(card);
    fills.push((now) => set(of(now)));
    return card.element;
  };
  if (first.values.length > 0) row.append(valuesCard(formulas, character, first, fills), operator('→'));
  const factors = first.factors.map(({ symbol, law }, i) => matrix(symbol, law, (now) => now.factors[i].matrix));
  for (const [i, card] of factors.entries()) row.append(...(i ? [operator('·')] : []), card);
  const local = matrix([jointSymbol('L', joint)], 'relative to the parent', (now) => now.local);
  row.append(operator('='), local);
  const parent = first.parent;
  const start =
    parent < 0 ? undefined : matrix([jointSymbol('W', parent)], 'world matrix of the parent', (now) => now.parentWorld);
  if (start)
    row.append(element('span', { class: 'steps-gap' }), start, operator('·'), localAgain(formulas, character, joint));
  const world = matrix([jointSymbol('W', joint)], formulaText(first.worldFormula), (now) => now.world);
  row.append(operator('='), world);
  return {
    element: row,
    cards: [start ?? factors[0], ...factors.slice(0, -1), world],
    follow(pose) {
      steps = stepsOfJoint(pose, joint) ?? steps;
      return jointStages(steps);
    },
    fill() {
      for (const fill of fills) fill(steps);
    },
  };
}

/** The local matrix in the product with that of the parent: its numbers are beside it. */
function localAgain(formulas: FormulaView, character: Character, joint: number): HTMLElement {
  const symbol = formulas.make([jointSymbol('L', joint)], character);
  return element('span', { class: 'step-again' }, symbol);
}

function valuesCard(
  formulas: FormulaView,
  character: Character,
  { values }: JointSteps,
  fills: ((now: JointSteps) => void)[],
): HTMLElement {
  const card = new Card('DOFs: given, limits, used', 'given → limits → used');
  card.element.classList.add('step-values');
  const grid = card.grid({
    rows: values.length,
    columns: 4,
    rowLabels: values.map(({ name, dof }) => formulas.symbol(dofSymbol(name, dof), character)),
    columnLabels: ['given', 'min', 'max', 'used'],
  });
  fills.push((now) => {
    now.values.forEach(({ given, limit, value }, i) => {
      grid.setRow(i, [given, ...limitShown(limit), value]);
    });
    card.say(sourcesText(now.values, (dof) => channelName(namedChannel(character, dof))));
  });
  return card.element;
}

/** As the inspector shows them: infinite if unlimited. */
function limitShown([min, max] = NO_LIMIT): readonly [number, number] {
  return [min <= UNLIMITED.min ? NO_LIMIT[0] : min, max >= UNLIMITED.max ? NO_LIMIT[1] : max];
}
const NO_LIMIT: readonly [number, number] = [Number.NEGATIVE_INFINITY, Number.POSITIVE_INFINITY];

const SOURCES = {
  channel: 'from the take',
  pose: 'from the pose',
  unkeyed: 'unkeyed',
  retargeted: 'retargeted',
} as const;

/** `rx ry from the take; rz = 2 · leader r + 0.25; radians`. @param nameOf a DOF */
export function sourcesText(values: readonly DofStep[], nameOf: (dof: number) => string): string {
  const parts = Object.entries(SOURCES).flatMap(([source, text]) => {
    const names = values.filter((value) => value.source === source).map(({ name }) => name);
    return names.length > 0 ? [`${names.join(' ')} ${text}`] : [];
  });
  const links = values.flatMap(({ name, link }) =>
    link ? [`${name} = ${shown(link.gain)} · ${nameOf(link.follows)} ${signed(link.offset)}`] : [],
  );
  const unit = values.some((value) => value.unit === 'angle') ? ['radians'] : [];
  return [...parts, ...links, ...unit].join('; ');
}

function signed(value: number): string {
  return value < 0 ? `− ${shown(-value)}` : `+ ${shown(value)}`;
}
