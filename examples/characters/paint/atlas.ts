/**
 * A procedurally painted texture: every part of a mesh has a rectangle of the atlas, and a function for the colour at a
 * point of its surface. Texels are supersampled (nine times); each rectangle is painted a few texels past its edge, so
 * that smaller mip levels don't bleed.
 */
import type { Rect } from '../shape/mesh.ts';
import { encodePng } from './png.ts';

/** Red, green, blue, 0 … 255. */
export type Colour = readonly [number, number, number];

/** `#rrggbb`. */
export function colour(hex: string): Colour {
  return [1, 3, 5].map((i) => Number.parseInt(hex.slice(i, i + 2), 16)) as unknown as Colour; // three of them
}

export function blend(a: Colour, b: Colour, t: number): Colour {
  const k = Math.max(0, Math.min(1, t));
  return [a[0] + (b[0] - a[0]) * k, a[1] + (b[1] - a[1]) * k, a[2] + (b[2] - a[2]) * k];
}

/** Colour at u, v of a rectangle, both 0 … 1, v up. */
export type Brush = (u: number, v: number) => Colour;

const GUTTER = 3;
const SAMPLES = [1 / 6, 1 / 2, 5 / 6];

export class Atlas {
  /** RGB, rows from the top. */
  readonly pixels: Uint8Array;

  constructor(
    readonly size: number,
    background: Colour,
  ) {
    this.pixels = new Uint8Array(3 * size * size);
    for (let i = 0; i < this.pixels.length; i++) this.pixels[i] = background[i % 3];
  }

  paint([left, top, width, height]: Rect, brush: Brush): void {
    const inside = (x: number) => Math.max(0, Math.min(1, x));
    for (let y = Math.max(0, top - GUTTER); y < Math.min(this.size, top + height + GUTTER); y++) {
      for (let x = Math.max(0, left - GUTTER); x < Math.min(this.size, left + width + GUTTER); x++) {
        const sum = [0, 0, 0];
        for (const dy of SAMPLES) {
          for (const dx of SAMPLES) {
            const c = brush(inside((x + dx - left) / width), inside(1 - (y + dy - top) / height));
            for (let i = 0; i < 3; i++) sum[i] += c[i];
          }
        }
        for (let i = 0; i < 3; i++) {
          this.pixels[3 * (y * this.size + x) + i] = Math.round(Math.max(0, Math.min(255, sum[i] / 9)));
        }
      }
    }
  }
}

/** A texture that is painted when its bytes are first read: it takes most of the time of a character. */
export function painted(name: string, paint: () => Atlas): { readonly name: string; readonly bytes: Uint8Array } {
  let made: Uint8Array | undefined;
  return {
    name,
    get bytes() {
      if (!made) {
        const { pixels, size } = paint();
        made = encodePng(pixels, size);
      }
      return made;
    },
  };
}
