/** Draws rings: far half, limits, the DOF's value, the swept sector. */
import type { StageTheme } from '../theme.ts';
import {
  type DraggedHandle,
  drawKnob,
  EDGE,
  EDGE_OPACITY,
  type GizmoState,
  LINE,
  LINE_IN_USE,
  lookOf,
  TICK,
} from './gizmo-look.ts';
import { hasArc, isAllowed, type Shape } from './shapes.ts';

/** The half that is turned away: a thin dashed line, which is over the body like all of the gizmo. */
const FAR = { width: 1.25, dash: [2, 4], opacity: 0.75 } as const;

/** Width of the arc that was turned through, CSS pixels. */
const SWEPT = 11;

export class RingPen {
  constructor(private readonly pen: CanvasRenderingContext2D) {}

  /** Draws the far pieces, or the near ones with everything on them. */
  draw(shape: Shape, state: GizmoState, theme: StageTheme, behind: boolean): void {
    const { id, points, isBehind, step, range } = shape;
    const { isActive, isDragged, isLit, color } = lookOf(shape, state, theme);
    const width = isLit || isActive ? LINE_IN_USE : LINE;
    const limited = hasArc(range);
    const inReach = (i: number) => !limited || isAllowed(range, (i + 0.5) * step);
    if (!behind) {
      if (isDragged && id.kind === 'dof') this.swept(shape, state.dragged, theme);
      // A dark line beside a light one is visible on any skin.
      this.pieces(points, (i) => !isBehind[i] && inReach(i), width + EDGE, theme.labelHalo, EDGE_OPACITY);
    }
    const alpha = behind ? FAR.opacity : id.kind === 'view' && !isLit ? 0.6 : 1;
    const dash = behind ? FAR.dash : [];
    const own = (i: number) => isBehind[i] === behind;
    this.pieces(points, (i) => own(i) && inReach(i), behind ? FAR.width : width, color, alpha, dash);
    // Beyond the limits a hairline: dashes between short arcs can't be told from another ring behind them.
    if (limited) this.pieces(points, (i) => own(i) && !inReach(i), 1, color, behind ? 0.35 : 0.5, dash);
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
    dash: readonly number[] = [],
  ): void {
    const { pen } = this;
    pen.setLineDash([...dash]);
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
    pen.setLineDash([]);
    pen.globalAlpha = 1;
  }

  /** The arc from the DOF's value at the press to the current one, and a line to where it began. */
  private swept(shape: Shape, dragged: DraggedHandle | undefined, theme: StageTheme): void {
    const { pen } = this;
    if (!dragged) return;
    const back = Math.max(-2 * Math.PI, Math.min(2 * Math.PI, dragged.from - shape.range.value));
    if (Math.abs(back) < 1e-6) return;
    const steps = Math.max(2, Math.ceil(Math.abs(back) / shape.step));
    pen.strokeStyle = theme.selected;
    // Broad and pale around the ring's own line: a filled sector would cover what is being turned.
    pen.beginPath();
    for (let i = 0; i <= steps; i++) pen.lineTo(...placeOn(shape, (back * i) / steps));
    pen.globalAlpha = 0.35;
    pen.lineWidth = SWEPT;
    pen.lineCap = 'butt';
    pen.stroke();
    pen.lineCap = 'round';
    pen.globalAlpha = 0.6;
    pen.lineWidth = 1;
    pen.beginPath();
    pen.moveTo(...centreOf(shape));
    pen.lineTo(...placeOn(shape, back));
    pen.stroke();
    pen.globalAlpha = 1;
  }

  /** A tick across the ring at a limit. */
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

  /** From the centre to the DOF's value, along the bone. */
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

/** Centre of a ring on screen: the middle of two opposite points. */
function centreOf({ points }: Shape): [number, number] {
  const half = (points.length / 2 - 1) / 2;
  return [(points[0] + points[2 * half]) / 2, (points[1] + points[2 * half + 1]) / 2];
}

/** The point of a ring at an angle from its mark. */
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
