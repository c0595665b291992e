/** Yours and Marrow’s side by side, and the difference: of a joint, a vertex, a normal or a channel. */

import { perObject } from '../../../model/per-object.ts';
import type { Joint } from '../../../model/skeleton/skeleton.ts';
import { relativeMatrices } from '../../../teaching/compare/relative.ts';
import type { FrameTarget } from '../../../teaching/compare/targets.ts';
import type { ComparedResult } from '../../state/dump-comparison.ts';
import { button, element, setAttribute, setText, write } from '../../widgets/dom.ts';
import { NumberGrid } from '../../widgets/numbers/number-grid.ts';
import { aligned, decimalsWithin } from '../../widgets/numbers/number-text.ts';
import { numberText, powerText } from './banner-text.ts';
import type { RowKind } from './compared-rows.ts';

/** What of a joint is shown. */
export const JOINT_NUMBERS = ['world', 'local', 'positions'] as const;
export type JointNumbers = (typeof JOINT_NUMBERS)[number];

export interface DetailSubject {
  readonly result: ComparedResult;
  /** Into the frames; −1 for channels. */
  readonly frame: number;
  readonly kind: RowKind;
  /** Index of the joint, vertex or channel. */
  readonly index: number;
  readonly numbers: JointNumbers;
}

/** Samples of a channel listed at most: those that are wrong; all that were compared, if that is asked for. */
const MAX_SAMPLES = 60;
const MAX_ALL_SAMPLES = 600;

/** Which numbers of joints a dump gives, or lets be computed. */
export function jointNumbersIn(theirs: FrameTarget | undefined): readonly JointNumbers[] {
  if (!theirs) return [];
  const { world, local, positions } = theirs;
  return JOINT_NUMBERS.filter((what) =>
    what === 'world' ? world : what === 'local' ? (local ?? world) : positions && !world,
  );
}

export class Detail {
  readonly element = element('div', { class: 'compare-detail-body' });
  private readonly cards = element('div', { class: 'compare-grids' });
  private readonly note = element('span', { class: 'faint' });
  private readonly all: HTMLButtonElement;
  /** Whether samples that agree are listed too. */
  private showsAll = false;
  private subject: DetailSubject | undefined;
  private shape = '';
  private grids: readonly NumberGrid[] = [];

  constructor() {
    this.all = button('List all', { class: 'link', tooltip: undefined }, 'List all', () => {
      this.showsAll = !this.showsAll;
      if (this.subject) this.show(this.subject);
    });
    this.element.append(element('div', { class: 'compare-note' }, this.note, this.all), this.cards);
  }

  show(subject: DetailSubject): void {
    const { kind, numbers } = subject;
    this.subject = subject;
    write(this.all, 'hidden', true);
    setText(this.note, '');
    if (kind === 'channels') this.showChannel(subject);
    else if (kind === 'joints' && numbers !== 'positions') this.showMatrix(subject, numbers);
    else this.showPoint(subject);
  }

  private showMatrix({ result, frame, index }: DetailSubject, numbers: 'world' | 'local'): void {
    this.build('matrix', () =>
      ['Yours', 'Marrow’s', 'Yours − Marrow’s'].map((label, i) =>
        cardOf(
          label,
          new NumberGrid({ label, rows: 4, columns: 4, ...(i === 2 && { text: differenceText }) }),
          'compare-matrix',
        ),
      ),
    );
    const theirs = matricesOf(result, frame, numbers, 'theirs');
    const ours = matricesOf(result, frame, numbers, 'ours');
    if (!theirs || !ours) return;
    const { size } = result.comparison.frames[frame];
    const o = 16 * index;
    this.grids[0].setMatrix(theirs, o);
    this.grids[1].setMatrix(ours, o);
    for (let c = 0; c < 4; c++) {
      for (let r = 0; r < 4; r++) {
        const difference = theirs[o + 4 * c + r] - ours[o + 4 * c + r];
        this.grids[2].set(r, c, difference);
        const isWrong = !(Math.abs(difference) / (c === 3 ? size : 1) <= result.tolerance);
        this.grids[0].mark(r, c, isWrong);
        this.grids[2].mark(r, c, isWrong);
      }
    }
  }

  private showPoint({ result, frame, kind, index }: DetailSubject): void {
    this.build('point', () => [
      cardOf(
        'Yours and Marrow’s',
        new NumberGrid({
          label: 'Yours and Marrow’s',
          rows: 3,
          columns: 3,
          rowLabels: ['yours', 'Marrow’s', 'difference'],
          columnLabels: ['x', 'y', 'z'],
        }),
        'compare-point',
      ),
    ]);
    const target = result.targets.frames[frame];
    const { ours, size } = result.comparison.frames[frame];
    const theirs = kind === 'joints' ? target.positions : kind === 'vertices' ? target.vertices : target.normals;
    const own = kind === 'joints' ? ours.world : kind === 'vertices' ? ours.vertices : ours.normals;
    const o = kind === 'joints' ? 16 * index + 12 : 3 * index;
    const [grid] = this.grids;
    for (let k = 0; k < 3; k++) {
      const their = theirs?.[3 * index + k] ?? Number.NaN;
      const difference = their - own[o + k];
      grid.set(0, k, their);
      grid.set(1, k, own[o + k]);
      grid.set(2, k, difference);
      const isWrong = !(Math.abs(difference) / (kind === 'normals' ? 1 : size) <= result.tolerance);
      grid.mark(0, k, isWrong);
      grid.mark(2, k, isWrong);
    }
    const apart = Math.hypot(...[0, 1, 2].map((k) => (theirs?.[3 * index + k] ?? Number.NaN) - own[o + k]));
    const part = kind === 'normals' ? '' : `, ${numberText(apart / size)} of the size ${numberText(size)}`;
    setText(this.note, `${numberText(apart)} apart${part}.`);
  }

