/**
 * Pointer and keys over a chart of values over time: a drag scrubs, the wheel and two fingers zoom in time, the wheel
 * with Shift pans (`wheel.ts`); A and F fit, + and − zoom about the playhead. Charts share the timeline's time window.
 */

import type { Uses } from '../../state/workbench.ts';
import { followPointer } from '../../widgets/drag.ts';
import {
  panWindow,
  pinchWindow,
  secondsPerPixel,
  type TimeWindow,
  timeAt,
  zoomWindow,
} from '../../widgets/time/time-window.ts';
import { wheelTurn } from '../../widgets/time/wheel.ts';
import { scrubFrames } from './scrub-frames.ts';
import type { TimeView } from './time-ground.ts';

/** Of one key press. */
const ZOOM_STEP = 1.2;

/** CSS pixels from the top left corner. */
export interface ChartPoint {
  readonly x: number;
  readonly y: number;
}

export interface ScrubbedChart {
  readonly element: HTMLElement;
  timeView(): TimeView;
  /** @param snapsTo frames per second; undefined: to no frame */
  scrubbedTime(x: number, snapsTo: number | undefined): number;
  fitAll(): void;
  /** @param at undefined: the pointer has left */
  hoverAt(at: ChartPoint | undefined): void;
}

export class TimeInput {
  /** Ends following the pointer that scrubs, and puts its time back. */
  private endScrub: (() => void) | undefined;
  /** x of the fingers that are down, by pointer. */
  private readonly fingers = new Map<number, number>();
  private pinch: { readonly window: TimeWindow; readonly from: readonly [number, number] } | undefined;

  constructor(
    private readonly wb: Uses<'transport' | 'timeline'>,
    private readonly chart: ScrubbedChart,
  ) {
    this.listen();
  }

  private listen(): void {
    const { element: target } = this.chart;
    target.addEventListener('pointerdown', (event) => {
      if (event.button !== 0 || !this.isLaidOut()) return;
      if (event.pointerType === 'touch') this.fingers.set(event.pointerId, this.at(event).x);
      if (this.fingers.size === 2) this.beginPinch();
      if (this.fingers.size < 2) this.beginScrub(event);
    });
    target.addEventListener('pointermove', (event) => {
      if (this.fingers.has(event.pointerId)) this.fingers.set(event.pointerId, this.at(event).x);
      if (this.pinch) this.onPinch(this.pinch);
      this.chart.hoverAt(this.at(event));
    });
    for (const end of ['pointerup', 'pointercancel'] as const) {
      target.addEventListener(end, ({ pointerId }) => {
        if (this.fingers.delete(pointerId)) this.pinch = undefined;
      });
    }
    target.addEventListener('pointerleave', () => this.chart.hoverAt(undefined));
    target.addEventListener('wheel', (event) => this.isLaidOut() && this.onWheel(event), { passive: false });
    target.addEventListener('keydown', (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      const { window } = this.wb.timeline.view.get();
      const { timeSeconds } = this.wb.transport.get();
      if (event.key === 'a' || event.key === 'A' || event.key === 'f' || event.key === 'F') this.chart.fitAll();
      else if (event.key === '+' || event.key === '=') this.look(zoomWindow(window, timeSeconds, 1 / ZOOM_STEP));
      else if (event.key === '-') this.look(zoomWindow(window, timeSeconds, ZOOM_STEP));
      else return;
      event.preventDefault();
    });
  }

  /** In the frame in which its tab opens, and folded in mid-drag, a chart has no width, and shows no times. */
  private isLaidOut(): boolean {
    return this.chart.timeView().width > 0;
  }

  private look(window: TimeWindow): void {
    this.wb.timeline.change({ window });
  }

  private at(event: MouseEvent): ChartPoint {
    const box = this.chart.element.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  private scrub(event: MouseEvent): void {
    if (!this.isLaidOut()) return;
    const timeSeconds = this.chart.scrubbedTime(this.at(event).x, scrubFrames(this.wb, event.shiftKey));
    this.wb.transport.update((p) => ({ ...p, timeSeconds, playing: false }));
  }

  private beginScrub(press: PointerEvent): void {
    const { timeSeconds, playing } = this.wb.transport.get();
    this.scrub(press);
    const leave = followPointer(this.chart.element, press, {
      move: (event) => this.scrub(event),
      over: () => (this.endScrub = undefined),
    });
    this.endScrub = () => {
      leave();
      this.endScrub = undefined;
      this.wb.transport.update((p) => ({ ...p, timeSeconds, playing }));
    };
  }

  /** The first of two fingers has scrubbed until now, and didn't mean to. */
  private beginPinch(): void {
    this.endScrub?.();
    const [a, b] = this.fingers.values();
    this.pinch = { window: this.wb.timeline.view.get().window, from: [a, b] };
  }

  private onPinch({ window, from }: NonNullable<typeof this.pinch>): void {
    if (!this.isLaidOut()) return;
    const [a, b] = this.fingers.values();
    this.look(pinchWindow(window, this.chart.timeView().width, from, [a, b]));
  }

  private onWheel(event: WheelEvent): void {
    event.preventDefault();
    const view = this.chart.timeView();
    const turn = wheelTurn(event);
    if (turn.what === 'zoom') this.look(zoomWindow(view.window, timeAt(view, this.at(event).x), turn.factor));
    else this.look(panWindow(view.window, turn.pixels * secondsPerPixel(view)));
  }
}
