/** Rings: what of them is behind, what limits leave of them, where the DOF stands and what a drag has swept. */
import type { StageTheme } from '../theme.ts';
import { type DraggedHandle, drawKnob, type GizmoState, lookOf, TICK } from './gizmo-look.ts';
import { hasArc, isAllowed, type Shape } from './shapes.ts';

const FAINT = 0.28;

export class RingPen {
  constructor(private readonly pen: CanvasRenderingContext2D) {}

  /** Its pieces behind, or those in front with all that stands on it. */
  draw(shape: Shape, state: GizmoState, theme: StageTheme, behind: boolean): void {
    const { id, points, isBehind, step, range } = shape;
    const { isActive, isDragged, isLit, color } = lookOf(shape, state, theme);
    const width = isLit || isActive ? 3 : 1.75;
    const limited = hasArc(range);
    const inReach = (i: number) => !limited || isAllowed(range, (i + 0.5) * step);
    if (!behind) {
      if (isDragged && id.kind === 'dof') this.swept(shape, state.dragged, theme);
      // A dark line beside a light one: over any skin it can be told.
      this.pieces(points, (i) => !isBehind[i] && inReach(i), width + 2, theme.labelHalo, 0.45);
    }
    const alpha = behind ? FAINT : id.kind === 'view' && !isLit ? 0.6 : 1;
    const own = (i: number) => isBehind[i] === behind;
    this.pieces(points, (i) => own(i) && inReach(i), behind ? 1.25 : width, color, alpha);
    // Out of reach: every other piece, which reads as dashes.
    if (limited) this.pieces(points, (i) => own(i) && !inReach(i) && i % 2 === 0, 1.5, color, behind ? 0.2 : 0.4);
    if (behind || id.kind !== 'dof' || !(isActive || isLit)) return;
    if (limited) {
      this.tick(shape, range.min - range.value, state.dragged?.stop === 'min' && isDragged, color, theme);
      this.tick(shape, range.max - range.value, state.dragged?.stop === 'max' && isDragged, color, theme);
    }
    this.needle(shape, color, theme);
  }

  private pieces(
    points: Float64Array,
    is: (piece: number) => boolean,
    width: number,
    color: string,
    alpha: number,
  ): void {
    const { pen } = this;
    pen.strokeStyle = color;
    pen.lineWidth = width;
    pen.globalAlpha = alpha;
    pen.beginPath();
    let isDown = false;
    for (let i = 0; i < points.length / 2 - 1; i++) {
      if (!is(i)) {
        isDown = false;
        continue;
      }
      if (!isDown) pen.moveTo(points[2 * i], points[2 * i + 1]);
      pen.lineTo(points[2 * i + 2], points[2 * i + 3]);
      isDown = true;
    }
    pen.stroke();
    pen.globalAlpha = 1;
  }

  /** From where the DOF was at the press to where it stands. */
  private swept(shape: Shape, dragged: DraggedHandle | undefined, theme: StageTheme): void {
    const { pen } = this;
    if (!dragged) return;
    const back = Math.max(-2 * Math.PI, Math.min(2 * Math.PI, dragged.from - shape.range.value));
    if (Math.abs(back) < 1e-6) return;
    const steps = Math.max(2, Math.ceil(Math.abs(back) / shape.step));
    const middle = centreOf(shape);
    pen.beginPath();
    pen.moveTo(...middle);
    for (let i = 0; i <= steps; i++) pen.lineTo(...placeOn(shape, (back * i) / steps));
    pen.closePath();
    pen.globalAlpha = 0.22;
    pen.fillStyle = theme.selected;
    pen.fill();
    pen.globalAlpha = 0.6;
    pen.lineWidth = 1;
    pen.strokeStyle = theme.selected;
    pen.beginPath();
    pen.moveTo(...middle);
    pen.lineTo(...placeOn(shape, back));
    pen.stroke();
    pen.globalAlpha = 1;
  }

  /** Across the ring, where a limit is. */
  private tick(shape: Shape, angle: number, isStop: boolean, color: string, theme: StageTheme): void {
    const [x, y] = placeOn(shape, angle);
    const [cx, cy] = centreOf(shape);
    const length = Math.hypot(x - cx, y - cy) || 1;
    const [dx, dy] = [(x - cx) / length, (y - cy) / length];
    const size = isStop ? TICK + 3 : TICK;
    const { pen } = this;
    for (const [width, stroke] of [
      [isStop ? 6 : 4, theme.labelHalo],
      [isStop ? 4 : 2, isStop ? theme.ghostAfter : color],
    ] as const) {
      pen.lineWidth = width;
      pen.strokeStyle = stroke;
      pen.beginPath();
      pen.moveTo(x - size * dx, y - size * dy);
      pen.lineTo(x + size * dx, y + size * dy);
      pen.stroke();
    }
  }

  /** From the middle to where the DOF stands, along the bone. */
  private needle(shape: Shape, color: string, theme: StageTheme): void {
    const { pen } = this;
    const [x, y] = placeOn(shape, 0);
    pen.lineWidth = 1;
    pen.strokeStyle = color;
    pen.globalAlpha = 0.7;
    pen.beginPath();
    pen.moveTo(...centreOf(shape));
    pen.lineTo(x, y);
    pen.stroke();
    pen.globalAlpha = 1;
    drawKnob(pen, x, y, 4, color, theme);
  }
}

/** Of a ring on the screen: the middle of two points that lie opposite. */
function centreOf({ points }: Shape): [number, number] {
  const half = (points.length / 2 - 1) / 2;
  return [(points[0] + points[2 * half]) / 2, (points[1] + points[2 * half + 1]) / 2];
}

/** A place on a ring, an angle from its mark on. */
function placeOn({ points, step }: Shape, angle: number): [number, number] {
  const count = points.length / 2 - 1;
  const at = (((angle / step) % count) + count) % count;
  const i = Math.floor(at);
  const t = at - i;
  return [
    points[2 * i] + t * (points[2 * i + 2] - points[2 * i]),
    points[2 * i + 1] + t * (points[2 * i + 3] - points[2 * i + 1]),
  ];
}
