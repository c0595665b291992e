/**
 * The skin style *Four attachments*: how far each vertex would be from where it is drawn, in a program that keeps four
 * attachments of each. The skin as a heat map, and a card with its legend and the numbers of the current character.
 */

import { type Character, shownSkin } from '../../../model/document.ts';
import { sentenceOf } from '../../../model/failure.ts';
import { type Skin, vertexCount } from '../../../model/skin.ts';
import {
  FourAttachments,
  type FourFacts,
  KEPT_FOUR,
  type KeptFour,
} from '../../../teaching/program/four-attachments.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import { followWithNumbers } from '../../state/follow-time.ts';
import { heatLegend } from '../../state/heat-legend.ts';
import { lengthUnit } from '../../state/joints/length-unit.ts';
import type { Uses } from '../../state/workbench.ts';
import { element, setAttribute, setText, uniqueId, write } from '../../widgets/dom.ts';
import { oncePerFrame } from '../../widgets/frame.ts';
import { icon } from '../../widgets/icons.ts';
import { inSlices } from '../../widgets/in-slices.ts';
import { NumberGrid } from '../../widgets/numbers/number-grid.ts';
import { aligned, count } from '../../widgets/numbers/number-text.ts';
import { attachmentsText, heatScale, KEPT_LABELS, scaleText } from './four-text.ts';

const DECIMALS = 6;
/** Where the card would cover the skin. */
const SMALL = '(max-width: 767px), (max-height: 719px)';

type Parts = Uses<'store' | 'transport' | 'viewport' | 'settings' | 'messages'>;

/** A character whose skin is measured. */
interface Measured {
  readonly character: Character;
  readonly skin: Skin;
  readonly kept: KeptFour;
  readonly four: FourAttachments;
  readonly heat: Float32Array;
  facts?: FourFacts;
}

export function fourCard(wb: Parts): HTMLElement {
  return new FourCard(wb).element;
}

class FourCard {
  readonly element = element('section', { class: 'heat-card', 'aria-label': 'Four attachments' });
  private readonly body = element('div', { class: 'heat-card-body', id: uniqueId('four') });
  private readonly head = element('button', { type: 'button', class: 'heat-card-head', 'aria-controls': this.body.id });
  private readonly legend = heatLegend('Displacement with four attachments, from dark (none) to light (most)');
  private readonly choice = element('select', { 'aria-label': 'Which attachments are kept' });
  private readonly text = element('p');
  private readonly largest = element('div', {}, element('p', { class: 'faint' }, 'Largest displacement'));
  private readonly vertex = element('button', { type: 'button', class: 'link' });
  private grid: NumberGrid | undefined;
  private measured: readonly Measured[] = [];
  private isRunning = false;
  /** Something has changed since the running measurement began. */
  private isStale = false;
  private readonly showSoon = oncePerFrame(() => this.show());

  constructor(private readonly wb: Parts) {
    for (const kept of KEPT_FOUR) this.choice.append(element('option', { value: kept }, KEPT_LABELS[kept]));
    this.choice.addEventListener('change', () => this.show());
    this.vertex.addEventListener('click', () => this.select());
    this.head.append('Four attachments', icon('fold'));
    this.head.addEventListener('click', () => this.fold(!this.body.hidden));
    const about = element(
      'p',
      { class: 'faint' },
      'How far off a program is that keeps only four attachments per vertex.',
    );
    this.body.append(about, this.choice, this.text, this.largest);
    this.element.append(this.head, this.legend.element, this.body);
    this.fold(matchMedia(SMALL).matches);
    wb.store.subscribe(() => this.showSoon());
    wb.settings.subscribe((now, before) => {
      if (now.display.skin !== before.display.skin) this.showSoon();
    });
    followWithNumbers(wb.transport, () => this.show());
    this.show();
  }

  private get kept(): KeptFour {
    return KEPT_FOUR.find((kept) => kept === this.choice.value) ?? KEPT_FOUR[0];
  }

  /** Folded, it is the legend alone. */
  private fold(isFolded: boolean): void {
    write(this.body, 'hidden', isFolded);
    setAttribute(this.head, 'aria-expanded', String(!isFolded));
  }

