/**
 * One texture of floats for many owners, each with a block of it: three.js uploads it once a frame, however many have
 * written to it. Blocks keep their place for good; the texture grows by doubling.
 */
import { DataTexture, FloatType, RGBAFormat } from 'three';

/** Texels of a row: 2 to this power, so that shaders find a texel without dividing. */
export const ROW_BITS = 8;
const WIDTH = 1 << ROW_BITS;
/** Texels of a matrix: see `writeMatrices`. */
export const MATRIX_TEXELS = 3;

/** Texels that nobody owns. */
interface Gap {
  start: number;
  length: number;
}

export class FloatBlocks {
  readonly texture: DataTexture;
  private floats = new Float32Array(4 * WIDTH);
  /** Ascending, none next to another. */
  private readonly gaps: Gap[] = [{ start: 0, length: WIDTH }];

  constructor() {
    this.texture = new DataTexture(this.floats, WIDTH, 1, RGBAFormat, FloatType);
  }

  /** Returns the first of so many texels, four floats each; what they hold is undefined. */
  allocate(texels: number): number {
    let gap = this.gaps.find(({ length }) => length >= texels);
    while (!gap) {
      this.grow();
      const last = this.gaps[this.gaps.length - 1];
      if (last.length >= texels) gap = last;
    }
    const { start } = gap;
    gap.start += texels;
    gap.length -= texels;
    if (gap.length === 0) this.gaps.splice(this.gaps.indexOf(gap), 1);
    return start;
  }

  /** Gives back what `allocate` returned. */
  release(start: number, texels: number): void {
    const { gaps } = this;
    const found = gaps.findIndex((gap) => gap.start > start);
    const at = found < 0 ? gaps.length : found;
    gaps.splice(at, 0, { start, length: texels });
    for (let i = Math.min(at + 1, gaps.length - 1); i > Math.max(0, at - 1); i--) {
      const before = gaps[i - 1];
      if (before.start + before.length !== gaps[i].start) continue;
      before.length += gaps[i].length;
      gaps.splice(i, 1);
    }
  }

  /** Writes floats from the beginning of a texel on; uploaded with the next draw. */
  write(texel: number, values: ArrayLike<number>): void {
    this.floats.set(values, 4 * texel);
    this.texture.needsUpdate = true;
  }

  /**
   * Writes affine matrices by their rows, three texels each: a quarter less to upload, and for vertices to read.
   *
   * @param matrices 16 numbers each, column-major
   */
  writeMatrices(texel: number, matrices: ArrayLike<number>): void {
    const { floats } = this;
    let o = 4 * texel;
    for (let m = 0; m < matrices.length; m += 16) {
      for (let r = m; r < m + 3; r++) {
        floats[o++] = matrices[r];
        floats[o++] = matrices[r + 4];
        floats[o++] = matrices[r + 8];
        floats[o++] = matrices[r + 12];
      }
    }
    this.texture.needsUpdate = true;
  }

  /** Frees the texture on the GPU; drawn again, it is uploaded again. */
  dispose(): void {
    this.texture.dispose();
  }

  private grow(): void {
    const before = this.floats;
    this.floats = new Float32Array(2 * before.length);
    this.floats.set(before);
    const { texture } = this;
    // Its storage on the GPU has the old size.
    texture.dispose();
    texture.image = { data: this.floats, width: WIDTH, height: this.floats.length / 4 / WIDTH };
    texture.needsUpdate = true;
    const added = before.length / 4;
    const last = this.gaps.at(-1);
    if (last && last.start + last.length === added) last.length += added;
    else this.gaps.push({ start: added, length: added });
  }
}
