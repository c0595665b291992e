/**
 * *Measure*: quantities over time of the selected joints or the centre of mass, of all visible characters that play a
 * take, as displayed. Nothing in the document changes.
 */
import { QUANTITIES, type Quantity } from '../../../evaluate/measure/quantities.ts';
import { followWithNumbers } from '../../state/follow-time.ts';
import type { TimelineTab } from '../../state/timeline.ts';
import type { Uses } from '../../state/workbench.ts';
import { BLOCKED, copyText } from '../../widgets/clipboard.ts';
import { element, keepsFocusElsewhere, setText, write } from '../../widgets/dom.ts';
import { focusPanel } from '../../widgets/focus/focus.ts';
import { icon } from '../../widgets/icons.ts';
import { menuButton } from '../../widgets/menu.ts';
import { middleCut } from '../../widgets/middle-cut.ts';
import { plural, shown } from '../../widgets/numbers/number-text.ts';
import { setTooltip } from '../../widgets/tooltip.ts';
import { TimeChart, type TimeScene } from '../timeline/time-chart.ts';
import { type Readable, valueY } from '../timeline/time-plot.ts';
import { framesIn } from '../timeline/trace-frames.ts';
import { Measuring } from './measuring.ts';
import {
  barY,
  colourOf,
  dashOf,
  drawSeries,
  drawValuesAt,
  MARGINS,
  type PlotScene,
  readColours,
  type SeriesColours,
} from './picture.ts';
import {
  emptyText,
  isTooLong,
  MAX_OVERLAID,
  massText,
  QUANTITY_LABELS,
  type Series,
  SUBJECTS,
  type Subject,
  seriesAsCsv,
  seriesOf,
  spanOf,
  unitOf,
  valueAt,
} from './series.ts';

type Parts = Uses<'store' | 'transport' | 'timeline' | 'settings' | 'messages' | 'files'>;

const SUBJECT_LABELS: Readonly<Record<Subject, string>> = {
  joints: 'Selected joints',
  feet: 'Feet',
  mass: 'Centre of mass',
};

export function measurePanel(wb: Parts): TimelineTab {
  return new MeasurePanel(wb);
}

class MeasurePanel implements TimelineTab {
  readonly element = element('div', { class: 'measure', 'data-panel': 'measure' });
  readonly tools: HTMLElement;
  private readonly chart: TimeChart<PlotScene, SeriesColours>;
  private readonly legend = element('ul', { class: 'measure-legend', 'aria-label': 'Values at the playhead' });
  private readonly note = element('p', { class: 'measure-note' });
  private readonly empty = element('p', { class: 'empty time-note', role: 'status', hidden: true });
  private readonly measuring: Measuring;
  private readonly exports: HTMLButtonElement;
  private quantity: Quantity;
  private subject: Subject;
  private series: readonly Series[] = [];
  private values: HTMLElement[] = [];
  private unit = '';
  private visible = false;

  constructor(private readonly wb: Parts) {
    this.measuring = new Measuring(wb);
    const { measured } = wb.settings.get();
    this.quantity = QUANTITIES.find((known) => known === measured.quantity) ?? 'speed';
    this.subject = SUBJECTS.find((known) => known === measured.subject) ?? 'joints';
    this.chart = new TimeChart<PlotScene, SeriesColours>(wb, {
      readColours,
      sceneOf: (ground) => this.sceneOf(ground),
      draw: drawSeries,
      drawAt: drawValuesAt,
      readableAt: (scene, timeSeconds) => this.readableAt(scene, timeSeconds),
      labelOf: ({ series }) => this.labelOf(series),
      extent: () => spanOf(this.series),
    });
    this.element.append(
      element('div', { class: 'measure-side' }, this.legend, this.note),
      element('div', { class: 'time-plot' }, this.chart.element, this.empty),
    );
    const quantities = choice('Quantity', QUANTITIES, (quantity) => QUANTITY_LABELS[quantity].label, this.quantity);
    quantities.onChoice((quantity) => {
      this.quantity = quantity;
      this.remember();
    });
    const subjects = choice('Of', SUBJECTS, (subject) => SUBJECT_LABELS[subject], this.subject);
    subjects.onChoice((subject) => {
      this.subject = subject;
      this.remember();
    });
    this.exports = keepsFocusElsewhere(
      element('button', { type: 'button', class: 'tool text-tool' }, 'Values', icon('fold')),
    );
    setTooltip(this.exports, 'Copy or save the plotted values');
    menuButton(this.exports, 'Values', () => [
      { kind: 'item', label: 'Copy as CSV', enabled: true, run: () => void this.copyValues() },
      { kind: 'item', label: 'Save as CSV', enabled: true, run: () => this.saveValues() },
    ]);
    this.tools = element('div', { class: 'measure-tools' }, quantities.element, subjects.element, this.exports);
    followWithNumbers(wb.transport, () => this.showValues());
    this.measuring.result.subscribe(() => this.show());
  }

  setVisible(visible: boolean): void {
    this.visible = visible;
    this.measuring.setVisible(visible);
    this.chart.setVisible(visible);
    this.showValues();
  }

  fitAll(): void {
    this.chart.fitAll();
  }

  fitSelected(): void {
    this.fitAll();
  }

  recolour(): void {
    this.chart.recolour();
    this.show();
  }

