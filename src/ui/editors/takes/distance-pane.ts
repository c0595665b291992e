/**
 * Beside the table while two takes are compared: which they are, a summary of their distances, the chart over time, and
 * the list of joints.
 */
import { ALIGNMENTS, type Alignment } from '../../../evaluate/distance.ts';
import type { Skeleton } from '../../../model/skeleton.ts';
import { button, element, keepsFocusElsewhere, setText } from '../../kit/dom.ts';
import { focusPanel } from '../../kit/focus.ts';
import { icon } from '../../kit/icons.ts';
import { plural, shown } from '../../kit/number-text.ts';
import { setTooltip } from '../../kit/tooltip.ts';
import { comparedIn } from '../../state/takes.ts';
import type { Uses } from '../../state/workbench.ts';
import { DistanceChart } from './chart.ts';
import { endComparison } from './compare.ts';
import { DistanceList } from './distance-list.ts';
import { type DistanceUnit, distanceText, distanceUnit } from './distance-text.ts';
import { type Measured, Measuring } from './measuring.ts';

export class DistancePane {
  readonly element: HTMLElement;
  private readonly measuring: Measuring;
  private readonly chart: DistanceChart;
  private readonly list: DistanceList;
  private readonly names = [element('span', { class: 'compared-name' }), element('span', { class: 'compared-name' })];
  private readonly facts = element('span', { class: 'distance-facts', role: 'status' });
  private readonly note = element('p', { class: 'empty distance-note', hidden: true });
  private readonly alignment: HTMLSelectElement;
  private unit: DistanceUnit = { factor: 1, symbol: '' };

  constructor(private readonly wb: Uses<'store' | 'transport' | 'timeline' | 'settings' | 'messages' | 'actions'>) {
    const { takes } = wb.timeline;
    this.measuring = new Measuring(wb);
    this.chart = new DistanceChart(wb);
    this.list = new DistanceList({
      pick: (pair, adds) => this.pick(pair, adds),
      hover: (pair) => this.chart.hover(pair),
      order: (order) => takes.distances.update((now) => ({ ...now, order })),
    });
    this.alignment = alignmentChoice(wb);
    const close = keepsFocusElsewhere(
      button('Stop comparing', { class: 'tool small' }, icon('close'), () => endComparison(wb)),
    );
    const head = element(
      'div',
      { class: 'distance-title' },
      element('span', { class: 'take-mark first', 'aria-hidden': 'true' }),
      this.names[0],
      element('span', { class: 'take-mark second', 'aria-hidden': 'true' }),
      this.names[1],
      this.facts,
      this.alignment,
      close,
    );
    this.element = element(
      'section',
      { class: 'distance', 'aria-label': 'Distance between takes', hidden: true },
      head,
      element('div', { class: 'distance-plot' }, this.chart.element, this.note),
      this.list.element,
    );
    this.measuring.result.subscribe(() => this.show());
    takes.distances.subscribe(() => this.showList());
    wb.store.subscribe((now, before) => {
      if (now.selection !== before.selection) this.pickSelected();
    });
  }

  setVisible(visible: boolean): void {
    const { store, timeline } = this.wb;
    const isSeen = visible && comparedIn(store.document, timeline.takes.comparison.get()) !== undefined;
    this.measuring.setVisible(isSeen);
    this.chart.setVisible(isSeen);
  }

  recolour(): void {
    this.chart.recolour();
  }

  /** Whether there was anything to fit. */
  fitAll(): boolean {
    return !this.element.hidden && this.chart.fitAll();
  }

  private show(): void {
    const measured = this.measuring.result.get();
    const distances = measured?.distances;
    const largest = distances ? distances.jointMost.reduce((most, d) => Math.max(most, d), 0) : 0;
    if (measured) this.unit = distanceUnit(measured.first, measured.second, largest);
    this.chart.show(measured, this.unit);
    this.showHead(measured);
    if (measured) this.pickSelected();
    this.showList();
  }

  private showHead(measured: Measured | undefined): void {
    if (!measured) return;
    const { first, second, distances, match } = measured;
    for (const [i, character] of [first, second].entries()) {
      const name = character.clips[character.shownClip]?.name ?? character.name;
      setText(this.names[i], name);
      setTooltip(this.names[i], name);
    }
    const missing = [
      ...namesOf(first.skeleton, match.onlyFirst, first.name),
      ...namesOf(second.skeleton, match.onlySecond, second.name),
    ];
    const left = missing.length ? ` · ${plural(missing.length, 'joint')} without a counterpart` : '';
    setText(this.facts, (distances ? factsText(measured, this.unit) : '') + left);
    setTooltip(this.facts, missing.length ? `Not compared: ${missing.join(', ')}` : undefined);
    this.note.hidden = distances !== undefined;
    setText(this.note, 'These takes do not overlap in time. Align their starts or change a start time.');
  }

