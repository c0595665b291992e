/**
 * Distances over time: the picked joints in colour, mean and maximum over all joints in grey. Uses the timeline's time
 * window, like curves and dope sheet.
 */

import type { Uses } from '../../state/workbench.ts';
import { TimeChart, type TimeScene } from '../timeline/time-chart.ts';
import { type Readable, valueY } from '../timeline/time-plot.ts';
import { framesIn } from '../timeline/trace-frames.ts';
import { type ChartColours, type ChartLine, type ChartScene, drawDistances, readColours } from './chart-picture.ts';
import { type DistanceUnit, distanceText } from './distance-text.ts';
import type { Measured } from './measuring.ts';
import { scrubbedTime } from './scrub-time.ts';

/** Margins of the plot, the upper one for its label; CSS pixels. */
const MARGINS = { head: 18, foot: 8 };
const NO_UNIT: DistanceUnit = { factor: 1, symbol: '' };

export class DistanceChart {
  readonly chart: TimeChart<ChartScene, ChartColours>;
  private measured: Measured | undefined;
  private unit = NO_UNIT;
  private hovered: number | undefined;

  constructor(private readonly wb: Uses<'transport' | 'timeline' | 'settings'>) {
    this.chart = new TimeChart<ChartScene, ChartColours>(wb, {
      readColours,
      sceneOf: (ground) => this.sceneOf(ground),
      draw: drawDistances,
      readableAt: (scene, timeSeconds) => this.readableAt(scene, timeSeconds),
      labelOf,
      extent: () => this.extent(),
      scrubbedTime: (x, view, snapsTo) => scrubbedTime(x, view, this.measured?.distances, snapsTo),
    });
    wb.timeline.takes.distances.subscribe(() => this.chart.redraw());
  }

  show(measured: Measured | undefined, unit: DistanceUnit): void {
    this.measured = measured;
    this.unit = unit;
    this.hovered = undefined;
    this.chart.redraw();
  }

  /** Also draws this pair's line, while its row is hovered. */
  hover(pair: number | undefined): void {
    if (pair === this.hovered) return;
    this.hovered = pair;
    this.chart.redraw();
  }

  private extent(): readonly [number, number] | undefined {
    const distances = this.measured?.distances;
    if (!distances) return undefined;
    const { startSeconds, frameSeconds, frameCount } = distances;
    return [startSeconds, startSeconds + (frameCount - 1) * frameSeconds];
  }

  private sceneOf({ view, height }: TimeScene): ChartScene {
    const lines = this.lines();
    const distances = this.measured?.distances;
    let most = 0;
    if (distances) {
      const [first, end] = framesIn(distances, view.window);
      for (const { values } of lines) for (let f = first; f < end; f++) if (values[f] > most) most = values[f];
      // Nothing in view, or identical takes: use the overall scale, or any.
      if (most === 0) most = distances.most.reduce((all, value) => Math.max(all, value), 0) || 1 / this.unit.factor;
    }
    const axis = { height, ...MARGINS, least: 0, most };
    return { view, height, distances, unit: this.unit, lines, axis };
  }

  private lines(): ChartLine[] {
    const distances = this.measured?.distances;
    if (!distances) return [];
    const { picked } = this.wb.timeline.takes.distances.get();
    const { frameCount, match, values } = distances;
    const joints = this.measured?.first.skeleton?.joints ?? [];
    const line = (pair: number, kind: ChartLine['kind'], ordinal: number): ChartLine => ({
      values: values.subarray(pair * frameCount, (pair + 1) * frameCount),
      kind,
      label: joints[match.first[pair]]?.name || 'unnamed',
      ordinal,
    });
    const isThere = (pair: number) => pair < match.first.length;
    const lines: ChartLine[] = [
      { values: distances.most, kind: 'most', label: 'Max', ordinal: 0 },
      { values: distances.mean, kind: 'mean', label: 'Mean', ordinal: 0 },
    ];
    const { hovered } = this;
    if (hovered !== undefined && isThere(hovered) && !picked.includes(hovered)) lines.push(line(hovered, 'hovered', 0));
    lines.push(...picked.filter(isThere).map((pair, i) => line(pair, 'joint', i)));
    return lines;
  }

  /** Lines that are drawn later lie on top, and come first. */
  private readableAt({ distances, lines, axis, unit }: ChartScene, timeSeconds: number): readonly Readable[] {
    if (!distances) return [];
    const { startSeconds, frameSeconds, frameCount } = distances;
    const frame = Math.round((timeSeconds - startSeconds) / frameSeconds);
    if (frame < 0 || frame >= frameCount) return [];
    return lines.toReversed().map(({ values, kind, label }) => ({
      timeSeconds: startSeconds + frame * frameSeconds,
      y: valueY(axis, values[frame]),
      text: () => `${kind === 'most' ? `Max: ${this.farthest(frame)}` : label}  ${distanceText(values[frame], unit)}`,
    }));
  }

  /** The joint with the largest distance in a frame. */
  private farthest(frame: number): string {
    const distances = this.measured?.distances;
    if (!distances) return '';
    const { values, frameCount, match } = distances;
    let found = 0;
    for (let k = 1; k < match.first.length; k++) {
      if (values[k * frameCount + frame] > values[found * frameCount + frame]) found = k;
    }
    return this.measured?.first.skeleton?.joints[match.first[found]]?.name ?? '';
  }
}

function labelOf({ lines }: ChartScene): string {
  const names = lines.filter((l) => l.kind === 'joint').map((l) => l.label);
  return `Distance of the joints over time: ${['mean', 'largest', ...names].join(', ')}`;
}
