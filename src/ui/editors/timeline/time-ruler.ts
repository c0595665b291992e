/**
 * Draws time: ruler, grid, range and playhead on a canvas, the same for the curve editor and the dope sheet, which
 * share the time window. Everything is in CSS pixels: the context is scaled by the caller.
 */

import { aligned, shown } from '../../widgets/numbers/number-text.ts';
import { drawMarkers, type MarkerColours, type ShownMarker } from '../../widgets/time/markers-picture.ts';
import { drawPlayheadAt } from '../../widgets/time/playhead.ts';
import { rulerTicks } from '../../widgets/time/ruler.ts';
import type { TimeWindow } from '../../widgets/time/time-window.ts';

export const TIME_RULER_HEIGHT = 22;
const LABEL_SPACING = 64;

/** The visible time range, and its units. */
export interface TimeView {
  /** Seconds of the transport from x = 0 to x = width. */
  readonly window: TimeWindow;
  readonly width: number;
  /** Shaded outside; seconds of the transport. */
  readonly range: readonly [number, number];
  readonly framesPerSecond: number;
  /** Frames instead of seconds. */
  readonly inFrames: boolean;
  /** Of the take that is shown; drawn below the ruler. */
  readonly markers?: readonly ShownMarker[];
}

export interface TimeColours extends MarkerColours {
  readonly faint: string;
  /** Grid lines at labels, and between them. */
  readonly line: string;
  readonly fineLine: string;
  readonly ruler: string;
  readonly outside: string;
  readonly range: string;
  readonly edge: string;
  readonly playhead: string;
  readonly playheadText: string;
}

/** The stylesheet's colours for this element. */
export function readTimeColours(target: Element): TimeColours {
  const style = getComputedStyle(target);
  const colour = (name: string) => style.getPropertyValue(name).trim();
  return {
    faint: colour('--text-faint'),
    marker: colour('--warning'),
    markerText: colour('--text'),
    line: colour('--plot-line'),
    fineLine: translucent(colour('--plot-line'), 0.5),
    ruler: colour('--surface'),
    outside: colour('--ground'),
    range: colour('--range'),
    edge: colour('--range-edge'),
    playhead: colour('--accent'),
    playheadText: colour('--on-accent'),
    font: `${colour('--font-small')} ${style.fontFamily}`,
  };
}

/** `#rrggbb` with an opacity. */
export function translucent(colour: string, opacity: number): string {
  return `${colour}${Math.round(255 * opacity)
    .toString(16)
    .padStart(2, '0')}`;
}

/** Pixels from the left edge. */
export function timeX({ window, width }: TimeView, seconds: number): number {
  return ((seconds - window.from) / (window.to - window.from)) * width;
}

/** Shades what is outside the range, between two heights. */
export function drawOutsideRange(
  g: CanvasRenderingContext2D,
  view: TimeView,
  top: number,
  bottom: number,
  colours: TimeColours,
): void {
  const from = Math.min(view.width, Math.max(0, timeX(view, view.range[0])));
  const to = Math.min(view.width, Math.max(0, timeX(view, view.range[1])));
  g.fillStyle = colours.outside;
  g.fillRect(0, top, from, bottom - top);
  g.fillRect(to, top, view.width - to, bottom - top);
}

/** Vertical lines at the ruler's ticks, between two heights. */
export function drawTimeGrid(
  g: CanvasRenderingContext2D,
  view: TimeView,
  top: number,
  bottom: number,
  colours: TimeColours,
): void {
  const ticks = timeTicks(view);
  for (const labelled of [false, true]) {
    g.fillStyle = labelled ? colours.line : colours.fineLine;
    for (const tick of ticks) {
      if ((tick.label !== undefined) === labelled) {
        g.fillRect(Math.round(timeX(view, tick.timeSeconds)), top, 1, bottom - top);
      }
    }
  }
}

/** The ruler at the top, with the range along its bottom edge. */
export function drawTimeRuler(g: CanvasRenderingContext2D, view: TimeView, colours: TimeColours): void {
  g.fillStyle = colours.ruler;
  g.fillRect(0, 0, view.width, TIME_RULER_HEIGHT);
  const from = Math.max(0, timeX(view, view.range[0]));
  const to = Math.min(view.width, timeX(view, view.range[1]));
  if (to > from) {
    g.fillStyle = colours.range;
    g.fillRect(from, 0, to - from, TIME_RULER_HEIGHT);
  }
  g.font = colours.font;
  g.textAlign = 'left';
  g.textBaseline = 'middle';
  for (const tick of timeTicks(view)) {
    const x = Math.round(timeX(view, tick.timeSeconds));
    g.fillStyle = colours.faint;
    if (tick.label === undefined) {
      g.globalAlpha = 0.5;
      g.fillRect(x, TIME_RULER_HEIGHT - 4, 1, 4);
    } else {
      g.globalAlpha = 0.7;
      g.fillRect(x, TIME_RULER_HEIGHT - 8, 1, 8);
      g.globalAlpha = 1;
      g.fillText(tick.label, x + 4, TIME_RULER_HEIGHT / 2 - 1);
    }
    g.globalAlpha = 1;
  }
  g.fillStyle = colours.line;
  g.fillRect(0, TIME_RULER_HEIGHT - 1, view.width, 1);
  g.fillStyle = colours.edge;
  for (const end of view.range) {
    const x = timeX(view, end);
    if (x >= -1 && x <= view.width) g.fillRect(Math.round(x) - 1, 0, 2, TIME_RULER_HEIGHT);
  }
  const { markers, width } = view;
  if (markers) drawMarkers(g, markers, (seconds) => timeX(view, seconds), width, TIME_RULER_HEIGHT, colours);
}

/** A line down to `bottom`, and its time in the ruler. */
export function drawPlayhead(
  g: CanvasRenderingContext2D,
  view: TimeView,
  timeSeconds: number,
  bottom: number,
  colours: TimeColours,
): void {
  const x = timeX(view, timeSeconds);
  const text = view.inFrames ? shown(timeSeconds * view.framesPerSecond, 1) : aligned(timeSeconds, 2);
  const place = { width: view.width, rulerHeight: TIME_RULER_HEIGHT, inset: 2 };
  drawPlayheadAt(g, { x, text, lineWidth: 1, bottom }, place, colours);
}

function timeTicks({ window, width, framesPerSecond, inFrames }: TimeView) {
  const scale = { fromSeconds: window.from, toSeconds: window.to, width, spacing: LABEL_SPACING };
  return rulerTicks(inFrames ? { ...scale, framesPerSecond } : scale);
}
