/**
 * Two canvases over each other: below, what edits and navigation change; above, what moves with the time and the
 * pointer, so that playback redraws little. The stylesheet's colours are read once for each theme.
 */
import { beginPicture } from '../../widgets/canvas.ts';
import { element } from '../../widgets/dom.ts';

export class TimePicture<Colours> {
  readonly element: HTMLElement = element('div', { class: 'time-picture', 'aria-hidden': 'true' });
  private readonly lower = element('canvas');
  private readonly upper = element('canvas');
  private read: Colours | undefined;

  /** @param readColours of the stylesheet, for an element */
  constructor(private readonly readColours: (target: Element) => Colours) {
    this.element.append(this.lower, this.upper);
  }

  get colours(): Colours {
    this.read ??= this.readColours(this.element);
    return this.read;
  }

  /** The theme has changed: rereads the colours on the next drawing. */
  recolour(): void {
    this.read = undefined;
  }

  /** Clears the lower canvas to draw on. CSS pixels. */
  below(width: number, height: number): CanvasRenderingContext2D | null {
    return beginPicture(this.lower, width, height);
  }

  /** Clears the upper canvas to draw on. CSS pixels. */
  above(width: number, height: number): CanvasRenderingContext2D | null {
    return beginPicture(this.upper, width, height);
  }
}
