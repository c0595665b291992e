/**
 * Names as sprites. Drawing a text with a halo takes as long as copying ten: so each name is drawn once per colour on
 * an offscreen canvas, and copied from there each frame, pixel for pixel. All are copied at the end of the frame: a
 * canvas that is drawn to between two copies is itself copied for each.
 */
import { Shelves } from './shelves.ts';

const FONT = '500 11px system-ui, -apple-system, "Segoe UI", sans-serif';
/** CSS pixels of a strip: a line of text with its halo. */
const STRIP_HEIGHT = 20;
/** Margin around the text, for its halo. */
const MARGIN = 4;
const HALO_WIDTH = 3;
/** CSS pixels. Larger than a frame's names, unless they are long; then the oldest are dropped. */
const PICTURE_WIDTH = 1024;
const PICTURE_HEIGHT = 512;
/** Numbers per waiting copy: x, y and width there, x and y here, opacity; and as many as wait at most. */
const STRIDE = 6;
const MAX_WAITING = 128;

/** A text, and its sprite per colour. */
export interface Name {
  readonly text: string;
  /** CSS pixels. */
  readonly width: number;
  readonly sprites: Sprite[];
}

interface Sprite {
  readonly color: string;
  /** Generation of the atlas that it is in: clearing the atlas invalidates its sprites. */
  generation: number;
  /** Device pixels. */
  x: number;
  y: number;
}

export class NameSprites {
  private readonly canvas = document.createElement('canvas');
  private readonly pen: CanvasRenderingContext2D;
  private readonly known = new Map<string, Name>();
  private readonly corner = new Float64Array(2);
  private shelves = new Shelves(0, 0, 1);
  private generation = 0;
  private ratio = 1;
  private halo = '';
  private readonly waiting = new Float64Array(STRIDE * MAX_WAITING);
  private waitingCount = 0;

  /** @param target in device pixels */
  constructor(private readonly target: CanvasRenderingContext2D) {
    const pen = this.canvas.getContext('2d');
    if (!pen) throw new Error('This browser does not provide a 2D canvas.');
    this.pen = pen;
    this.setRatio(1);
  }

  /** Device pixels per CSS pixel. */
  setRatio(ratio: number): void {
    this.ratio = ratio;
    this.canvas.width = Math.round(PICTURE_WIDTH * ratio);
    this.canvas.height = Math.round(PICTURE_HEIGHT * ratio);
    this.shelves = new Shelves(this.canvas.width, this.canvas.height, Math.ceil(STRIP_HEIGHT * ratio));
    this.clear();
  }

  setHalo(color: string): void {
    this.halo = color;
    this.clear();
  }

  /** The name of this text; the same object for the same text. */
  name(text: string): Name {
    let name = this.known.get(text);
    if (!name) {
      name = { text, width: this.pen.measureText(text).width, sprites: [] };
      if (this.known.size > 20000) this.known.clear();
      this.known.set(text, name);
    }
    return name;
  }

  /**
   * Draws a name, with the next `flush`.
   *
   * @param left of the first letter, CSS pixels
   * @param middle of the line, CSS pixels
   */
  draw(name: Name, color: string, left: number, middle: number, opacity: number): void {
    const { ratio, waiting } = this;
    const width = this.widthOf(name);
    const sprite = this.spriteOf(name, color, width);
    if (!sprite) return;
    if (this.waitingCount === MAX_WAITING) this.flush();
    const o = STRIDE * this.waitingCount++;
    waiting[o] = sprite.x;
    waiting[o + 1] = sprite.y;
    waiting[o + 2] = width;
    // Aligned to device pixels, or it would be blurred.
    waiting[o + 3] = Math.round((left - MARGIN) * ratio);
    waiting[o + 4] = Math.round((middle - STRIP_HEIGHT / 2) * ratio);
    waiting[o + 5] = opacity;
  }

  /** Call at the end of each frame: copies what was drawn to the target. */
  flush(): void {
    const { canvas, target, waiting, shelves } = this;
    const height = shelves.shelfHeight;
    for (let o = 0; o < STRIDE * this.waitingCount; o += STRIDE) {
      const width = waiting[o + 2];
      target.globalAlpha = waiting[o + 5];
      target.drawImage(
        canvas,
        waiting[o],
        waiting[o + 1],
        width,
        height,
        waiting[o + 3],
        waiting[o + 4],
        width,
        height,
      );
    }
    target.globalAlpha = 1;
    this.waitingCount = 0;
  }

  private widthOf({ width }: Name): number {
    return Math.min(this.shelves.width, Math.ceil((width + 2 * MARGIN) * this.ratio));
  }

  private spriteOf(name: Name, color: string, width: number): Sprite | undefined {
    const { sprites } = name;
    let sprite: Sprite | undefined;
    for (let s = 0; s < sprites.length; s++) if (sprites[s].color === color) sprite = sprites[s];
    if (sprite?.generation === this.generation) return sprite;
    const { corner, shelves } = this;
    if (!shelves.place(width, corner)) {
      this.flush();
      this.clear();
      if (!shelves.place(width, corner)) return undefined;
    }
    if (!sprite) {
      sprite = { color, generation: 0, x: 0, y: 0 };
      sprites.push(sprite);
    }
    sprite.generation = this.generation;
    [sprite.x, sprite.y] = corner;
    this.write(name.text, sprite);
    return sprite;
  }

  private write(text: string, { color, x, y }: Sprite): void {
    const { pen, ratio } = this;
    pen.setTransform(ratio, 0, 0, ratio, x, y);
    pen.strokeStyle = this.halo;
    pen.strokeText(text, MARGIN, STRIP_HEIGHT / 2);
    pen.fillStyle = color;
    pen.fillText(text, MARGIN, STRIP_HEIGHT / 2);
  }

  /** Clears the atlas; what was copied from it stays. */
  private clear(): void {
    const { pen, canvas } = this;
    this.generation++;
    this.shelves.clear();
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.clearRect(0, 0, canvas.width, canvas.height);
    // Resizing a canvas resets these.
    pen.font = FONT;
    pen.textBaseline = 'middle';
    pen.lineJoin = 'round';
    pen.lineWidth = HALO_WIDTH;
  }
}
