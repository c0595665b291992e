/** The pointer of a drag, with Shift for precision: while held, ten pixels count as one. Switching doesn't jump. */
import type { CanvasPointer } from '../viewport/canvas-tools.ts';

const FINE = 0.1;

export class SteadyHand {
  /** Client coordinates. */
  x: number;
  y: number;
  private lastX: number;
  private lastY: number;

  constructor({ clientX, clientY }: Pick<CanvasPointer, 'clientX' | 'clientY'>) {
    this.x = this.lastX = clientX;
    this.y = this.lastY = clientY;
  }

  move({ clientX, clientY, shiftKey }: Pick<CanvasPointer, 'clientX' | 'clientY' | 'shiftKey'>): void {
    const factor = shiftKey ? FINE : 1;
    this.x += factor * (clientX - this.lastX);
    this.y += factor * (clientY - this.lastY);
    this.lastX = clientX;
    this.lastY = clientY;
  }
}
