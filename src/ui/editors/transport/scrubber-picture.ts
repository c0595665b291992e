/**
 * Draws the ruler: numbers and ticks, playback range, keys as diamonds, playhead. On a canvas, since a take may have
 * any number of keys.
 *
 *     y = 0                ┌── numbers, the playhead's flag ──┐   all of it is the time's
 *     RULER_HEIGHT         ├── markers, if the take has any ──┤
 *                          ├── keys ──────────────────────────┤   with the handles of the range, below RULER_HEIGHT
 *                          └──────────────────────────────────┘ height
 */
import { bucketKeys, MEANT_KEY, NO_KEY } from '../../../evaluate/plot/key-buckets.ts';
import type { ShownChannel } from '../../../evaluate/plot/shown-keys.ts';
import {
  drawMarkers,
  MARKER_HEIGHT,
  type MarkerColours,
  type ShownMarker,
} from '../../widgets/time/markers-picture.ts';
import { drawFlag, drawPlayheadLine, type FlagColours, flagExtent, widthOf } from '../../widgets/time/playhead.ts';
import { isClearOf, rulerTicks } from '../../widgets/time/ruler.ts';
import { secondsPerPixel, type TimeStrip, timeX } from '../../widgets/time/time-window.ts';

export interface ScrubberColours extends MarkerColours, FlagColours {
  readonly faint: string;
  readonly line: string;
  readonly range: string;
  readonly edge: string;
  readonly key: string;
  readonly otherKey: string;
}

/** Seconds of the transport; CSS pixels. */
export interface ScrubberPicture extends TimeStrip {
  readonly height: number;
  readonly range: readonly [number, number];
  readonly timeSeconds: number;
  readonly channels: readonly ShownChannel[];
  readonly markers: readonly ShownMarker[];
  /** Counts in frames if given. */
  readonly framesPerSecond: number | undefined;
  /** On the playhead's flag. */
  readonly timeText: string;
}

/** Heights in CSS pixels. */
export const RULER_HEIGHT = 17;
/** CSS pixels that a handle of the range is wide, from the range outwards. */
export const HANDLE_WIDTH = 8;
/** From a tick to its number. */
const BESIDE_TICK = 4;
/** Half a diamond: of keys that count, and of others. Keys closer than this are merged. */
const DIAMOND = 3.5;
const OTHER_DIAMOND = 3;

interface Label {
  readonly text: string;
  readonly left: number;
}

/** Everything except playhead and numbers: redrawn only when window, range or keys change. */
export class ScrubberBackground {
  private readonly canvas = document.createElement('canvas');
  private buckets = new Uint8Array(0);
  private labels: readonly Label[] = [];

  draw(picture: ScrubberPicture, ratio: number, colours: ScrubberColours): void {
    const { width, height, window, range } = picture;
    this.canvas.width = Math.max(1, Math.round(width * ratio));
    this.canvas.height = Math.max(1, Math.round(height * ratio));
    const g = this.canvas.getContext('2d');
    if (!g) return;
    g.scale(ratio, ratio);
    const x = (seconds: number) => timeX(picture, seconds);
    drawRange(g, x(range[0]), x(range[1]), picture, colours);
    this.labels = drawTicks(g, picture, colours);
    if (this.buckets.length !== Math.ceil(width)) this.buckets = new Uint8Array(Math.max(1, Math.ceil(width)));
    bucketKeys(picture.channels, window.from, secondsPerPixel(picture), this.buckets);
    drawMarkers(g, picture.markers, x, width, RULER_HEIGHT, colours);
    const top = RULER_HEIGHT + (picture.markers.length ? MARKER_HEIGHT : 0);
    drawKeys(g, this.buckets, (top + height) / 2, colours);
  }

  /** With playhead and numbers over it. */
  drawOn(g: CanvasRenderingContext2D, picture: ScrubberPicture, ratio: number, colours: ScrubberColours): void {
    g.setTransform(1, 0, 0, 1, 0, 0);
    g.clearRect(0, 0, g.canvas.width, g.canvas.height);
    g.drawImage(this.canvas, 0, 0);
    g.setTransform(ratio, 0, 0, ratio, 0, 0);
    const { width, height, timeSeconds, timeText } = picture;
    const x = timeX(picture, timeSeconds);
    g.font = colours.font;
    const flag = flagExtent(x, widthOf(g, colours.font, timeText), width);
    g.textAlign = 'left';
    g.textBaseline = 'middle';
    g.fillStyle = colours.faint;
    for (const { text, left } of this.labels) {
      const right = left + widthOf(g, colours.font, text);
      if (isClearOf([left, right], flag)) g.fillText(text, left, RULER_HEIGHT / 2);
    }
    if (!flag) return;
    drawPlayheadLine(g, x, RULER_HEIGHT - 2, height, colours.playhead);
    drawFlag(g, flag, timeText, RULER_HEIGHT, colours);
  }
}

function drawRange(
  g: CanvasRenderingContext2D,
  left: number,
  right: number,
  { width, height }: ScrubberPicture,
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

/** Two lines on a tab, below the numbers. */
function drawHandle(g: CanvasRenderingContext2D, left: number, height: number, colours: ScrubberColours): void {
  const middle = RULER_HEIGHT + (height - RULER_HEIGHT) / 2;
  g.fillStyle = colours.edge;
  g.globalAlpha = 0.4;
  g.fillRect(left, RULER_HEIGHT, HANDLE_WIDTH, height - RULER_HEIGHT);
  g.globalAlpha = 1;
  for (const x of [2, 5]) g.fillRect(left + x, middle - 3, 1, 6);
}

/** Returns the numbers at the ticks. */
function drawTicks(g: CanvasRenderingContext2D, picture: ScrubberPicture, colours: ScrubberColours): Label[] {
  const { framesPerSecond, window, width, height } = picture;
  const labels: Label[] = [];
  g.fillStyle = colours.line;
  for (const { timeSeconds, label } of rulerTicks({ window, width, ...(framesPerSecond && { framesPerSecond }) })) {
    const at = Math.round(timeX(picture, timeSeconds));
    if (label === undefined) g.fillRect(at, RULER_HEIGHT - 4, 1, 4);
    else {
      g.fillRect(at, 0, 1, height);
      labels.push({ text: label, left: at + BESIDE_TICK });
    }
  }
  return labels;
}

function drawKeys(g: CanvasRenderingContext2D, buckets: Uint8Array, y: number, colours: ScrubberColours): void {
  for (const meant of [false, true]) {
    g.fillStyle = meant ? colours.key : colours.otherKey;
    const half = meant ? DIAMOND : OTHER_DIAMOND;
    g.beginPath();
    let last = -Infinity;
    for (let x = 0; x < buckets.length; x++) {
      if (buckets[x] === NO_KEY || (buckets[x] === MEANT_KEY) !== meant) continue;
      // Neighbouring keys merge into a band, for which every other pixel suffices.
      if (x - last < 2) continue;
      last = x;
      g.moveTo(x + 0.5, y - half);
      g.lineTo(x + 0.5 + half, y);
      g.lineTo(x + 0.5, y + half);
      g.lineTo(x + 0.5 - half, y);
      g.closePath();
    }
    g.fill();
  }
}
