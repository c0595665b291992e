/** The plot: the picture of the curves with its overlays, kept up to date with document, settings and time. */

import { keysOf } from '../../../model/takes/take.ts';
import { onResult } from '../../state/shown-comparison.ts';
import type { Uses } from '../../state/workbench.ts';
import { element, setText, uniqueId, write } from '../../widgets/dom.ts';
import { HAS_KEYS } from '../../widgets/focus/focus.ts';
import { oncePerFrame } from '../../widgets/frame.ts';
import { timeAt, timeX } from '../../widgets/time/time-window.ts';
import type { SelectionBox } from '../timeline/box.ts';
import { selectedText } from '../timeline/key-edits.ts';
import { viewOfAll } from '../timeline/listed-of-all.ts';
import { timelineTake } from '../timeline/timeline-take.ts';
import type { ListSource } from './channel-list.ts';
import { CurveLegend } from './curve-legend.ts';
import { emptyPlotText } from './empty-text.ts';
import { CurvePicture } from './picture/picture.ts';
import { type PlotHost, PlotInput } from './plot-input.ts';
import { PlotScene, sameNumbers } from './plot-scene.ts';
import { CurveReadout } from './readout.ts';
import { ScaleFrame } from './scale-frame.ts';
import { fit as fitted, timesOf } from './scene/fit.ts';
import type { CurveScene } from './scene/scene.ts';
import { type CurveSpace, pan, yOf, zoom } from './scene/space.ts';
import type { WhyPlace } from './why/why-subject.ts';

const SELECT_A_JOINT = 'Select a joint to edit its curves';

export class CurvePlot implements PlotHost {
  readonly element: HTMLElement;
  private readonly picture: CurvePicture;
  private readonly plotScene: PlotScene;
  private readonly readout: CurveReadout;
  private readonly frame: ScaleFrame;
  private readonly legend = new CurveLegend();
  private readonly input: PlotInput;
  private readonly spoken = element('p', {
    class: 'off-screen',
    id: uniqueId('curves-selected'),
    'aria-live': 'polite',
  });
  private readonly empty = element('p', { class: 'empty curve-empty', hidden: true });
  readonly drawSoon = oncePerFrame(() => this.draw());
  /** Called after each draw: what is pointed at may be another. */
  afterDraw: (() => void) | undefined;
  private visible = false;
  private pendingFit = true;
  private box: SelectionBox | undefined;
  private drawn: CurveScene | undefined;
  /** What the view was last fitted to, to refit when that changes. */
  private fittedTo: { readonly take: string; readonly channels: readonly number[] } = { take: '', channels: [] };

  constructor(
    readonly wb: Uses<'store' | 'actions' | 'transport' | 'timeline' | 'settings' | 'messages' | 'comparing'>,
  ) {
    this.element = element('div', {
      class: 'curve-plot',
      tabindex: 0,
      [HAS_KEYS]: true,
      role: 'application',
      'aria-roledescription': 'curve editor',
      'aria-label': 'Curves',
      'aria-describedby': this.spoken.id,
    });
    this.picture = new CurvePicture(this.element);
    this.plotScene = new PlotScene(wb);
    this.readout = new CurveReadout(wb);
    this.frame = new ScaleFrame(this);
    this.element.append(this.empty, this.legend.element, this.frame.element, this.readout.element, this.spoken);
    new ResizeObserver(() => this.measure()).observe(this.element);
    this.input = new PlotInput(this);
    this.follow();
  }

  scene(): CurveScene {
    return this.plotScene.scene;
  }

  /** Source of the channel list. */
  get source(): ListSource {
    return this.plotScene;
  }

  get dragging(): boolean {
    return this.input.dragging || this.frame.dragging;
  }

  setVisible(visible: boolean): void {
    this.visible = visible;
    if (visible) {
      this.measure();
      this.drawSoon();
    }
  }

  recolour(): void {
    this.picture.recolour();
    this.drawSoon();
  }

  fitAll(): void {
    this.wb.timeline.fit(timesOf(this.scene()));
    this.pendingFit = true;
    this.drawSoon();
  }

  fitSelected(): void {
    this.look(fitted(this.scene(), 'selected'));
  }

  look(space: CurveSpace): void {
    const { wb, plotScene } = this;
    plotScene.axes = space.axes;
    this.redraw();
    const { window } = space;
    if (window !== wb.timeline.view.get().window) wb.timeline.change({ window });
  }

  /** About the playhead if it is in view, else about the centre. */
  zoom(timeFactor: number, valueFactor: number): void {
    const { space } = this.scene();
    const playhead = timeX(space, this.wb.transport.get().timeSeconds);
    const x = playhead >= 0 && playhead <= space.width ? playhead : space.width / 2;
    this.look(zoom(space, x, space.height / 2, timeFactor, valueFactor));
  }

  pan(timePart: number, valuePart: number): void {
    const { space } = this.scene();
    this.look(pan(space, -timePart * space.width, valuePart * space.height));
  }