  private showList(): void {
    const measured = this.measuring.result.get();
    const distances = measured?.distances;
    this.list.element.hidden = !distances;
    if (!distances) return;
    const names = distances.match.first.map((j) => measured.first.skeleton?.joints[j]?.name ?? '');
    this.list.show(distances, names, this.unit, this.wb.timeline.takes.distances.get());
  }

  /** Draws a joint's distance, and selects the joint if it is the only one. */
  private pick(pair: number, adds: boolean): void {
    const { store, timeline } = this.wb;
    const { takes } = timeline;
    const measured = this.measuring.result.get();
    takes.distances.update((now) => {
      if (!adds) return { ...now, picked: [pair] };
      const picked = now.picked.includes(pair) ? now.picked.filter((p) => p !== pair) : [...now.picked, pair];
      return { ...now, picked };
    });
    if (!measured || adds) return;
    const { first, second, match } = measured;
    // On whichever of the two is already selected.
    const isSecond = store.selection.characterId === second.id && second.id !== first.id;
    const joint = (isSecond ? match.second : match.first)[pair];
    store.select({ characterId: isSecond ? second.id : first.id, joint });
  }

  /** Draws a joint selected elsewhere. */
  private pickSelected(): void {
    const { store, timeline } = this.wb;
    const { characterId, joint } = store.selection;
    const measured = this.measuring.result.get();
    if (!measured || joint === undefined) return;
    const { first, second, match } = measured;
    const side = characterId === first.id ? match.first : characterId === second.id ? match.second : [];
    const pair = side.indexOf(joint);
    const { picked } = timeline.takes.distances.get();
    if (pair >= 0 && !picked.includes(pair)) timeline.takes.distances.update((now) => ({ ...now, picked: [pair] }));
  }
}

const ALIGNMENT_LABELS: Readonly<Record<Alignment, readonly [string, string]>> = {
  world: ['in world space', 'As seen in the viewport'],
  root: ['relative to root position', 'Ignores the root’s position'],
  turned: ['relative to root', 'Ignores the root’s position and orientation'],
};

function alignmentChoice(wb: Uses<'timeline'>): HTMLSelectElement {
  const { distances } = wb.timeline.takes;
  const choice = element('select', {
    class: 'distance-alignment',
    'aria-label': 'Space in which distances are measured',
  });
  for (const alignment of ALIGNMENTS) {
    choice.append(element('option', { value: alignment }, ALIGNMENT_LABELS[alignment][0]));
  }
  choice.addEventListener('change', () => {
    const alignment = ALIGNMENTS.find((a) => a === choice.value);
    if (alignment) distances.update((now) => ({ ...now, alignment }));
    if (!byKeyboard) focusPanel(choice);
  });
  // Arrow keys choose one after the other.
  let byKeyboard = false;
  choice.addEventListener('keydown', () => (byKeyboard = true));
  choice.addEventListener('pointerdown', () => (byKeyboard = false));
  const show = () => {
    const { alignment } = distances.get();
    choice.value = alignment;
    setTooltip(choice, ALIGNMENT_LABELS[alignment][1]);
  };
  distances.subscribe(show);
  show();
  return choice;
}

/** `mean 3.4 cm, RMS 4.1 cm, max 21 cm (LeftHand at 3.2 s)`. */
function factsText({ distances, first }: Measured, unit: DistanceUnit): string {
  if (!distances) return '';
  const { jointMean, jointRms, jointMost, jointMostAt, match, frameCount, startSeconds, frameSeconds } = distances;
  const joints = match.first.length;
  const mean = jointMean.reduce((sum, d) => sum + d, 0) / joints;
  const rms = Math.sqrt(jointRms.reduce((sum, d) => sum + d * d, 0) / joints);
  let farthest = 0;
  for (let k = 1; k < joints; k++) if (jointMost[k] > jointMost[farthest]) farthest = k;
  const name = first.skeleton?.joints[match.first[farthest]]?.name ?? '';
  const at = shown(startSeconds + jointMostAt[farthest] * frameSeconds, 2);
  const max = `max ${distanceText(jointMost[farthest], unit)} (${name} at ${at} s)`;
  return `mean ${distanceText(mean, unit)}, RMS ${distanceText(rms, unit)}, ${max} · ${plural(frameCount, 'frame')}`;
}

function namesOf(skeleton: Skeleton | undefined, joints: readonly number[], of: string): string[] {
  return joints.map((j) => `${skeleton?.joints[j]?.name ?? j} (${of})`);
}
