/**
 * Key diamonds, drawn once per size and state and then copied: a full sheet has thousands, and copying costs half as
 * much as filling paths. Aligned to device pixels, so that all look alike.
 */
import { PLAIN, SELECTED } from '../../../edit/keys/marks.ts';

export interface DiamondColours {
  readonly key: string;
  readonly selected: string;
  /** Outline, so that overlapping diamonds can be told apart. */
  readonly rim: string;
}

/** Half the diagonal, CSS pixels. */
const DIAMOND_SIZES = { summary: 5.5, group: 4.5, channel: 3.5 } as const;
export type DiamondSize = keyof typeof DIAMOND_SIZES;

/** Margin for the outline. */
const MARGIN = 1.5;

export class Diamonds {
  private readonly sprites = new Map<string, HTMLCanvasElement>();

  constructor(
    private readonly colours: DiamondColours,
    private readonly ratio: number,
  ) {}

  /** @param mark PLAIN, SELECTED, or both: half of each */
  draw(g: CanvasRenderingContext2D, x: number, y: number, size: DiamondSize, mark: number): void {
    const sprite = this.sprite(size, mark);
    const extent = sprite.width / this.ratio;
    const left = Math.round((x - extent / 2) * this.ratio) / this.ratio;
    const top = Math.round((y - extent / 2) * this.ratio) / this.ratio;
    g.drawImage(sprite, left, top, extent, extent);
  }

  private sprite(size: DiamondSize, mark: number): HTMLCanvasElement {
    const name = `${size}${mark}`;
    const known = this.sprites.get(name);
    if (known) return known;
    const made = document.createElement('canvas');
    const half = DIAMOND_SIZES[size];
    const pixels = 2 * Math.ceil((half + MARGIN) * this.ratio);
    made.width = pixels;
    made.height = pixels;
    this.sprites.set(name, made);
    const g = made.getContext('2d');
    if (!g) return made;
    g.translate(pixels / 2, pixels / 2);
    g.scale(this.ratio, this.ratio);
    diamond(g, half);
    g.strokeStyle = this.colours.rim;
    g.lineWidth = 2;
    g.lineJoin = 'round';
    g.stroke();
    g.fillStyle = mark === SELECTED ? this.colours.selected : this.colours.key;
    g.fill();
    if (mark === (PLAIN | SELECTED)) {
      g.beginPath();
      g.moveTo(0, -half);
      g.lineTo(0, half);
      g.lineTo(-half, 0);
      g.closePath();
      g.fillStyle = this.colours.selected;
      g.fill();
    }
    return made;
  }
}

function diamond(g: CanvasRenderingContext2D, half: number): void {
  g.beginPath();
  g.moveTo(0, -half);
  g.lineTo(half, 0);
  g.lineTo(0, half);
  g.lineTo(-half, 0);
  g.closePath();
}
