/** What all plots over the timeline's time have in common: their time, when they redraw, and the readout. */

import type { Uses } from '../../state/workbench.ts';
import { shown } from '../../widgets/numbers/number-text.ts';
import { timeX } from '../../widgets/time/time-window.ts';
import { readTimeColours, type TimeColours, type TimeView } from './time-ground.ts';

export interface TimePlot {
  readonly visible: boolean;
  /** CSS pixels; set here. */
  size: { readonly width: number; readonly height: number };
  /** All of it, in the next frame. */
  redraw(): void;
  /** Only what moves with time. */
  drawSoon(): void;
}

/**
 * Redraws a plot when its size, the visible time, the units or the playhead change.
 *
 * @param chart where the plot is drawn
 */
export function followTime(wb: Uses<'transport' | 'timeline' | 'settings'>, chart: HTMLElement, plot: TimePlot): void {
  new ResizeObserver(() => {
    plot.size = { width: chart.clientWidth, height: chart.clientHeight };
    plot.redraw();
  }).observe(chart);
  wb.timeline.view.subscribe((now, before) => {
    if (now.window !== before.window) plot.redraw();
  });
  wb.settings.subscribe((now, before) => {
    if (now.timeDisplay !== before.timeDisplay) plot.redraw();
  });
  wb.transport.subscribe((now, before) => {
    if (now.range !== before.range || now.framesPerSecond !== before.framesPerSecond) plot.redraw();
    plot.drawSoon();
  });
}

/** @param width CSS pixels */
export function timeViewOf(wb: Uses<'transport' | 'timeline' | 'settings'>, width: number): TimeView {
  const { range, framesPerSecond } = wb.transport.get();
  const inFrames = wb.settings.get().timeDisplay === 'frames';
  return { window: wb.timeline.view.get().window, width, range, framesPerSecond, inFrames };
}

/** `frame 12` or `0.4 s`. */
export function whenText({ inFrames, framesPerSecond }: TimeView, timeSeconds: number): string {
  return inFrames ? `frame ${shown(timeSeconds * framesPerSecond, 1)}` : `${shown(timeSeconds)} s`;
}

export interface PlotColours extends TimeColours {
  readonly plot: string;
  readonly text: string;
  readonly raised: string;
}

/** Colours of plotted joints in order; the first is the selection's. */
export const JOINT_COLOURS = ['--selected', '--axis-z', '--axis-y', '--axis-x', '--accent'] as const;

/** The stylesheet's colours for this element. */
export function readPlotColours(target: Element): PlotColours {
  return {
    ...readTimeColours(target),
    plot: styleColour(target, '--plot'),
    text: styleColour(target, '--text'),
    raised: styleColour(target, '--raised'),
  };
}

/** @param name of a custom property */
export function styleColour(target: Element, name: string): string {
  return getComputedStyle(target).getPropertyValue(name).trim();
}

/** A point of a line, and its value in words. */
export interface PlotReadout {
  readonly timeSeconds: number;
  /** Pixels from the top. */
  readonly y: number;
  readonly text: string;
}

export function drawReadout(
  g: CanvasRenderingContext2D,
  view: TimeView,
  readout: PlotReadout,
  colours: PlotColours,
): void {
  const x = timeX(view, readout.timeSeconds);
  g.fillStyle = colours.text;
  drawDot(g, x, readout.y);
  g.font = colours.font;
  const width = g.measureText(readout.text).width + 12;
  const left = Math.round(Math.max(2, Math.min(view.width - width - 2, x + 8)));
  const top = Math.round(Math.max(2, readout.y - 26));
  g.fillStyle = colours.raised;
  g.strokeStyle = colours.line;
  g.beginPath();
  g.roundRect(left + 0.5, top + 0.5, Math.round(width), 20, 4);
  g.fill();
  g.stroke();
  g.fillStyle = colours.text;
  g.textAlign = 'left';
  g.textBaseline = 'middle';
  g.fillText(readout.text, left + 6, top + 10.5);
}

/** A point of a line. */
export function drawDot(g: CanvasRenderingContext2D, x: number, y: number): void {
  g.beginPath();
  g.arc(x, y, 3, 0, 2 * Math.PI);
  g.fill();
}
