/**
 * Paints columns of pixels into an image, without a canvas: the smallest to the largest value of each, with its ends
 * as far covered as the curve gets into their pixels. Stroking the same as paths takes software 200 times as long.
 *
 * Columns are painted in strips, each column contiguous and near, and copied to rows from there.
 */
import { DOTTED_COLUMN, type LineTrace, NO_COLUMN } from './trace.ts';

export interface ColumnLine {
  readonly trace: LineTrace;
  /** `#rrggbb` */
  readonly colour: string;
  /** CSS pixels. */
  readonly width: number;
}

const STRIP = 16;
const OPAQUE = 0xff000000;
/** What is extrapolated is dotted both ways, so that no peak falls between two dots: squares of so many CSS pixels. */
const DOT_PIXELS = 2;
/** Runs longer than this are filled by the engine. */
const LONG_RUN = 24;

export class ColumnRaster {
  /** Red, green, blue, alpha in bytes, row by row: an ImageData's. */
  pixels: Uint8ClampedArray<ArrayBuffer> = new Uint8ClampedArray(0);
  private words = new Uint32Array(0);
  private strip = new Uint32Array(0);

  /** @param lines back to front. @param ratio pixels of the image in a CSS pixel; columns of traces are the image's */
  paint(lines: readonly ColumnLine[], width: number, height: number, ratio: number): void {
    if (this.words.length !== width * height) {
      this.pixels = new Uint8ClampedArray(4 * width * height);
      this.words = new Uint32Array(this.pixels.buffer);
    }
    if (this.strip.length !== STRIP * height) this.strip = new Uint32Array(STRIP * height);
    const words = lines.map((line) => wordOf(line.colour));
    const { strip } = this;
    for (let left = 0; left < width; left += STRIP) {
      const right = Math.min(width, left + STRIP);
      strip.fill(0);
      for (let l = 0; l < lines.length; l++) this.paintLine(lines[l], words[l], left, right, height, ratio);
      for (let y = 0; y < height; y++) {
        for (let x = left; x < right; x++) this.words[y * width + x] = strip[(x - left) * height + y];
      }
    }
  }

  private paintLine(line: ColumnLine, word: number, left: number, right: number, height: number, ratio: number): void {
    const { columns, columnKinds, columnFrom, columnTo } = line.trace;
    const half = (line.width * ratio) / 2;
    const end = Math.min(right, columnTo);
    for (let x = Math.max(left, columnFrom); x < end; x++) {
      const kind = columnKinds[x];
      if (kind === NO_COLUMN) continue;
      const from = Math.max(0, columns[2 * x] * ratio - half);
      const to = Math.min(height, columns[2 * x + 1] * ratio + half);
      if (!(from < to)) continue;
      if (kind === DOTTED_COLUMN) this.dottedRun((x - left) * height, x, from, to, word, DOT_PIXELS * ratio);
      else this.run((x - left) * height, from, to, word);
    }
  }

  /** One column from one height to another, fractions of pixels included. */
  private run(column: number, from: number, to: number, word: number): void {
    const { strip } = this;
    const first = Math.floor(from);
    const last = Math.ceil(to) - 1;
    if (first === last) {
      this.cover(column + first, word, to - from);
      return;
    }
    this.cover(column + first, word, first + 1 - from);
    this.cover(column + last, word, to - last);
    if (last - first > LONG_RUN) strip.fill(word, column + first + 1, column + last);
    else for (let y = first + 1; y < last; y++) strip[column + y] = word;
  }

  /** The same, of every other square of a chessboard. */
  private dottedRun(column: number, x: number, from: number, to: number, word: number, square: number): void {
    const odd = Math.floor(x / square) % 2;
    const last = Math.ceil(to) - 1;
    for (let y = Math.floor(from); y <= last; y++) {
      if (Math.floor(y / square) % 2 !== odd) continue;
      this.cover(column + y, word, Math.min(to, y + 1) - Math.max(from, y));
    }
  }

  /** Lays a colour over a pixel, not premultiplied. */
  private cover(at: number, word: number, coverage: number): void {
    const { strip } = this;
    const below = strip[at];
    const alphaBelow = below >>> 24;
    if (coverage >= 0.998) strip[at] = word;
    else if (alphaBelow === 0) strip[at] = ((coverage * 255 + 0.5) << 24) | (word & 0xffffff);
    else if (alphaBelow === 255) strip[at] = OPAQUE | blend(below, word, (coverage * 256 + 0.5) | 0);
    else {
      const both = coverage * 255 + alphaBelow * (1 - coverage);
      strip[at] = ((both + 0.5) << 24) | blend(below, word, ((coverage * 255 * 256) / both) | 0);
    }
  }
}

/** Red, green and blue from one colour to another by 256ths, two of them at a time. */
function blend(from: number, to: number, part: number): number {
  const rest = 256 - part;
  const redBlue = ((Math.imul(from & 0xff00ff, rest) + Math.imul(to & 0xff00ff, part)) >>> 8) & 0xff00ff;
  const green = (((from & 0xff00) * rest + (to & 0xff00) * part) >>> 8) & 0xff00;
  return redBlue | green;
}

/** As it lies in memory: every machine that a browser runs on stores the lowest byte first. */
function wordOf(colour: string): number {
  const [red, green, blue] = [1, 3, 5].map((at) => Number.parseInt(colour.slice(at, at + 2), 16));
  return (OPAQUE | (blue << 16) | (green << 8) | red) >>> 0;
}
