/**
 * Draws time behind and over a plot: grid, range and playhead, below the ruler (`transport/scrubber.ts`), with which
 * all plots share the time window. Everything is in CSS pixels: the context is scaled by the caller.
 */

import { drawPlayheadLine } from '../../widgets/time/playhead.ts';
import { rulerTicks } from '../../widgets/time/ruler.ts';
import { type TimeStrip, timeX } from '../../widgets/time/time-window.ts';

/** The visible time range, in seconds of the transport, and its units. */
export interface TimeView extends TimeStrip {
  /** Shaded outside; seconds of the transport. */
  readonly range: readonly [number, number];
  readonly framesPerSecond: number;
  /** Frames instead of seconds. */
  readonly inFrames: boolean;
}

export interface TimeColours {
  readonly font: string;
  readonly faint: string;
  /** Grid lines at labels, and between them. */
  readonly line: string;
  readonly fineLine: string;
  readonly outside: string;
  readonly playhead: string;
}

/** The stylesheet's colours for this element. */
export function readTimeColours(target: Element): TimeColours {
  const style = getComputedStyle(target);
  const colour = (name: string) => style.getPropertyValue(name).trim();
  return {
    faint: colour('--text-faint'),
    line: colour('--plot-line'),
    fineLine: translucent(colour('--plot-line'), 0.5),
    outside: colour('--outside'),
    playhead: colour('--accent'),
    font: `${colour('--font-small')} ${style.fontFamily}`,
  };
}

/** `#rrggbb` with an opacity. */
export function translucent(colour: string, opacity: number): string {
  return `${colour}${Math.round(255 * opacity)
    .toString(16)
    .padStart(2, '0')}`;
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

/** The ruler's playhead continues as a line over the whole plot. */
export function drawPlayhead(
  g: CanvasRenderingContext2D,
  view: TimeView,
  timeSeconds: number,
  bottom: number,
  colours: TimeColours,
): void {
  drawPlayheadLine(g, timeX(view, timeSeconds), 0, bottom, colours.playhead);
}

function timeTicks({ window, width, framesPerSecond, inFrames }: TimeView) {
  return rulerTicks({ window, width, ...(inFrames && { framesPerSecond }) });
}
