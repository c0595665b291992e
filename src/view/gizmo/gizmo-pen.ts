/**
 * How a gizmo looks:
 *
 *     ring       in its axis' colour, the half turned away thin and dashed; the active DOF is orange and thicker, with a
 *                needle at its value
 *     arrow      in the colour of moves along its axis, outside the rings
 *     square     moves in a plane, in the colour of moves along the axis across it
 *     limits     unreachable parts are hairlines; the active DOF has ticks at its limits
 *     dragged    orange, with the arc turned through; at a limit its tick has the warning colour
 */
import { sameHandle } from '../../evaluate/handles/joint-handles.ts';
import type { StageTheme } from '../theme.ts';
import { AWAY, drawKnob, EDGE, EDGE_OPACITY, type GizmoState, LINE, lookOf } from './gizmo-look.ts';
import { RingPen } from './ring-pen.ts';
import type { Layout, Shape } from './shapes.ts';
import { StraightPen } from './straight-pen.ts';

export class GizmoPen {
  private readonly rings: RingPen;
  private readonly straights: StraightPen;
  private theme: StageTheme | undefined;

  constructor(private readonly pen: CanvasRenderingContext2D) {
    this.rings = new RingPen(pen);
    this.straights = new StraightPen(pen);
  }

  setTheme(theme: StageTheme): void {
    this.theme = theme;
  }

  /** @param left, top of the canvas in the viewport @param side of the canvas; all in CSS pixels */
  draw(layout: Layout, state: GizmoState, left: number, top: number, side: number, ratio: number): void {
    const { pen, theme, rings, straights } = this;
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, side, side);
    if (!theme) return;
    pen.translate(-left, -top);
    pen.lineCap = pen.lineJoin = 'round';
    const { dragged } = state;
    // While dragging, only the dragged handle is drawn.
    const shown = layout.shapes.filter(({ id }) => !dragged || sameHandle(id, dragged.id));
    for (const shape of shown) if (shape.form === 'disc') this.disc(layout, shape, state, theme);
    for (const shape of shown) if (shape.form === 'ring') rings.draw(shape, state, theme, true);
    // Behind the near halves of the rings, as picking has it; what comes out in front of them is drawn again.
    for (const shape of shown) if (shape.form === 'square') this.square(shape, state, theme);
    for (const shape of shown) if (isStraight(shape)) straights.draw(shape, state, theme, side);
    for (const shape of shown) if (shape.form === 'ring') rings.draw(shape, state, theme, false);
    for (const shape of shown) if (isStraight(shape) && shape.depths[1] >= 0) straights.drawEnd(shape, state, theme);
    const [x, y] = layout.pivot;
    drawKnob(pen, x, y, 3, theme.selected, theme);
  }

  private disc({ pivot, radius }: Layout, shape: Shape, state: GizmoState, theme: StageTheme): void {
    if (!lookOf(shape, state, theme).isLit) return;
    const { pen } = this;
    pen.globalAlpha = 0.6;
    pen.lineWidth = 1;
    pen.strokeStyle = theme.label;
    pen.beginPath();
    pen.arc(pivot[0], pivot[1], shape.points[0] - pivot[0] || radius, 0, 2 * Math.PI);
    pen.stroke();
    pen.globalAlpha = 1;
  }

  private square(shape: Shape, state: GizmoState, theme: StageTheme): void {
    const { isLit, color } = lookOf(shape, state, theme);
    const { pen } = this;
    const { points } = shape;
    pen.beginPath();
    for (let i = 0; i < 4; i++) pen.lineTo(points[2 * i], points[2 * i + 1]);
    pen.closePath();
    const fade = shape.isAway ? AWAY : 1;
    pen.globalAlpha = fade * (isLit ? 0.6 : 0.3);
    pen.fillStyle = color;
    pen.fill();
    pen.globalAlpha = fade * EDGE_OPACITY;
    pen.lineWidth = LINE + EDGE;
    pen.strokeStyle = theme.labelHalo;
    pen.stroke();
    pen.globalAlpha = fade;
    pen.lineWidth = isLit ? LINE : 1.5;
    pen.strokeStyle = color;
    pen.stroke();
    pen.globalAlpha = 1;
  }
}

function isStraight({ form }: Shape): boolean {
  return form !== 'ring' && form !== 'disc' && form !== 'square';
}
