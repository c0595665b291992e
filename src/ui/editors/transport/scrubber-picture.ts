/**
 * Draws the scrubber: ruler, playback range, keys as diamonds, playhead. On a canvas, since a clip may have any number
 * of keys.
 */
import { bucketKeys, MEANT_KEY, NO_KEY } from '../../../evaluate/plot/key-buckets.ts';
import type { ShownChannel } from '../../../evaluate/plot/shown-keys.ts';
import { drawMarkers, type MarkerColours, type ShownMarker } from '../../widgets/time/markers-picture.ts';
import { drawPlayheadAt } from '../../widgets/time/playhead.ts';
import { rulerTicks } from '../../widgets/time/ruler.ts';
import type { TimeWindow } from '../../widgets/time/time-window.ts';

export interface ScrubberColours extends MarkerColours {
  readonly text: string;
  readonly faint: string;
  readonly line: string;
  readonly range: string;
  readonly edge: string;
  readonly key: string;
  readonly otherKey: string;
  readonly playhead: string;
  readonly playheadText: string;
}

export interface ScrubberPicture {
  readonly window: TimeWindow;
  readonly range: readonly [number, number];
  readonly timeSeconds: number;
  readonly channels: readonly ShownChannel[];
  readonly markers: readonly ShownMarker[];
  /** Counts in frames if given. */
  readonly framesPerSecond: number | undefined;
  /** At the playhead. */
  readonly timeText: string;
}

/** Heights in CSS pixels. */
export const RULER_HEIGHT = 20;
/** CSS pixels that a handle of the range is wide, from the range outwards. */
export const HANDLE_WIDTH = 8;
const LABEL_SPACING = 64;
/** Half a diamond; keys closer than this are merged. */
const DIAMOND = 4;

/** Everything except the playhead: redrawn only when window, range or keys change. */
export class ScrubberBackground {
  private readonly canvas = document.createElement('canvas');
  private buckets = new Uint8Array(0);

  draw(picture: ScrubberPicture, width: number, height: number, ratio: number, colours: ScrubberColours): void {
    this.canvas.width = Math.max(1, Math.round(width * ratio));
    this.canvas.height = Math.max(1, Math.round(height * ratio));
    const g = this.canvas.getContext('2d');
    if (!g) return;
    g.scale(ratio, ratio);
    const { window, range } = picture;
    const pixelsPerSecond = width / (window.to - window.from);
    const x = (seconds: number) => (seconds - window.from) * pixelsPerSecond;
    drawRange(g, x(range[0]), x(range[1]), width, height, colours);
    drawRuler(g, picture, x, width, height, colours);
    if (this.buckets.length !== Math.ceil(width)) this.buckets = new Uint8Array(Math.max(1, Math.ceil(width)));
    bucketKeys(picture.channels, window.from, 1 / pixelsPerSecond, this.buckets);
    drawMarkers(g, picture.markers, x, width, RULER_HEIGHT, colours);
    drawKeys(g, this.buckets, RULER_HEIGHT + (height - RULER_HEIGHT) / 2, colours);
  }

  copyTo(g: CanvasRenderingContext2D): void {
    g.setTransform(1, 0, 0, 1, 0, 0);
    g.clearRect(0, 0, g.canvas.width, g.canvas.height);
    g.drawImage(this.canvas, 0, 0);
  }
}

export function drawScrubberPlayhead(
  g: CanvasRenderingContext2D,
  picture: ScrubberPicture,
  width: number,
  height: number,
  ratio: number,
  colours: ScrubberColours,
): void {
  g.setTransform(ratio, 0, 0, ratio, 0, 0);
  const { window, timeSeconds, timeText } = picture;
  const x = ((timeSeconds - window.from) / (window.to - window.from)) * width;
  const place = { width, rulerHeight: RULER_HEIGHT, inset: 1 };
  drawPlayheadAt(g, { x, text: timeText, lineWidth: 2, bottom: height }, place, colours);
}

function drawRange(
  g: CanvasRenderingContext2D,
  left: number,
  right: number,
  width: number,
  height: number,
  colours: ScrubberColours,
): void {
  const from = Math.max(0, left);
  const to = Math.min(width, right);
  g.fillStyle = colours.range;
  if (to > from) g.fillRect(from, 0, to - from, height);
  g.fillStyle = colours.edge;
  for (const edge of [left, right]) if (edge >= -1 && edge <= width) g.fillRect(Math.round(edge) - 1, 0, 2, height);
  for (const outer of [Math.round(left) - HANDLE_WIDTH, Math.round(right)]) drawHandle(g, outer, height, colours);
}

/** Two lines on a tab, below the ruler. */
function drawHandle(g: CanvasRenderingContext2D, left: number, height: number, colours: ScrubberColours): void {
  const middle = RULER_HEIGHT + (height - RULER_HEIGHT) / 2;
  g.fillStyle = colours.edge;
  g.globalAlpha = 0.4;
  g.fillRect(left, RULER_HEIGHT + 1, HANDLE_WIDTH, height - RULER_HEIGHT - 1);
  g.globalAlpha = 1;
  for (const x of [2, 5]) g.fillRect(left + x, middle - 5, 1, 10);
}

function drawRuler(
  g: CanvasRenderingContext2D,
  { window, framesPerSecond }: ScrubberPicture,
  x: (seconds: number) => number,
  width: number,
  height: number,
  colours: ScrubberColours,
): void {
  const scale = { fromSeconds: window.from, toSeconds: window.to, width, spacing: LABEL_SPACING };
  g.font = colours.font;
  g.textAlign = 'left';
  g.textBaseline = 'middle';
  for (const tick of rulerTicks(framesPerSecond ? { ...scale, framesPerSecond } : scale)) {
    const at = Math.round(x(tick.timeSeconds));
    g.fillStyle = colours.line;
    if (tick.label === undefined) {
      g.fillRect(at, RULER_HEIGHT - 4, 1, 4);
      continue;
    }
    g.fillRect(at, 4, 1, height - 4);
    g.fillStyle = colours.faint;
    g.fillText(tick.label, at + 4, RULER_HEIGHT / 2);
  }
  g.fillStyle = colours.line;
  g.fillRect(0, RULER_HEIGHT, width, 1);
}

function drawKeys(g: CanvasRenderingContext2D, buckets: Uint8Array, y: number, colours: ScrubberColours): void {
  for (const meant of [false, true]) {
    g.fillStyle = meant ? colours.key : colours.otherKey;
    g.beginPath();
    let last = -Infinity;
    for (let x = 0; x < buckets.length; x++) {
      if (buckets[x] === NO_KEY || (buckets[x] === MEANT_KEY) !== meant) continue;
      // Neighbouring keys merge into a band, for which every other pixel suffices.
      if (x - last < 2) continue;
      last = x;
      g.moveTo(x + 0.5, y - DIAMOND);
      g.lineTo(x + 0.5 + DIAMOND, y);
      g.lineTo(x + 0.5, y + DIAMOND);
      g.lineTo(x + 0.5 - DIAMOND, y);
      g.closePath();
    }
    g.fill();
  }
}
