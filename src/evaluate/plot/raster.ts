/**
 * Rasterises columns of pixels into an image without a canvas: from the smallest to the largest value of each, with
 * antialiased ends. Stroking the same as paths takes a software canvas 200 times as long.
 *
 * Columns are painted in strips, where each column is contiguous in memory, and then copied to rows.
 */
import { DOTTED_COLUMN, NO_COLUMN, type TracedColumns } from './trace-columns.ts';

/** A curve as columns, with its colour and line width. */
export interface ColumnLine {
  readonly columns: TracedColumns;
  /** `#rrggbb` */
  readonly colour: string;
  /** CSS pixels. */
  readonly width: number;
}

const STRIP = 16;
const OPAQUE = 0xff000000;
/**
 * Extrapolated parts are dotted in a chessboard, so that no peak falls between two dots: squares of this many CSS
 * pixels.
 */
const DOT_PIXELS = 2;
/** Longer runs use `fill`. */
const LONG_RUN = 24;

/** Draws curves given as columns into an image of its own. */
export class ColumnRaster {
  /** Red, green, blue, alpha in bytes, row by row, as in an ImageData. */
  pixels: Uint8ClampedArray<ArrayBuffer> = new Uint8ClampedArray(0);
  private words = new Uint32Array(0);
  /** Premultiplied, as blending needs; the image is not. */
  private strip = new Uint32Array(0);
  /** Painted rows of the strip: from, and up to (excluding). */
  private top = 0;
  private bottom = 0;
  /** The same for every strip of the previous picture; only these have to be cleared. */
  private tops = new Int32Array(0);
  private bottoms = new Int32Array(0);

  /**
   * Paints a strip at a time and yields after each. The image is complete at the end.
   * @param lines back to front
   * @param ratio image pixels per CSS pixel
   * @param columnsPerPixel trace columns per CSS pixel; if the image has more pixels, columns are widened
   */
  *painting(
    lines: readonly ColumnLine[],
    width: number,
    height: number,
    ratio: number,
    columnsPerPixel = ratio,
  ): Generator<void, void> {
    const wide = ratio / columnsPerPixel;
    const count = Math.ceil(width / wide);
    const strips = Math.ceil(count / STRIP);
    if (this.words.length !== width * height || this.tops.length !== strips) {
      this.pixels = new Uint8ClampedArray(4 * width * height);
      this.words = new Uint32Array(this.pixels.buffer);
      this.tops = new Int32Array(strips);
      this.bottoms = new Int32Array(strips);
    }
    if (this.strip.length !== STRIP * height) this.strip = new Uint32Array(STRIP * height);
    const colours = lines.map((line) => wordOf(line.colour));
    for (let s = 0; s < strips; s++) {
      const left = s * STRIP;
      const right = Math.min(count, left + STRIP);
      this.top = height;
      this.bottom = 0;
      for (let l = 0; l < lines.length; l++) {
        this.paintLine(lines[l], colours[l], left, right, height, ratio, columnsPerPixel);
      }
      const from = Math.min(this.top, this.tops[s]);
      const to = Math.max(this.bottom, this.bottoms[s]);
      this.copyStrip(
        left,
        Math.ceil(left * wide),
        Math.min(width, Math.ceil(right * wide)),
        wide,
        width,
        height,
        from,
        to,
      );
      this.tops[s] = this.top;
      this.bottoms[s] = this.bottom;
      yield;
    }
  }

  /** Copies rows `from` up to `to` of the strip into the image, and clears the strip. */
  private copyStrip(
    left: number,
    x0: number,
    x1: number,
    wide: number,
    width: number,
    height: number,
    from: number,
    to: number,
  ): void {
    const { strip, words } = this;
    if (from >= to) return;
    for (let x = x0; x < x1; x++) {
      let at = from * width + x;
      const column = (Math.floor(x / wide) - left) * height;
      for (let y = column + from; y < column + to; y++) {
        const word = strip[y];
        const alpha = word >>> 24;
        words[at] = alpha === 0 || alpha === 255 ? word : unpremultiplied(word, alpha);
        at += width;
      }
    }
    strip.fill(0);
  }

  private paintLine(
    line: ColumnLine,
    word: number,
    left: number,
    right: number,
    height: number,
    ratio: number,
    columnsPerPixel: number,
  ): void {
    const { tops, bottoms, kinds } = line.columns;
    const { strip } = this;
    const half = (line.width * ratio) / 2;
    const end = Math.min(right, line.columns.to);
    for (let x = Math.max(left, line.columns.from); x < end; x++) {
      const kind = kinds[x];
      if (kind === NO_COLUMN) continue;
      const from = Math.max(0, tops[x] * ratio - half);
      const to = Math.min(height, bottoms[x] * ratio + half);
      if (!(from < to)) continue;
      const column = (x - left) * height;
      const first = from | 0;
      const last = Math.ceil(to) - 1;
      if (first < this.top) this.top = first;
      if (last >= this.bottom) this.bottom = last + 1;
      if (kind === DOTTED_COLUMN) {
        this.dottedRun(column, Math.floor(x / columnsPerPixel), from, to, word, DOT_PIXELS * ratio);
      } else if (first === last) {
        strip[column + first] = over(strip[column + first], word, ((to - from) * 256) | 0);
      } else {
        // The first and last pixel by coverage, and all in between.
        strip[column + first] = over(strip[column + first], word, ((first + 1 - from) * 256) | 0);
        strip[column + last] = over(strip[column + last], word, ((to - last) * 256) | 0);
        if (last - first > LONG_RUN) strip.fill(word, column + first + 1, column + last);
        else for (let y = column + first + 1; y < column + last; y++) strip[y] = word;
      }
    }
  }

  /** One column of a chessboard's squares; `x` in CSS pixels, the rest in image pixels. */
  private dottedRun(column: number, x: number, from: number, to: number, word: number, square: number): void {
    const odd = Math.floor(x / DOT_PIXELS) % 2;
    const last = Math.ceil(to) - 1;
    for (let y = Math.floor(from); y <= last; y++) {
      if (Math.floor(y / square) % 2 !== odd) continue;
      const coverage = Math.min(to, y + 1) - Math.max(from, y);
      this.strip[column + y] = over(this.strip[column + y], word, (coverage * 256) | 0);
    }
  }
}

/**
 * Blends an opaque colour over a premultiplied one, covering `part` 256ths of the pixel. Two of the four bytes at a
 * time, each with room for the product above it.
 */
function over(below: number, word: number, part: number): number {
  const rest = 256 - part;
  const redBlue = Math.imul(below & 0xff00ff, rest) + Math.imul(word & 0xff00ff, part);
  const alphaGreen = Math.imul((below >>> 8) & 0xff00ff, rest) + Math.imul((word >>> 8) & 0xff00ff, part);
  return ((redBlue >>> 8) & 0xff00ff) | (alphaGreen & 0xff00ff00);
}

function unpremultiplied(word: number, alpha: number): number {
  const red = Math.min(255, ((word & 255) * 255) / alpha + 0.5);
  const green = Math.min(255, (((word >>> 8) & 255) * 255) / alpha + 0.5);
  const blue = Math.min(255, (((word >>> 16) & 255) * 255) / alpha + 0.5);
  return (alpha << 24) | (blue << 16) | (green << 8) | red;
}

/** In memory order: every machine that runs a browser is little-endian. */
function wordOf(colour: string): number {
  const [red, green, blue] = [1, 3, 5].map((at) => Number.parseInt(colour.slice(at, at + 2), 16));
  return (OPAQUE | (blue << 16) | (green << 8) | red) >>> 0;
}
