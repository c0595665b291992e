/**
 * Rasterises triangles to a small picture with a depth buffer: half-space tests over each triangle's box (Pineda, "A
 * Parallel Algorithm for Polygon Rasterization", 1988), with light interpolated between vertices.
 */

/** A colour; each component from 0 to 255. */
export interface Rgb {
  readonly r: number;
  readonly g: number;
  readonly b: number;
}

/** Lit triangles in picture space. */
export interface Shaded {
  /** x to the right, y down, in pixels; z towards the viewer, in any unit. Three per vertex. */
  readonly points: Float64Array;
  /** Brightness of each vertex, from 0 to 1. */
  readonly light: Float64Array;
  /** Three vertices each. */
  readonly triangles: ArrayLike<number>;
}

/**
 * Draws triangles into a picture of `width` × `height` pixels.
 * @param dark colour of unlit parts, `bright` of lit ones
 * @returns RGBA, straight alpha: 0 in the background
 */
export function rasterise(
  { points, light, triangles }: Shaded,
  width: number,
  height: number,
  dark: Rgb,
  bright: Rgb,
): Uint8ClampedArray<ArrayBuffer> {
  const pixels = new Uint8ClampedArray(4 * width * height);
  const depth = new Float64Array(width * height).fill(-Infinity);
  for (let t = 0; t + 2 < triangles.length; t += 3) {
    const a = triangles[t];
    const b = triangles[t + 1];
    const c = triangles[t + 2];
    const ax = points[3 * a];
    const ay = points[3 * a + 1];
    const bx = points[3 * b];
    const by = points[3 * b + 1];
    const cx = points[3 * c];
    const cy = points[3 * c + 1];
    const area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
    // Edge-on, or NaN.
    if (!(Math.abs(area) > 1e-9)) continue;
    const left = Math.max(0, Math.floor(Math.min(ax, bx, cx)));
    const right = Math.min(width - 1, Math.ceil(Math.max(ax, bx, cx)));
    const top = Math.max(0, Math.floor(Math.min(ay, by, cy)));
    const bottom = Math.min(height - 1, Math.ceil(Math.max(ay, by, cy)));
    for (let y = top; y <= bottom; y++) {
      const py = y + 0.5;
      for (let x = left; x <= right; x++) {
        const px = x + 0.5;
        const u = ((bx - px) * (cy - py) - (by - py) * (cx - px)) / area;
        const v = ((cx - px) * (ay - py) - (cy - py) * (ax - px)) / area;
        const w = 1 - u - v;
        if (u < 0 || v < 0 || w < 0) continue;
        const z = u * points[3 * a + 2] + v * points[3 * b + 2] + w * points[3 * c + 2];
        const at = y * width + x;
        if (!(z > depth[at])) continue;
        depth[at] = z;
        const l = u * light[a] + v * light[b] + w * light[c];
        pixels[4 * at] = dark.r + l * (bright.r - dark.r);
        pixels[4 * at + 1] = dark.g + l * (bright.g - dark.g);
        pixels[4 * at + 2] = dark.b + l * (bright.b - dark.b);
        pixels[4 * at + 3] = 255;
      }
    }
  }
  return pixels;
}
