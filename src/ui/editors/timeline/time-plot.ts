/** What charts over the timeline's time draw alike: their colours, axis of values, lines and readout. */

import { roundStep, wholeNumbers } from '../../../math/round-steps.ts';
import { timeX } from '../../widgets/time/time-window.ts';
import { readTimeColours, type TimeColours, type TimeView } from './time-ground.ts';
import { type FrameRow, traceFrames } from './trace-frames.ts';

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

/** Values from bottom to top of a chart. */
export interface ValueAxis {
  /** Of the chart, and of the margins in it; CSS pixels. */
  readonly height: number;
  readonly head: number;
  readonly foot: number;
  /** At the margins; `most` is larger. */
  readonly least: number;
  readonly most: number;
}

/** Pixels between labels, at least. */
const LABELS_APART = 28;
/** Safety limit. */
const MAX_TICKS = 1000;

/** Pixels from the top. */
export function valueY({ height, head, foot, least, most }: ValueAxis, value: number): number {
  return height - foot - ((value - least) / (most - least)) * (height - head - foot);
}

/**
 * Round values on an axis, ascending, far enough apart for labels.
 *
 * @param factor of the unit in which they are round
 */
export function valueTicks({ height, head, foot, least, most }: ValueAxis, factor = 1): number[] {
  const room = Math.max(LABELS_APART, height - head - foot);
  const step = roundStep(((most - least) * factor * LABELS_APART) / room) / factor;
  return wholeNumbers(least / step - 1e-9, most / step + 1e-9, MAX_TICKS).map((i) => i * step);
}

/** Lines at round values; that at 0 is stronger. */
export function drawValueGrid(
  g: CanvasRenderingContext2D,
  axis: ValueAxis,
  ticks: readonly number[],
  width: number,
  colours: PlotColours,
): void {
  for (const value of ticks) {
    g.fillStyle = value === 0 ? colours.line : colours.fineLine;
    g.fillRect(0, Math.round(valueY(axis, value)), width, 1);
  }
}

export interface ValueLine {
  readonly frames: FrameRow;
  readonly values: ArrayLike<number>;
  readonly colour: string;
  readonly width: number;
  /** Default: solid. */
  readonly dash?: readonly number[];
  /** Default 1. */
  readonly opacity?: number;
}

/** A value for each frame, as a line. */
export function drawValueLine(g: CanvasRenderingContext2D, view: TimeView, axis: ValueAxis, line: ValueLine): void {
  g.save();
  g.lineJoin = 'round';
  g.lineWidth = line.width;
  g.strokeStyle = line.colour;
  g.globalAlpha = line.opacity ?? 1;
  g.setLineDash([...(line.dash ?? [])]);
  g.beginPath();
  traceFrames(g, view, line.frames, line.values, (value) => valueY(axis, value));
  g.stroke();
  g.restore();
}

/** A value that the pointer can read. */
export interface Readable {
  readonly timeSeconds: number;
  /** Pixels from the top. */
  readonly y: number;
  /** What it is, and how much: `Hips  1.2 m`. */
  text(): string;
}

/** Distance within which the pointer reads a value; CSS pixels. */
const REACH_PIXELS = 14;

/** What the pointer reads; of two equally near ones the first. */
export function nearest(all: readonly Readable[], y: number): Readable | undefined {
  let found: Readable | undefined;
  let reach = REACH_PIXELS;
  for (const one of all) {
    const away = Math.abs(one.y - y);
    if (found ? away >= reach : !(away <= reach)) continue;
    reach = away;
    found = one;
  }
  return found;
}

/** A point of a line, and its value in words. */
export function drawReadout(
  g: CanvasRenderingContext2D,
  view: TimeView,
  { timeSeconds, y, text }: Pick<Readable, 'timeSeconds' | 'y'> & { readonly text: string },
  colours: PlotColours,
): void {
  const x = timeX(view, timeSeconds);
  g.fillStyle = colours.text;
  drawDot(g, x, y);
  g.font = colours.font;
  const width = g.measureText(text).width + 12;
  const left = Math.round(Math.max(2, Math.min(view.width - width - 2, x + 8)));
  const top = Math.round(Math.max(2, y - 26));
  g.fillStyle = colours.raised;
  g.strokeStyle = colours.line;
  g.beginPath();
  g.roundRect(left + 0.5, top + 0.5, Math.round(width), 20, 4);
  g.fill();
  g.stroke();
  g.fillStyle = colours.text;
  g.textAlign = 'left';
  g.textBaseline = 'middle';
  g.fillText(text, left + 6, top + 10.5);
}

/** A point of a line. */
export function drawDot(g: CanvasRenderingContext2D, x: number, y: number): void {
  g.beginPath();
  g.arc(x, y, 3, 0, 2 * Math.PI);
  g.fill();
}