  placeOf(channel: number, timeSeconds: number, value: number): { readonly x: number; readonly y: number } | undefined {
    const { lines, space } = this.scene();
    const line = lines.find((l) => l.channel === channel);
    if (!line) return undefined;
    const { left, top } = this.element.getBoundingClientRect();
    return { x: left + timeX(space, timeSeconds), y: top + yOf(space, line, value) };
  }

  /** What is pointed at and selected, for explanations. */
  whyPlace(): WhyPlace {
    const { wb, plotScene, input } = this;
    const { take, lines, space, selected, offsetSeconds } = plotScene.scene;
    const { pointer } = input;
    return {
      hover: input.shownHover(),
      pointerTime: pointer && timeAt(space, pointer.x) + offsetSeconds,
      playhead: wb.transport.get().timeSeconds + offsetSeconds,
      selected,
      drawn: lines.map(({ channel }) => channel),
      timesOf: (channel) => keysOf(take.channels[channel]).times,
    };
  }

  showBox(box: SelectionBox | undefined): void {
    this.box = box;
    this.drawSoon();
  }

  say(text: string): void {
    this.readout.say(text);
  }

  /** While something is dragged nothing is refitted or renormalised. */
  freeze(frozen: boolean): void {
    this.plotScene.frozen = frozen;
    if (!frozen) this.redraw();
  }

  afterDrag(): void {
    this.box = undefined;
    this.say('');
    this.freeze(false);
    setText(this.spoken, selectedText(this.wb));
  }

  private redraw(): void {
    this.plotScene.invalidate();
    this.drawSoon();
  }

  private follow(): void {
    const { wb } = this;
    wb.store.subscribe((now, before) => {
      if (now.document !== before.document || now.selection !== before.selection) this.redraw();
      if (!this.dragging) setText(this.spoken, selectedText(wb));
    });
    wb.timeline.view.subscribe(() => this.redraw());
    onResult(wb, () => this.redraw());
    wb.settings.subscribe((now, before) => {
      if (now.angles !== before.angles || now.timeDisplay !== before.timeDisplay) this.redraw();
    });
    wb.transport.subscribe((now, before) => {
      if (now.framesPerSecond !== before.framesPerSecond || now.range !== before.range) this.redraw();
      if (now.timeSeconds === before.timeSeconds) return;
      this.drawSoon();
    });
  }

  private measure(): void {
    const { clientWidth, clientHeight } = this.element;
    const { plotScene } = this;
    if (clientWidth === plotScene.width && clientHeight === plotScene.height) return;
    plotScene.width = clientWidth;
    plotScene.height = clientHeight;
    this.redraw();
  }

  private draw(): void {
    const { plotScene, wb } = this;
    if (!this.visible || !plotScene.width || !plotScene.height) return;
    this.fitWhereNew();
    const { scene } = plotScene;
    // The hovered item may have gone or changed.
    if (scene !== this.drawn) this.input.refresh();
    this.drawn = scene;
    const hover = this.input.shownHover();
    // Escape has cancelled the drag, though the button is still down.
    if (this.input.cancelled) this.say('');
    const isEmpty = !scene.lines.length;
    const isOnlyRoot = scene.emphasised?.size === 0;
    write(this.empty, 'hidden', !isEmpty && !isOnlyRoot);
    if (isEmpty) setText(this.empty, emptyPlotText(wb, plotScene.channels.length));
    else if (isOnlyRoot) setText(this.empty, SELECT_A_JOINT);
    if (!this.picture.draw(scene)) this.drawSoon();
    this.picture.drawOverlay(wb.transport.get().timeSeconds, hover, this.box);
    this.legend.show(scene);
    this.frame.show(scene);
    this.readout.show(scene, this.input.pointer, hover);
    this.afterDraw?.();
  }

  /** Fits the values when other channels or another take are shown, but not when keys move. */
  private fitWhereNew(): void {
    const { plotScene, wb } = this;
    if (this.dragging) return;
    const view = wb.timeline.view.get();
    const names = (timelineTake(wb)?.parts ?? []).map(
      ({ character, take }) => `${character.id} ${character.shownTake} ${take.layers?.active ?? ''}`,
    );
    const name = names.join(' ');
    const { lines, theirs } = plotScene.scene;
    // Hiding a curve doesn't refit the others.
    const channels = [
      view.normalised ? 1 : 0,
      lines.length ? 1 : 0,
      theirs ? 1 : 0,
      ...(viewOfAll(wb).isolated ?? []),
      -1,
      ...plotScene.channels.map((c) => c.channel),
    ];
    const before = this.fittedTo;
    if (!this.pendingFit && before.take === name && sameNumbers(before.channels, channels)) return;
    this.fittedTo = { take: name, channels };
    this.pendingFit = false;
    this.look(fitted(plotScene.scene, 'values'));
  }
}
