/**
 * Beside the table while two takes are compared: which they are, a summary of their distances, the chart over time, and
 * the list of joints.
 */
import type { Distances } from '../../../evaluate/compare/distance.ts';
import { ALIGNMENTS, type Alignment } from '../../../evaluate/compare/posed-joints.ts';
import type { Selection } from '../../../model/session.ts';
import { comparedIn, playedName } from '../../state/takes.ts';
import type { Uses } from '../../state/workbench.ts';
import { button, element, keepsFocusElsewhere, setAttribute, setText, write } from '../../widgets/dom.ts';
import { focusPanel } from '../../widgets/focus/focus.ts';
import { icon } from '../../widgets/icons.ts';
import { openMenu } from '../../widgets/menu.ts';
import { middleCut } from '../../widgets/middle-cut.ts';
import { plural, shown } from '../../widgets/numbers/number-text.ts';
import { setTooltip } from '../../widgets/tooltip.ts';
import { DistanceChart } from './chart.ts';
import { endComparison } from './compared-takes.ts';
import { DistanceList } from './distance-list.ts';
import { type DistanceUnit, distanceText, distanceUnit } from './distance-text.ts';
import { farthestPair, jointLabels, leftOutEntries, worstSeconds } from './joint-labels.ts';
import { type Measured, Measuring } from './measuring.ts';

export class DistancePane {
  readonly element: HTMLElement;
  private readonly measuring: Measuring;
  private readonly distances: DistanceChart;
  private readonly chart: DistanceChart['chart'];
  private readonly list: DistanceList;
  private readonly names = [middleCut('compared-name'), middleCut('compared-name')];
  private readonly facts = element('div', { class: 'distance-facts', hidden: true });
  /** Mean and RMS; the maximum, which leads there; frames; the joints that are left out. */
  private readonly means = element('span', { role: 'status' });
  private readonly most: HTMLButtonElement;
  private readonly frames = element('span', { class: 'distance-frames' });
  private readonly left: HTMLButtonElement;
  private readonly note = element('p', { class: 'empty time-note', hidden: true });
  private readonly alignment: HTMLSelectElement;
  /** Match of the last result. */
  private match: Measured['match'] | undefined;
  private unit: DistanceUnit = { factor: 1, symbol: '' };

