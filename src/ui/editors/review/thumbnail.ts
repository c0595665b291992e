/** A take's stick figure in a row: it moves under the pointer, and plays in the row with the keyboard focus. */
import type { StickFigure } from '../../../review/stick-figure.ts';
import { element } from '../../widgets/dom.ts';
import { oncePerFrame } from '../../widgets/frame.ts';

/** CSS pixels. */
const WIDTH = 40;
const HEIGHT = 26;
const MARGIN = 1;
const FRAMES_PER_SECOND = 12;

export class Thumbnail {
  readonly element = element('canvas', { class: 'review-thumb', 'aria-hidden': 'true' });
  private figure: StickFigure | undefined;
  private frame = 0;
  private plays = false;
  private startMs: number | undefined;
  private readonly drawSoon = oncePerFrame((nowMs) => this.draw(nowMs), 'draw');

  constructor() {
    this.element.addEventListener('pointermove', (event) => {
      const { left, width } = this.element.getBoundingClientRect();
      const part = (event.clientX - left) / Math.max(1, width);
      this.go(part);
    });
    this.element.addEventListener('pointerleave', () => this.go(0));
  }

  show(figure: StickFigure | undefined, plays: boolean): void {
    if (figure !== this.figure) {
      this.figure = figure;
      this.frame = 0;
      this.startMs = undefined;
    }
    this.plays = plays;
    this.drawSoon();
  }

  /** @param part of the take, 0 to 1 */
  private go(part: number): void {
    const { figure } = this;
    if (!figure) return;
    this.frame = Math.max(0, Math.min(figure.frameCount - 1, Math.floor(part * figure.frameCount)));
    this.drawSoon();
  }

  private draw(nowMs: number): void {
    const { element: canvas, figure } = this;
    if (!canvas.isConnected) return;
    const ratio = window.devicePixelRatio || 1;
    const [width, height] = [Math.round(WIDTH * ratio), Math.round(HEIGHT * ratio)];
    if (canvas.width !== width) [canvas.width, canvas.height] = [width, height];
    const context = canvas.getContext('2d');
    if (!context) return;
    context.clearRect(0, 0, width, height);
    if (!figure) return;
    if (this.plays) {
      this.startMs ??= nowMs;
      this.frame = Math.floor(((nowMs - this.startMs) / 1000) * FRAMES_PER_SECOND) % figure.frameCount;
      this.drawSoon();
    }
    const { pointCount, above, points } = figure;
    const size = HEIGHT - 2 * MARGIN;
    const scale = (size * ratio) / 255;
    const first = 2 * this.frame * pointCount;
    const x = (i: number) => ((WIDTH - size) / 2) * ratio + scale * points[first + 2 * i];
    const y = (i: number) => MARGIN * ratio + scale * points[first + 2 * i + 1];
    context.strokeStyle = getComputedStyle(canvas).color;
    context.lineWidth = 1.25 * ratio;
    context.lineCap = 'round';
    context.beginPath();
    for (let i = 0; i < pointCount; i++) {
      if (above[i] === i) continue;
      context.moveTo(x(above[i]), y(above[i]));
      context.lineTo(x(i), y(i));
    }
    context.stroke();
  }
}
