/** Where in a picture strips of one height find room: on shelves, from the left, the next one below. */
export class Shelves {
  private x = 0;
  private y = 0;

  /** All in pixels of the picture. */
  constructor(
    readonly width: number,
    readonly height: number,
    readonly shelfHeight: number,
  ) {}

  /** Writes x and y of the corner of a strip to `out`; false where there is no room left, or never was. */
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

  /** All room is free again. */
  clear(): void {
    this.x = 0;
    this.y = 0;
  }
}