  constructor(private readonly wb: Uses<'store' | 'transport' | 'timeline' | 'settings' | 'messages' | 'actions'>) {
    const { takes } = wb.timeline;
    this.measuring = new Measuring(wb);
    this.distances = new DistanceChart(wb);
    this.chart = this.distances.chart;
    this.list = new DistanceList({
      pick: (pair, adds) => this.pick(pair, adds),
      hover: (pair) => this.distances.hover(pair),
      goTo: (pair) => this.goTo(pair),
      order: (order) => takes.distances.update((now) => ({ ...now, order })),
    });
    this.alignment = alignmentChoice(wb);
    const close = keepsFocusElsewhere(
      button('Stop comparing', { class: 'tool small' }, icon('close'), () => endComparison(wb)),
    );
    this.most = linkButton('Go to the largest distance, and select its joint', () => this.goToMost());
    this.left = linkButton('Which joints are not compared, and why', () => this.showLeftOut());
    setAttribute(this.left, 'aria-haspopup', 'menu');
    setTooltip(
      this.means,
      'Over all joints and frames; time-warped: frames up to a tenth of the take away are matched',
    );
    this.facts.append(this.means, this.most, this.frames, this.left);
    const head = element(
      'div',
      { class: 'distance-title' },
      element('span', { class: 'take-mark first', 'aria-hidden': 'true' }),
      this.names[0].element,
      element('span', { class: 'take-mark second', 'aria-hidden': 'true' }),
      this.names[1].element,
      this.alignment,
      close,
    );
    this.element = element(
      'section',
      { class: 'distance', 'aria-label': 'Distance between takes', hidden: true },
      element('div', { class: 'distance-head-lines' }, head, this.facts),
      element('div', { class: 'time-plot' }, this.chart.element, this.note),
      this.list.element,
    );
    this.measuring.result.subscribe(() => this.show());
    takes.distances.subscribe(() => this.showList());
    wb.store.subscribe((now, before) => {
      if (now.selection === before.selection) return;
      this.unpickDeselected(before.selection);
      this.pickSelected();
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
    // Picked rows of other pairs mean nothing now.
    if (measured && measured.match !== this.match) {
      this.match = measured.match;
      this.wb.timeline.takes.distances.update((now) => (now.picked.length ? { ...now, picked: [] } : now));
    }
    const largest = distances ? distances.jointMost.reduce((most, d) => Math.max(most, d), 0) : 0;
    if (measured) this.unit = distanceUnit(measured.first, measured.second, largest);
    this.distances.show(measured, this.unit);
    this.showHead(measured);
    if (measured) this.pickSelected();
    this.showList();
  }

  private showHead(measured: Measured | undefined): void {
    if (!measured) return;
    const { first, second, distances, match } = measured;
    for (const [i, character] of [first, second].entries()) {
      const name = playedName(character);
      this.names[i].show(name);
      setTooltip(this.names[i].element, name);
    }
    const left = match.onlyFirst.length + match.onlySecond.length;
    write(this.facts, 'hidden', !distances && !left);
    setText(this.left, left ? `${plural(left, 'joint')} not compared` : '');
    setText(this.means, distances ? meansText(distances, measured.warped, this.unit) : '');
    setText(this.most, distances ? mostText(measured, distances, this.unit) : '');
    setText(this.frames, distances ? plural(distances.frameCount, 'frame') : '');
    write(this.note, 'hidden', distances !== undefined);
    setText(this.note, 'These takes do not overlap in time. Align their starts or change a start time.');
  }

  private showList(): void {
    const measured = this.measuring.result.get();
    const distances = measured?.distances;
    write(this.list.element, 'hidden', !distances);
    if (!distances) return;
    const labels = jointLabels(measured, distances);
    this.list.show(distances, labels, this.unit, this.wb.timeline.takes.distances.get());
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

  /** The time at which a pair is farthest apart, and its joint. */
  private goTo(pair: number): void {
    const distances = this.measuring.result.get()?.distances;
    if (!distances || pair >= distances.match.first.length) return;
    this.pick(pair, false);
    this.wb.transport.update((p) => ({ ...p, timeSeconds: worstSeconds(distances, pair), playing: false }));
  }

  private goToMost(): void {
    const distances = this.measuring.result.get()?.distances;
    if (distances) this.goTo(farthestPair(distances));
  }

  private showLeftOut(): void {
    const measured = this.measuring.result.get();
    if (!measured) return;
    const entries = leftOutEntries(this.wb, measured);
    openMenu(this.left.getBoundingClientRect(), entries, {
      label: 'Joints that are not compared',
      opener: this.left,
      opensByClick: true,
    });
  }

  /** A joint that is no longer selected, nor any other, isn't drawn on its own. */
  private unpickDeselected({ characterId, joint }: Selection): void {
    const { store, timeline } = this.wb;
    const { picked } = timeline.takes.distances.get();
    if (joint === undefined || store.selection.joint !== undefined || picked.length !== 1) return;
    if (this.pairOf(characterId, joint) === picked[0]) {
      timeline.takes.distances.update((now) => ({ ...now, picked: [] }));
    }
  }

  /** -1: the joint isn't compared. */
  private pairOf(characterId: string | undefined, joint: number): number {
    const measured = this.measuring.result.get();
    if (!measured) return -1;
    const { first, second, match } = measured;
    const side = characterId === first.id ? match.first : characterId === second.id ? match.second : [];
    return side.indexOf(joint);
  }

  /** Draws a joint selected elsewhere. */
  private pickSelected(): void {
    const { store, timeline } = this.wb;
    const { characterId, joint } = store.selection;
    if (joint === undefined) return;
    const pair = this.pairOf(characterId, joint);
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

/** `mean 3.4 cm, RMS 4.1 cm, time-warped 0.8 cm`. */
function meansText({ jointMean, jointRms }: Distances, warped: number | undefined, unit: DistanceUnit): string {
  const joints = jointMean.length;
  const mean = jointMean.reduce((sum, d) => sum + d, 0) / joints;
  const rms = Math.sqrt(jointRms.reduce((sum, d) => sum + d * d, 0) / joints);
  const warp = warped === undefined ? '' : `, time-warped ${distanceText(warped, unit)}`;
  return `mean ${distanceText(mean, unit)}, RMS ${distanceText(rms, unit)}${warp}`;
}

/** `max 21 cm (LeftHand at 3.2 s)`. */
function mostText({ first, match }: Measured, distances: Distances, unit: DistanceUnit): string {
  const farthest = farthestPair(distances);
  const name = first.skeleton?.joints[match.first[farthest]]?.name ?? '';
  const at = shown(worstSeconds(distances, farthest), 2);
  return `max ${distanceText(distances.jointMost[farthest], unit)} (${name} at ${at} s)`;
}

/** A button that is read by its text. */
function linkButton(tooltip: string, run: () => void): HTMLButtonElement {
  const made = keepsFocusElsewhere(element('button', { type: 'button', class: 'link' }));
  setTooltip(made, tooltip);
  made.addEventListener('click', run);
  return made;
}
