/**
 * Distances over time: the picked joints in colour, mean and maximum over all joints in grey. A drag scrubs, the wheel
 * and two fingers zoom in time, the wheel with Shift pans. Uses the timeline's time window, like curves and dope sheet.
 */

import type { Uses } from '../../state/workbench.ts';
import { element, setAttribute } from '../../widgets/dom.ts';
import { HAS_KEYS } from '../../widgets/focus/focus.ts';
import { oncePerFrame } from '../../widgets/frame.ts';
import { timeAt } from '../../widgets/time/time-window.ts';
import type { TimeView } from '../timeline/time-ground.ts';
import { type ChartPoint, TimeInput } from '../timeline/time-input.ts';
import { followTime, type PlotReadout, type TimePlot, timeViewOf, whenText } from '../timeline/time-plot.ts';
import { framesIn } from '../timeline/trace-frames.ts';
import { type ChartLine, ChartPicture, type ChartScene, yAt } from './chart-picture.ts';
import { type DistanceUnit, distanceText } from './distance-text.ts';
import type { Measured } from './measuring.ts';
import { scrubbedTime } from './scrub-time.ts';

/** Distance within which the pointer reads a line. */
const REACH_PIXELS = 14;
const NO_UNIT: DistanceUnit = { factor: 1, symbol: '' };

export class DistanceChart implements TimePlot {
  readonly element = element('div', {
    class: 'time-chart',
    role: 'application',
    'aria-roledescription': 'chart',
    tabindex: 0,
    [HAS_KEYS]: true,
  });
  private readonly picture = new ChartPicture();
  readonly drawSoon = oncePerFrame(() => this.draw());
  size = { width: 0, height: 0 };
  private measured: Measured | undefined;
  private unit = NO_UNIT;
  private hovered: number | undefined;
  private pointer: ChartPoint | undefined;
  private scene: ChartScene | undefined;
  visible = false;

  constructor(private readonly wb: Uses<'transport' | 'timeline' | 'settings'>) {
    this.element.append(this.picture.element);
    followTime(wb, this.element, this);
    wb.timeline.takes.distances.subscribe(() => this.redraw());
    new TimeInput(wb, {
      element: this.element,
      timeView: () => this.timeView(),
      scrubbedTime: (x, snapsTo) => scrubbedTime(x, this.timeView(), this.measured?.distances, snapsTo),
      fitAll: () => this.fitAll(),
      hoverAt: (at) => {
        this.pointer = at;
        this.drawSoon();
      },
    });
  }

  show(measured: Measured | undefined, unit: DistanceUnit): void {
    this.measured = measured;
    this.unit = unit;
    this.hovered = undefined;
    this.redraw();
  }

  setVisible(visible: boolean): void {
    this.visible = visible;
    if (visible) this.redraw();
  }

  /** Also draws this pair's line, while its row is hovered. */
  hover(pair: number | undefined): void {
    if (pair === this.hovered) return;
    this.hovered = pair;
    this.redraw();
  }

  recolour(): void {
    this.picture.recolour();
    this.redraw();
  }

  /** Fits all measured time; false if nothing was measured. */
  fitAll(): boolean {
    const distances = this.measured?.distances;
    if (!distances) return false;
    const { startSeconds, frameSeconds, frameCount } = distances;
    this.wb.timeline.fit([startSeconds, startSeconds + (frameCount - 1) * frameSeconds]);
    return true;
  }

  redraw(): void {
    this.scene = undefined;
    this.drawSoon();
  }

  private draw(): void {
    if (!this.visible || !this.size.width || !this.size.height) return;
    if (!this.scene) {
      this.scene = this.makeScene();
      this.picture.draw(this.scene);
      this.describe(this.scene);
    }
    const { timeSeconds } = this.wb.transport.get();
    this.picture.drawOverlay(this.scene, timeSeconds, this.readout(this.scene));
  }

  private timeView(): TimeView {
    return timeViewOf(this.wb, this.size.width);
  }

  private makeScene(): ChartScene {
    const view = this.timeView();
    const lines = this.lines();
    const distances = this.measured?.distances;
    let top = 0;
    if (distances) {
      const [first, end] = framesIn(distances, view.window);
      for (const { values } of lines) for (let f = first; f < end; f++) if (values[f] > top) top = values[f];
      // Nothing in view, or identical takes: use the overall scale, or any.
      if (top === 0) top = distances.most.reduce((most, value) => Math.max(most, value), 0) || 1 / this.unit.factor;
    }
    return { view, height: this.size.height, distances, unit: this.unit, lines, top };
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

  /** Readout of the line under the pointer, at its frame. */
  private readout(scene: ChartScene): PlotReadout | undefined {
    const { pointer } = this;
    const { distances, view } = scene;
    if (!pointer || !distances) return undefined;
    const { startSeconds, frameSeconds, frameCount } = distances;
    const frame = Math.round((timeAt(view, pointer.x) - startSeconds) / frameSeconds);
    if (frame < 0 || frame >= frameCount) return undefined;
    let nearest: ChartLine | undefined;
    let reach = REACH_PIXELS;
    for (const line of scene.lines) {
      const away = Math.abs(yAt(scene, line.values[frame]) - pointer.y);
      // Of coincident lines the picked one, which is drawn on top.
      if (away <= reach) {
        reach = away;
        nearest = line;
      }
    }
    if (!nearest) return undefined;
    const timeSeconds = startSeconds + frame * frameSeconds;
    const distance = nearest.values[frame];
    const who = nearest.kind === 'most' ? `Max: ${this.farthest(frame)}` : nearest.label;
    return {
      timeSeconds,
      y: yAt(scene, distance),
      text: `${who}  ${distanceText(distance, this.unit)}  at ${whenText(view, timeSeconds)}`,
    };
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

  private describe(scene: ChartScene): void {
    const names = scene.lines.filter((l) => l.kind === 'joint').map((l) => l.label);
    const lines = ['mean', 'largest', ...names].join(', ');
    setAttribute(this.element, 'aria-label', `Distance of the joints over time: ${lines}. Drag to scrub.`);
  }
}
