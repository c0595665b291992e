/** The steps of a vertex: morphs, then a row for each attachment, and the same for its normal. */

import { compileSkeleton, worldMatrices } from '../../../evaluate/kinematics.ts';
import type { Vec3 } from '../../../math/vec3.ts';
import type { Character } from '../../../model/document.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import type { Skin } from '../../../model/skin.ts';
import { type PoseSteps, stepsOfPose } from '../../../teaching/steps/dof-steps.ts';
import { dofSymbol, jointSymbol } from '../../../teaching/steps/formula.ts';
import {
  type AttachmentStep,
  type MorphTerm,
  type VertexSteps,
  vertexStepper,
} from '../../../teaching/steps/vertex-steps.ts';
import { element } from '../../widgets/dom.ts';
import type { NumberGrid } from '../../widgets/numbers/number-grid.ts';
import { Card, operator } from './card.ts';
import type { FormulaView } from './formula-view.ts';
import { vertexStages } from './stages.ts';
import type { StepsView } from './view.ts';

const AXES = ['x', 'y', 'z'];

export function vertexView(formulas: FormulaView, character: Character, skin: Skin, vertex: number): StepsView {
  const step = vertexStepper(skin, character.morphs, vertex);
  const computed = (pose: PoseSteps) => step(pose.dofs, worldOf(pose));
  const first = computed(stepsOfPose(character, 0));
  let steps = first;
  const fills: ((now: VertexSteps) => void)[] = [];
  const row = element('div', { class: 'steps-row' });
  const point = (formula: string, law: string, of: (now: VertexSteps) => Vec3) => {
    const card = new Card(formula, formula, law);
    card.element.classList.add('step-point');
    const grid = card.grid({ rows: 1, columns: 3, columnLabels: AXES });
    fills.push((now) => grid.setRow(0, of(now)));
    return card.element;
  };
  const table = (formula: string, law: string, rows: number, columnLabels: readonly string[]) => {
    const card = new Card(formula, formula, law);
    card.element.classList.add('step-table');
    return { card, grid: card.grid({ rows, columns: columnLabels.length, columnLabels }) };
  };
  const morphs = (symbol: string, of: (now: VertexSteps) => readonly MorphTerm[]) => {
    const terms = of(first);
    const firstMorph = stepsOfPose(character, 0).dofs.length - character.morphs.length;
    const card = new Card(`${symbol}: morph weights`, 'φ', 'weight of each morph');
    card.element.classList.add('step-weights');
    const weights = card.grid({
      rows: terms.length,
      columns: 1,
      columnLabels: ['φ'],
      rowLabels: terms.map(({ morph }) =>
        formulas.symbol(dofSymbol(character.morphs[morph].name, firstMorph + morph), character),
      ),
    });
    const difference = table(`${symbol}ₜ − ${symbol}₀`, 'of the morph', terms.length, AXES);
    const term = table(`φ · (${symbol}ₜ − ${symbol}₀)`, 'weighted', terms.length, AXES);
    const sum = table(`${symbol}₀ + Σ`, 'sum so far', terms.length, AXES);
    fills.push((now) => {
      of(now).forEach((each, i) => {
        weights.set(i, 0, each.weight);
        difference.grid.setRow(i, each.difference);
        term.grid.setRow(i, each.term);
        sum.grid.setRow(i, each.sum);
      });
    });
    row.append(operator('+'), card.element, operator('·'), difference.card.element, operator('='), term.card.element);
    row.append(operator('→'), sum.card.element);
    return sum.card.element;
  };
  const columns = (
    shown: readonly (readonly [operator: string, formula: string, law: string, of: (one: AttachmentStep) => Vec3])[],
  ) =>
    shown.map(([sign, formula, law, of]) => {
      const { card, grid } = table(formula, law, first.attachments.length, AXES);
      fills.push((now) => fillRows(grid, now.attachments, of));
      row.append(operator(sign), card.element);
      return card.element;
    });

  const base = point('v₀', 'position in the file', (now) => now.base);
  row.append(base);
  const blended = first.morphs.length > 0 ? morphs('v', (now) => now.morphs) : undefined;
  let moved: HTMLElement | undefined;
  let position: HTMLElement | undefined;
  if (first.attachments.length > 0) {
    row.append(operator('→'), jointsCard(formulas, character, first, fills));
    const made = columns([
      ['·', 'B⁻¹ · v', 'in the joint’s space', (one) => one.inJoint],
      ['→', 'W · B⁻¹ · v', 'where this joint alone would put v', (one) => one.moved],
      ['→', 'w · (W · B⁻¹ · v)', 'weighted', (one) => one.term],
      ['→', 'Σ', 'sum so far', (one) => one.sum],
    ]);
    moved = made[1];
    position = point('v′', 'position as drawn', (now) => now.position);
    row.append(operator('='), position);
  }
  row.append(
    element('span', { class: 'steps-gap' }),
    point('n₀', normalSource(skin), (now) => now.baseNormal),
  );
  if (first.normalMorphs.length > 0) morphs('n', (now) => now.normalMorphs);
  if (first.attachments.length > 0) {
    columns([
      ['→', '(W · B⁻¹)⁻ᵀ · n', 'rotated by each joint', (one) => one.turned],
      ['→', 'w · ((W · B⁻¹)⁻ᵀ · n)', 'weighted', (one) => one.normalTerm],
      ['→', 'Σ', 'sum so far', (one) => one.normalSum],
    ]);
  }
  row.append(
    operator('→'),
    point('n′ = n / |n|', 'normal as drawn', (now) => now.normal),
  );
  const stages = vertexStages(first).labels.length;
  const before = blended ? [base, blended] : [base];
  const after = position ? [position] : [];
  const middle = Array.from({ length: stages - before.length - after.length }, () => moved ?? base);
  return {
    element: row,
    cards: [...before, ...middle, ...after],
    follow(pose) {
      steps = computed(pose);
      return vertexStages(steps);
    },
    fill() {
      for (const fill of fills) fill(steps);
    },
  };
}

function normalSource({ normals }: Skin): string {
  return normals ? 'normal in the file' : 'normal, from the triangles';
}

function fillRows(grid: NumberGrid, all: readonly AttachmentStep[], of: (one: AttachmentStep) => Vec3): void {
  all.forEach((one, i) => {
    grid.setRow(i, of(one));
  });
}

function jointsCard(
  formulas: FormulaView,
  character: Character,
  { attachments }: VertexSteps,
  fills: ((now: VertexSteps) => void)[],
): HTMLElement {
  const card = new Card('Attachments: weights', 'w', 'weight of each joint');
  card.element.classList.add('step-weights');
  const rowLabels = attachments.map(({ joint }) => {
    const symbol = formulas.symbol(jointSymbol('W', joint), character);
    return element('span', { class: 'step-joint' }, symbol, ` ${jointName(character.skeleton, joint)}`);
  });
  const grid = card.grid({ rows: attachments.length, columns: 1, columnLabels: ['w'], rowLabels });
  fills.push((now) => {
    now.attachments.forEach(({ weight }, i) => {
      grid.set(i, 0, weight);
    });
  });
  return card.element;
}

/** Undefined without a skeleton. */
function worldOf({ character: { skeleton }, dofs }: PoseSteps): Float64Array | undefined {
  if (!skeleton) return undefined;
  const world = new Float64Array(16 * skeleton.joints.length);
  worldMatrices(compileSkeleton(skeleton), dofs, world);
  return world;
}