  private show(): void {
    const { wb } = this;
    const isOn = wb.settings.get().display.skin === 'four';
    this.measured = isOn ? wb.store.document.characters.flatMap((character) => this.measuredOf(character)) : [];
    write(this.element, 'hidden', this.measured.length === 0);
    if (this.measured.length > 0) this.measure();
  }

  /** What is measured of a character: what it was if that still counts, nothing without a visible skin. */
  private measuredOf(character: Character): Measured[] {
    const skin = shownSkin(character);
    if (!skin || character.isHidden) return [];
    const { kept } = this;
    const before = this.measured.find((one) => one.character.id === character.id);
    if (before?.skin === skin && before.kept === kept && before.character.morphs === character.morphs) {
      return [before.character === character ? before : { ...before, character }];
    }
    const four = new FourAttachments(skin, character.morphs, kept);
    return [{ character, skin, kept, four, heat: new Float32Array(vertexCount(skin)) }];
  }

  /** Large skins take several frames; what changes meanwhile is measured after that. */
  private measure(): void {
    if (this.isRunning) {
      this.isStale = true;
      return;
    }
    this.isRunning = true;
    this.isStale = false;
    const { measured } = this;
    const end = () => {
      this.isRunning = false;
      if (this.isStale) this.show();
    };
    inSlices(this.steps(measured), {
      isOver: () => false,
      progress: () => {},
      done: () => {
        this.draw(measured);
        end();
      },
      failed: (error) => {
        this.wb.messages.note(`Four attachments: ${sentenceOf(error)}`, 'error');
        end();
      },
    });
  }

  private *steps(measured: readonly Measured[]): Generator<number, void> {
    for (const one of measured) {
      const { character, four } = one;
      const drawn = this.wb.viewport.character(character.id);
      if (drawn) one.facts = yield* four.follow(drawn.dofs, character.skeleton && drawn.worlds);
    }
  }

  private draw(measured: readonly Measured[]): void {
    const parts = measured.map(({ facts }) => (facts ? facts.largest / facts.size : 0));
    const scale = heatScale(Math.max(...parts));
    for (const { character, four, heat, facts } of measured) {
      const perUnit = facts && scale > 0 ? 1 / (scale * facts.size) : 0;
      for (let v = 0; v < heat.length; v++) heat[v] = perUnit * four.displacements[v];
      this.wb.viewport.heatSkin(character.id, heat);
    }
    this.legend.show(scaleText(scale));
    const told = this.told(measured);
    if (told) this.tell(told);
  }

  /** The one whose numbers are shown: the current character, if its skin is visible. */
  private told(measured: readonly Measured[]): Measured | undefined {
    const id = currentCharacter(this.wb)?.id;
    return measured.find(({ character }) => character.id === id) ?? measured[0];
  }

  private tell({ character, skin, four, facts }: Measured): void {
    setText(this.text, attachmentsText(skin, character.skeleton !== undefined, four));
    const unit = lengthUnit(character);
    const grid = this.gridFor(unit);
    const isDisplaced = facts?.vertex !== undefined && heatScale(facts.largest / facts.size) > 0;
    write(this.largest, 'hidden', !isDisplaced);
    if (!facts || !isDisplaced) return;
    setText(this.vertex, `vertex ${count(facts.vertex ?? 0)}`);
    grid.set(0, 0, facts.largest);
    grid.set(0, 1, (100 * facts.largest) / facts.size);
  }

  /** Its column is named by the unit. */
  private gridFor(unit: string): NumberGrid {
    if (this.grid && this.grid.element.dataset.unit === unit) return this.grid;
    const grid = new NumberGrid({
      label: 'Largest displacement',
      rows: 1,
      columns: 2,
      rowLabels: [this.vertex],
      columnLabels: [unit, '% of size'],
      text: (value) => aligned(Number(value.toPrecision(4)), DECIMALS).replace(/(\.\d*?)0+$/, '$1'),
    });
    write(grid.element.dataset, 'unit', unit);
    this.grid?.element.remove();
    this.largest.append(grid.element);
    this.grid = grid;
    return grid;
  }

  private select(): void {
    const { character, facts } = this.told(this.measured) ?? {};
    if (character && facts?.vertex !== undefined) {
      this.wb.store.select({ characterId: character.id, vertex: facts.vertex });
    }
  }
}
