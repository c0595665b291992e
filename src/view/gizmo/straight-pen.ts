/** Draws arrows and boxes, with the limits of their range. */
import type { StageTheme } from '../theme.ts';
import {
  AWAY,
  type DraggedHandle,
  EDGE,
  EDGE_OPACITY,
  type GizmoState,
  LINE,
  LINE_IN_USE,
  lookOf,
  TICK,
} from './gizmo-look.ts';
import { RINGS_END, type Shape } from './shapes.ts';

/** CSS pixels. */
const HEAD = 6;

export class StraightPen {
  constructor(private readonly pen: CanvasRenderingContext2D) {}

  /** @param side of the canvas in CSS pixels */
  draw(shape: Shape, state: GizmoState, theme: StageTheme, side: number): void {
    const { isActive, isLit, color } = lookOf(shape, state, theme);
    this.pen.globalAlpha = shape.isAway ? AWAY : 1;
    if (isActive || isLit) this.rail(shape, state.dragged, color, theme, side);
    this.line(shape, state, theme, 0);
  }

  /** The part beyond the rings. */
  drawEnd(shape: Shape, state: GizmoState, theme: StageTheme): void {
    if (!shape.isAway) this.line(shape, state, theme, RINGS_END);
  }

  /** @param from where the line begins, as a part of its length */
  private line(shape: Shape, state: GizmoState, theme: StageTheme, from: number): void {
    const { points, form, isAway } = shape;
    const { isActive, isLit, color } = lookOf(shape, state, theme);
    const { pen } = this;
    const [bx, by] = [points[2], points[3]];
    const [ax, ay] = [points[0] + from * (bx - points[0]), points[1] + from * (by - points[1])];
    pen.globalAlpha = isAway ? AWAY : 1;
    const own = isLit || isActive ? LINE_IN_USE : LINE;
    for (const [width, stroke, opacity] of [
      [own + EDGE, theme.labelHalo, EDGE_OPACITY],
      [own, color, 1],
    ] as const) {
      pen.globalAlpha = (isAway ? AWAY : 1) * opacity;
      pen.lineWidth = width;
      pen.strokeStyle = stroke;
      pen.beginPath();
      pen.moveTo(ax, ay);
      pen.lineTo(bx, by);
      pen.stroke();
    }
    pen.save();
    pen.translate(bx, by);
    pen.rotate(form === 'diamond' ? Math.PI / 4 : Math.atan2(by - ay, bx - ax));
    pen.beginPath();
    if (form === 'arrow') {
      pen.moveTo(HEAD + 4, 0);
      pen.lineTo(-HEAD, HEAD - 0.5);
      pen.lineTo(-HEAD, 0.5 - HEAD);
      pen.closePath();
    } else pen.rect(-HEAD + 1, -HEAD + 1, 2 * HEAD - 2, 2 * HEAD - 2);
    pen.lineWidth = 2;
    pen.strokeStyle = theme.labelHalo;
    pen.stroke();
    pen.fillStyle = color;
    pen.fill();
    pen.restore();
    pen.globalAlpha = 1;
  }

  /** The range of a limited length along its arrow: dashed, with a tick at each end that is near. */
  private rail(
    { points, range, step, form }: Shape,
    dragged: DraggedHandle | undefined,
    color: string,
    theme: StageTheme,
    side: number,
  ): void {
    if (form !== 'arrow' || !(Number.isFinite(range.min) && Number.isFinite(range.max))) return;
    const [ax, ay, bx, by] = points;
    const { pen } = this;
    const length = Math.hypot(bx - ax, by - ay) || 1;
    const most = (0.48 * side) / length;
    const [nx, ny] = [-(by - ay) / length, (bx - ax) / length];
    const at = (value: number): readonly [number, boolean] => {
      const part = (value - range.value) / step;
      return [Math.max(-most, Math.min(most, part)), Math.abs(part) <= most];
    };
    const ends = [at(range.min), at(range.max)] as const;
    pen.save();
    pen.setLineDash([3, 4]);
    pen.lineWidth = 1.5;
    pen.strokeStyle = color;
    pen.beginPath();
    pen.moveTo(ax + ends[0][0] * (bx - ax), ay + ends[0][0] * (by - ay));
    pen.lineTo(ax + ends[1][0] * (bx - ax), ay + ends[1][0] * (by - ay));
    pen.stroke();
    pen.restore();
    ends.forEach(([part, isNear], i) => {
      if (!isNear) return;
      const isStop = dragged?.stop === (i === 0 ? 'min' : 'max');
      const [x, y] = [ax + part * (bx - ax), ay + part * (by - ay)];
      pen.lineWidth = isStop ? 4 : 2;
      pen.strokeStyle = isStop ? theme.ghostAfter : color;
      pen.beginPath();
      pen.moveTo(x - TICK * nx, y - TICK * ny);
      pen.lineTo(x + TICK * nx, y + TICK * ny);
      pen.stroke();
    });
  }
}
