/**
 * A chart of values over the timeline's time: what is drawn when, in which time window, and what the pointer reads. Two
 * canvases: values and grid below; playhead and readout above, so that playback redraws little.
 */
import type { Uses } from '../../state/workbench.ts';
import { element, setAttribute } from '../../widgets/dom.ts';
import { HAS_KEYS } from '../../widgets/focus/focus.ts';
import { oncePerFrame } from '../../widgets/frame.ts';
import { shown } from '../../widgets/numbers/number-text.ts';
import { snapTime, timeAt } from '../../widgets/time/time-window.ts';
import { drawOutsideRange, drawPlayhead, drawTimeGrid, type TimeView } from './time-ground.ts';
import { type ChartPoint, TimeInput } from './time-input.ts';
import { TimePicture } from './time-picture.ts';
import { drawReadout, nearest, type PlotColours, type Readable } from './time-plot.ts';

/** What is drawn until values, size, theme or time window change. */
export interface TimeScene {
  readonly view: TimeView;
  /** CSS pixels. */
  readonly height: number;
}

/** What a chart is of. */
export interface ChartedValues<Scene extends TimeScene, Colours extends PlotColours> {
  /** Of the stylesheet, for an element. */
  readColours(target: Element): Colours;
  sceneOf(ground: TimeScene): Scene;
  /** Over the grid. */
  draw(g: CanvasRenderingContext2D, scene: Scene, colours: Colours): void;
  /** Over the playhead. */
  drawAt?(g: CanvasRenderingContext2D, scene: Scene, timeSeconds: number, colours: Colours): void;
  /** The values nearest to a time; of two equally near the pointer, it reads the first. */
  readableAt(scene: Scene, timeSeconds: number): readonly Readable[];
  /** What is drawn, for screen readers: ends without a full stop. */
  labelOf(scene: Scene): string;
  /** First and last time that can be shown; undefined if there is nothing. */
  extent(): readonly [number, number] | undefined;
  /** The time that a press at an x shows; default: on a frame of `snapsTo`. */
  scrubbedTime?(x: number, view: TimeView, snapsTo: number | undefined): number;
}

export class TimeChart<Scene extends TimeScene, Colours extends PlotColours> {
  readonly element = element('div', {
    class: 'time-chart',
    role: 'application',
    'aria-roledescription': 'chart',
    tabindex: 0,
    [HAS_KEYS]: true,
  });
  private readonly picture: TimePicture<Colours>;
  private readonly drawSoon = oncePerFrame(() => this.draw());
  private size = { width: 0, height: 0 };
  private pointer: ChartPoint | undefined;
  private scene: Scene | undefined;
  private visible = false;

  constructor(
    private readonly wb: Uses<'transport' | 'timeline' | 'settings'>,
    private readonly values: ChartedValues<Scene, Colours>,
  ) {
    this.picture = new TimePicture(values.readColours);
    this.element.append(this.picture.element);
    new TimeInput(wb, {
      element: this.element,
      timeView: () => this.timeView(),
      scrubbedTime: (x, snapsTo) => this.scrubbedTime(x, snapsTo),
      fitAll: () => this.fitAll(),
      hoverAt: (at) => {
        this.pointer = at;
        this.drawSoon();
      },
    });
    this.follow();
  }

  private follow(): void {
    const { wb, element: target } = this;
    new ResizeObserver(() => {
      this.size = { width: target.clientWidth, height: target.clientHeight };
      this.redraw();
    }).observe(target);
    wb.timeline.view.subscribe((now, before) => {
      if (now.window !== before.window) this.redraw();
    });
    wb.settings.subscribe((now, before) => {
      if (now.timeDisplay !== before.timeDisplay) this.redraw();
    });
    wb.transport.subscribe((now, before) => {
      if (now.range !== before.range || now.framesPerSecond !== before.framesPerSecond) this.redraw();
      this.drawSoon();
    });
  }

  get colours(): Colours {
    return this.picture.colours;
  }

  setVisible(visible: boolean): void {
    this.visible = visible;
    if (visible) this.redraw();
  }

  /** The theme has changed. */
  recolour(): void {
    this.picture.recolour();
    this.redraw();
  }

  /** Fits all of its time; false if there is none. */
  fitAll(): boolean {
    const extent = this.values.extent();
    if (extent) this.wb.timeline.fit(extent);
    return extent !== undefined;
  }

  /** All of it, in the next frame. */
  redraw(): void {
    this.scene = undefined;
    this.drawSoon();
  }

  private timeView(): TimeView {
    const { range, framesPerSecond } = this.wb.transport.get();
    const inFrames = this.wb.settings.get().timeDisplay === 'frames';
    return { window: this.wb.timeline.view.get().window, width: this.size.width, range, framesPerSecond, inFrames };
  }

  private scrubbedTime(x: number, snapsTo: number | undefined): number {
    const view = this.timeView();
    if (this.values.scrubbedTime) return this.values.scrubbedTime(x, view, snapsTo);
    const within = Math.min(view.width, Math.max(0, x));
    return snapTime(timeAt(view, within), (view.window.to - view.window.from) / view.width, snapsTo);
  }

  private draw(): void {
    if (!this.visible || !this.size.width || !this.size.height) return;
    if (!this.scene) {
      this.scene = this.values.sceneOf({ view: this.timeView(), height: this.size.height });
      this.drawBelow(this.scene);
      setAttribute(this.element, 'aria-label', `${this.values.labelOf(this.scene)}. Drag to scrub.`);
    }
    this.drawAbove(this.scene);
  }

  private drawBelow(scene: Scene): void {
    const { view, height } = scene;
    const g = this.picture.below(view.width, height);
    if (!g) return;
    const { colours } = this.picture;
    g.fillStyle = colours.plot;
    g.fillRect(0, 0, view.width, height);
    drawOutsideRange(g, view, 0, height, colours);
    drawTimeGrid(g, view, 0, height, colours);
    this.values.draw(g, scene, colours);
  }

  private drawAbove(scene: Scene): void {
    const { view, height } = scene;
    const g = this.picture.above(view.width, height);
    if (!g) return;
    const { colours } = this.picture;
    const { timeSeconds } = this.wb.transport.get();
    drawPlayhead(g, view, timeSeconds, height, colours);
    this.values.drawAt?.(g, scene, timeSeconds, colours);
    const { pointer } = this;
    const read = pointer && nearest(this.values.readableAt(scene, timeAt(view, pointer.x)), pointer.y);
    if (!read) return;
    const text = `${read.text()}  at ${whenText(view, read.timeSeconds)}`;
    drawReadout(g, view, { timeSeconds: read.timeSeconds, y: read.y, text }, colours);
  }
}

/** `frame 12` or `0.4 s`. */
function whenText({ inFrames, framesPerSecond }: TimeView, timeSeconds: number): string {
  return inFrames ? `frame ${shown(timeSeconds * framesPerSecond, 1)}` : `${shown(timeSeconds)} s`;
}
