/** Packs strips of one height into an image: shelf by shelf, from the left. */
export class Shelves {
  private x = 0;
  private y = 0;

  /** Pixels of the image. */
  constructor(
    readonly width: number,
    readonly height: number,
    readonly shelfHeight: number,
  ) {}

  /** Writes x and y of a strip's corner to `out`; false if it doesn't fit. */
  place(width: number, out: Float64Array): boolean {
    if (width > this.width) return false;
    const fits = this.x + width <= this.width;
    const x = fits ? this.x : 0;
    const y = fits ? this.y : this.y + this.shelfHeight;
    if (y + this.shelfHeight > this.height) return false;
    out[0] = x;
    out[1] = y;
    this.x = x + width;
    this.y = y;
    return true;
  }

  /** Frees all space. */
  clear(): void {
    this.x = 0;
    this.y = 0;
  }
}