  /** Another quantity, or other tracks. */
  private show(): void {
    const measured = this.measuring.result.get();
    if (!measured) return;
    const { sources, all } = measured;
    const { quantity, subject } = this;
    this.series = seriesOf(all, subject, quantity);
    this.unit = unitOf(all, quantity);
    const isEmpty = this.series.length === 0;
    write(this.empty, 'hidden', !isEmpty);
    setText(this.empty, isEmpty ? emptyText(sources, subject, quantity) : '');
    write(this.exports, 'disabled', isEmpty);
    const left = sources.length > MAX_OVERLAID ? `The first ${MAX_OVERLAID} of ${sources.length} characters` : '';
    const tooLong = all.length > 0 && sources.some(isTooLong) ? 'Takes with too many frames are left out' : '';
    const notes = [massText(all, subject, quantity), left, tooLong].filter(Boolean);
    setText(this.note, notes.join('. '));
    write(this.note, 'hidden', notes.length === 0);
    this.showLegend(all.length > 1);
    this.chart.redraw();
  }

  private showLegend(byCharacter: boolean): void {
    this.values = this.series.map(() => element('span', { class: 'measure-value' }));
    const rows = this.series.map((series, i) => {
      const swatch = element('span', { class: 'measure-swatch', 'aria-hidden': 'true' });
      swatch.style.borderTopColor = colourOf(series, byCharacter, this.chart.colours);
      swatch.style.borderTopStyle = SWATCHES[dashOf(series, byCharacter) % SWATCHES.length];
      const name = middleCut('measure-name');
      name.show(series.label);
      setTooltip(name.element, series.label);
      return element('li', {}, swatch, name.element, this.values[i]);
    });
    this.legend.replaceChildren(...rows);
    this.showValues();
  }

  private showValues(): void {
    if (!this.visible) return;
    const { timeSeconds } = this.wb.transport.get();
    this.series.forEach((series, i) => {
      const value = valueAt(series, timeSeconds);
      setText(this.values[i], value === undefined ? '–' : this.valueText(value));
    });
  }

  private valueText(value: number): string {
    if (this.quantity === 'contact') return value ? 'on ground' : 'in air';
    const isDegrees = this.unit.startsWith('°');
    return `${shown(value)}${isDegrees ? '' : ' '}${this.unit}`;
  }

  private sceneOf({ view, height }: TimeScene): PlotScene {
    const { series, unit, quantity } = this;
    let least = Number.POSITIVE_INFINITY;
    let most = Number.NEGATIVE_INFINITY;
    for (const { frames, values } of series) {
      const [first, end] = framesIn(frames, view.window);
      for (let f = first; f < end; f++) {
        if (values[f] < least) least = values[f];
        if (values[f] > most) most = values[f];
      }
    }
    if (!(least <= most)) [least, most] = [0, 1];
    if (!IS_PLACE[quantity]) least = 0;
    // A constant is drawn in the middle, or at the bottom if it is 0.
    if (most - least < 1e-9 * Math.max(1, Math.abs(most))) {
      if (least !== 0 || IS_PLACE[quantity]) least -= 0.5;
      most += 0.5;
    }
    const sources = new Set(series.map(({ source }) => source));
    const byCharacter = sources.size > 1 || series.some(({ source }) => source > 0);
    return {
      ...{ view, height, series, unit },
      axis: { height, ...MARGINS, least, most },
      isBars: quantity === 'contact',
      byCharacter,
    };
  }

  private readableAt(scene: PlotScene, timeSeconds: number): readonly Readable[] {
    return scene.series.flatMap((series, row): Readable[] => {
      const { startSeconds, frameSeconds, frameCount } = series.frames;
      const f = Math.round((timeSeconds - startSeconds) / frameSeconds);
      const value = series.values[f];
      if (f < 0 || f >= frameCount || Number.isNaN(value)) return [];
      return [
        {
          timeSeconds: startSeconds + f * frameSeconds,
          y: scene.isBars ? barY(scene, row) : valueY(scene.axis, value),
          text: () => `${series.label}  ${this.valueText(value)}`,
        },
      ];
    });
  }

  private labelOf(series: readonly Series[]): string {
    const names = series.map(({ label }) => label).join(', ');
    return `${QUANTITY_LABELS[this.quantity].label} over time${names && `: ${names}`}`;
  }

  private csv(): string {
    return seriesAsCsv(this.series, this.quantity, this.unit);
  }

  private remember(): void {
    const { quantity, subject } = this;
    this.wb.settings.update((now) => ({ ...now, measured: { quantity, subject } }));
    this.show();
  }

  private saveValues(): void {
    this.wb.files.saveText(`${this.quantity}.csv`, this.csv());
  }

  private async copyValues(): Promise<void> {
    const isCopied = await copyText(this.csv());
    const what = plural(this.series.length, 'column');
    if (isCopied) this.wb.messages.note(`Copied ${what} as CSV.`);
    else this.wb.messages.note(`${BLOCKED} Save the CSV instead.`, 'warning');
  }
}

/** As the dashes of the lines. */
const SWATCHES = ['solid', 'dashed', 'dotted', 'double'];

/** Quantities that have no natural 0 at the bottom of the plot. */
const IS_PLACE: Readonly<Partial<Record<Quantity, true>>> = { x: true, height: true, z: true };

interface Choice<T> {
  readonly element: HTMLSelectElement;
  onChoice(chosen: (value: T) => void): void;
}

function choice<T extends string>(
  label: string,
  values: readonly T[],
  textOf: (value: T) => string,
  first: T,
): Choice<T> {
  const made = element('select', { class: 'measure-choice', 'aria-label': label });
  for (const value of values) made.append(element('option', { value }, textOf(value)));
  made.value = first;
  // Arrow keys choose one after the other.
  let byKeyboard = false;
  made.addEventListener('keydown', () => (byKeyboard = true));
  made.addEventListener('pointerdown', () => (byKeyboard = false));
  return {
    element: made,
    onChoice(chosen) {
      made.addEventListener('change', () => {
        const value = values.find((one) => one === made.value);
        if (value) chosen(value);
        if (!byKeyboard) focusPanel(made);
      });
    },
  };
}
