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
  return new VertexView(formulas, character, skin, vertex);
}

/** Sign before a column of attachments, its formula, its law, and its numbers. */
type Column = readonly [operator: string, formula: string, law: string, of: (one: AttachmentStep) => Vec3];

class VertexView implements StepsView {
  readonly element = element('div', { class: 'steps-row' });
  readonly cards: readonly HTMLElement[];
  private readonly computed: (pose: PoseSteps) => VertexSteps;
  private readonly first: VertexSteps;
  private steps: VertexSteps;
  private readonly fills: ((now: VertexSteps) => void)[] = [];

  constructor(
    private readonly formulas: FormulaView,
    private readonly character: Character,
    skin: Skin,
    vertex: number,
  ) {
    const step = vertexStepper(skin, character.morphs, vertex);
    this.computed = (pose) => step(pose.dofs, worldOf(pose));
    this.first = this.computed(stepsOfPose(character, 0));
    this.steps = this.first;
    this.cards = this.addPosition();
    this.addNormal(skin);
  }

  follow(pose: PoseSteps) {
    this.steps = this.computed(pose);
    return vertexStages(this.steps);
  }

  fill(): void {
    for (const fill of this.fills) fill(this.steps);
  }

  /** Returns the cards of its stages. */
  private addPosition(): readonly HTMLElement[] {
    const { first, element: row } = this;
    const base = this.point('v₀', 'position in the file', (now) => now.base);
    row.append(base);
    const before = first.morphs.length > 0 ? [base, this.addMorphs('v', (now) => now.morphs)] : [base];
    let moved = base;
    const after: HTMLElement[] = [];
    if (first.attachments.length > 0) {
      row.append(operator('→'), jointsCard(this.formulas, this.character, first, this.fills));
      moved = this.addColumns([
        ['·', 'B⁻¹ · v', 'in the joint’s space', (one) => one.inJoint],
        ['→', 'W · B⁻¹ · v', 'where this joint alone would put v', (one) => one.moved],
        ['→', 'w · (W · B⁻¹ · v)', 'weighted', (one) => one.term],
        ['→', 'Σ', 'sum so far', (one) => one.sum],
      ])[1];
      after.push(this.point('v′', 'position as drawn', (now) => now.position));
      row.append(operator('='), ...after);
    }
    const stages = vertexStages(first).labels.length;
    const middle = Array.from({ length: stages - before.length - after.length }, () => moved);
    return [...before, ...middle, ...after];
  }

  private addNormal(skin: Skin): void {
    const { first, element: row } = this;
    row.append(
      element('span', { class: 'steps-gap' }),
      this.point('n₀', normalSource(skin), (now) => now.baseNormal),
    );
    if (first.normalMorphs.length > 0) this.addMorphs('n', (now) => now.normalMorphs);
    if (first.attachments.length > 0) {
      this.addColumns([
        ['→', '(W · B⁻¹)⁻ᵀ · n', 'rotated by each joint', (one) => one.turned],
        ['→', 'w · ((W · B⁻¹)⁻ᵀ · n)', 'weighted', (one) => one.normalTerm],
        ['→', 'Σ', 'sum so far', (one) => one.normalSum],
      ]);
    }
    row.append(
      operator('→'),
      this.point('n′ = n / |n|', 'normal as drawn', (now) => now.normal),
    );
  }

  private point(formula: string, law: string, of: (now: VertexSteps) => Vec3): HTMLElement {
    const card = new Card(formula, formula, law);
    card.element.classList.add('step-point');
    const grid = card.grid({ rows: 1, columns: 3, columnLabels: AXES });
    this.fills.push((now) => grid.setRow(0, of(now)));
    return card.element;
  }

  private addColumns(columns: readonly Column[]): readonly HTMLElement[] {
    return columns.map(([sign, formula, law, of]) => {
      const { card, grid } = table(formula, law, this.first.attachments.length);
      this.fills.push((now) => fillRows(grid, now.attachments, of));
      this.element.append(operator(sign), card.element);
      return card.element;
    });
  }

  /** Returns the card of the sum. */
  private addMorphs(symbol: string, of: (now: VertexSteps) => readonly MorphTerm[]): HTMLElement {
    const { character, formulas } = this;
    const terms = of(this.first);
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
    const difference = table(`${symbol}ₜ − ${symbol}₀`, 'of the morph', terms.length);
    const term = table(`φ · (${symbol}ₜ − ${symbol}₀)`, 'weighted', terms.length);
    const sum = table(`${symbol}₀ + Σ`, 'sum so far', terms.length);
    this.fills.push((now) => {
      of(now).forEach((each, i) => {
        weights.set(i, 0, each.weight);
        difference.grid.setRow(i, each.difference);
        term.grid.setRow(i, each.term);
        sum.grid.setRow(i, each.sum);
      });
    });
    this.element.append(
      ...[operator('+'), card.element, operator('·'), difference.card.element, operator('='), term.card.element],
      ...[operator('→'), sum.card.element],
    );
    return sum.card.element;
  }
}

function table(formula: string, law: string, rows: number) {
  const card = new Card(formula, formula, law);
  card.element.classList.add('step-table');
  return { card, grid: card.grid({ rows, columns: AXES.length, columnLabels: AXES }) };
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
