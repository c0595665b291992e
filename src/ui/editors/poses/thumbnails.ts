/**
 * Thumbnails of poses, drawn when they come into view, one at a time between frames, and cached by identity of the
 * pose's values, skeleton, skin and theme.
 */
import type { Steps } from '../../../evaluate/steps.ts';
import type { Character } from '../../../model/document.ts';
import type { NamedPose } from '../../../model/poses.ts';
import { drawPose, type ThumbnailColours } from '../../../view/pose-thumbnail.ts';
import { inSlices } from '../../widgets/in-slices.ts';

interface Kept {
  readonly of: readonly unknown[];
  readonly canvas: HTMLCanvasElement;
}

interface Wanted {
  readonly canvas: HTMLCanvasElement;
  readonly character: Character;
  readonly pose: NamedPose;
}

export class Thumbnails {
  private readonly kept = new WeakMap<readonly number[], Kept>();
  /** What each canvas shows, since every change of the document asks. */
  private readonly shown = new WeakMap<HTMLCanvasElement, Kept>();
  private readonly wanted = new Map<HTMLCanvasElement, Wanted>();
  private isDrawing = false;
  private colours: ThumbnailColours | undefined;

  /** @param around element whose colours they use */
  constructor(private readonly around: HTMLElement) {}

  /** The theme has changed: rereads the colours, and redraws thumbnails on request. */
  recolour(): void {
    this.colours = undefined;
  }

  /** Draws the pose's thumbnail, at once if cached. */
  show(canvas: HTMLCanvasElement, character: Character, pose: NamedPose): void {
    const known = this.kept.get(pose.values);
    if (known && same(known.of, this.keyOf(character, canvas))) {
      this.wanted.delete(canvas);
      if (this.shown.get(canvas) !== known) copy(known.canvas, canvas);
      this.shown.set(canvas, known);
      return;
    }
    this.wanted.set(canvas, { canvas, character, pose });
    if (this.isDrawing) return;
    this.isDrawing = true;
    // Postponed: while scrolling fast, none of them is looked at.
    requestAnimationFrame(() => this.drawAll());
  }

  forget(canvas: HTMLCanvasElement): void {
    this.wanted.delete(canvas);
  }

  private drawAll(): void {
    const end = () => {
      this.isDrawing = false;
    };
    inSlices(this.steps(), { isOver: () => false, progress: () => undefined, done: end, failed: end });
  }

  private *steps(): Steps<void> {
    for (let next = this.take(); next; next = this.take()) {
      const { canvas, character, pose } = next;
      if (canvas.isConnected) {
        drawPose(canvas, character, pose.values, this.theirColours());
        const own = document.createElement('canvas');
        own.width = canvas.width;
        own.height = canvas.height;
        copy(canvas, own);
        const kept = { of: this.keyOf(character, canvas), canvas: own };
        this.kept.set(pose.values, kept);
        this.shown.set(canvas, kept);
      }
      yield 0;
    }
  }

  private take(): Wanted | undefined {
    for (const [canvas, wanted] of this.wanted) {
      this.wanted.delete(canvas);
      return wanted;
    }
    return undefined;
  }

  private keyOf({ skeleton, skins, shownSkin, morphs, space, clampsToLimits }: Character, canvas: HTMLCanvasElement) {
    return [skeleton, skins[shownSkin], morphs, space?.up, clampsToLimits, this.theirColours(), canvas.width];
  }

  private theirColours(): ThumbnailColours {
    const style = getComputedStyle(this.around);
    this.colours ??= {
      dark: rgb(style.getPropertyValue('--pose-dark')),
      bright: rgb(style.getPropertyValue('--pose-bright')),
    };
    return this.colours;
  }
}

function same(a: readonly unknown[], b: readonly unknown[]): boolean {
  return a.every((v, i) => v === b[i]);
}

function copy(from: HTMLCanvasElement, to: HTMLCanvasElement): void {
  const g = to.getContext('2d');
  g?.clearRect(0, 0, to.width, to.height);
  g?.drawImage(from, 0, 0);
}

/** `#rrggbb`. */
function rgb(colour: string) {
  const value = Number.parseInt(colour.trim().slice(1), 16) || 0;
  return { r: value >> 16, g: (value >> 8) & 255, b: value & 255 };
}