  private showChannel({ result, index }: DetailSubject): void {
    const { samples, wrong, of } = samplesOf(result, index, this.showsAll);
    setText(this.note, samplesText(samples.length, wrong, of, this.showsAll));
    const canChoose = wrong > 0 && wrong < of;
    write(this.all, 'hidden', !canChoose);
    const label = this.showsAll ? 'List differences only' : 'List all';
    setText(this.all, label);
    setAttribute(this.all, 'aria-label', label);
    this.build(`channel ${samples.length}`, () => [
      cardOf(
        'Samples',
        new NumberGrid({
          label: 'Samples',
          rows: samples.length,
          columns: 4,
          columnLabels: ['time', 'yours', 'Marrow’s', 'difference'],
        }),
        'compare-samples',
      ),
    ]);
    const [grid] = this.grids;
    samples.forEach(({ time, theirs, ours, isWrong }, row) => {
      grid.setRow(row, [time, theirs, ours, theirs - ours]);
      grid.mark(row, 1, isWrong);
      grid.mark(row, 3, isWrong);
    });
  }

  private build(shape: string, make: () => readonly { readonly grid: NumberGrid; readonly card: HTMLElement }[]): void {
    if (shape === this.shape) return;
    this.shape = shape;
    const made = make();
    this.grids = made.map(({ grid }) => grid);
    this.cards.replaceChildren(...made.map(({ card }) => card));
  }
}

function cardOf(title: string, grid: NumberGrid, className: string) {
  const card = element('section', { class: className, 'aria-label': title }, element('h4', {}, title), grid.element);
  return { grid, card };
}

/** World and local matrices of a frame; those that aren't in a dump follow from the world matrices. */
function matricesOf(
  { comparison, targets, character }: ComparedResult,
  frame: number,
  numbers: 'world' | 'local',
  of: 'theirs' | 'ours',
): Float64Array | undefined {
  const { world, local } = of === 'theirs' ? targets.frames[frame] : comparison.frames[frame].ours;
  if (numbers === 'world') return world;
  const isGiven = targets.frames[frame].local !== undefined;
  return isGiven ? local : world && localsOf(world)(character.skeleton?.joints ?? []);
}

/** Of the same world matrices only once, while rows are looked through. */
const localsOf = perObject((world: Float64Array) => {
  let made: Float64Array | undefined;
  return (joints: readonly Joint[]) => {
    made ??= relativeMatrices(world, joints);
    return made;
  };
});

interface Sample {
  readonly time: number;
  readonly theirs: number;
  readonly ours: number;
  readonly isWrong: boolean;
}

export interface ListedSamples {
  readonly samples: readonly Sample[];
  /** How many differ, and how many there are. */
  readonly wrong: number;
  readonly of: number;
}

/** By time, as many as are listed: those that are wrong; all if none is, or if that is asked for. */
export function samplesOf(
  { comparison, targets, tolerance }: ComparedResult,
  channel: number,
  showsAll = false,
): ListedSamples {
  const { channels, times, values } = targets.channels;
  const all: Sample[] = [];
  channels.forEach((c, i) => {
    if (c !== channel) return;
    const ours = comparison.ourChannels[i];
    all.push({ time: times[i], theirs: values[i], ours, isWrong: !(Math.abs(values[i] - ours) <= tolerance) });
  });
  const wrong = all.filter(({ isWrong }) => isWrong);
  const listed = showsAll || wrong.length === 0 ? all : wrong;
  const samples = listed.slice(0, showsAll ? MAX_ALL_SAMPLES : MAX_SAMPLES);
  return { samples, wrong: wrong.length, of: all.length };
}

/** What is listed, and what isn't. */
export function samplesText(listed: number, wrong: number, of: number, showsAll: boolean): string {
  const isOfAll = showsAll || wrong === 0;
  const cut = (many: number) => (listed < many ? `; the first ${listed} are listed` : '');
  if (wrong === 0) return `All ${of} agree${cut(of)}.`;
  if (isOfAll) return `${wrong} of ${of} differ${cut(of)}.`;
  return `${wrong} of ${of} differ${cut(wrong)}${wrong < of ? `; matching ones aren’t listed` : ''}.`;
}

/** Small ones as powers of ten: they tell rounding from a mistake. */
function differenceText(value: number): string {
  const size = Math.abs(value);
  if (size === 0 || size >= 1e-3 || Number.isNaN(value))
    return aligned(value, size === 0 ? 0 : decimalsWithin(value, 7));
  return `${value < 0 ? '−' : ''}${powerText(size, 0)}`;
}
