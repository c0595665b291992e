/**
 * How a gizmo looks:
 *
 *     ring       in its axis' colour, the far half faint; the DOF in hand is thicker, and has a needle to where it stands
 *     limits     what can't be reached is dashed and faint; the ends of the range are ticks on the DOF in hand
 *     dragged    orange, with what was swept since the press filled in; at a limit its tick is the warning's colour
 */
import type { StageTheme } from '../theme.ts';
import { type HandleId, sameHandle } from './handles.ts';
import { hasArc, isAllowed, type Layout, type Shape } from './shapes.ts';

export interface GizmoState {
  /** The DOF that dragging the bone turns. */
  readonly active: HandleId | undefined;
  readonly hovered: HandleId | undefined;
  readonly dragged: DraggedHandle | undefined;
}

export interface DraggedHandle {
  readonly id: HandleId;
  /** The DOF's value at the press. */
  readonly from: number;
  /** Which of its limits stops it. */
  readonly stop: 'min' | 'max' | undefined;
}

const FAINT = 0.28;
const AWAY = 0.2;
/** CSS pixels. */
const TICK = 7;
const HEAD = 6;

export class GizmoPen {
  private theme: StageTheme | undefined;

  /** @param side of the canvas in CSS pixels */
  constructor(
    private readonly pen: CanvasRenderingContext2D,
    private readonly side: number,
  ) {}

  setTheme(theme: StageTheme): void {
    this.theme = theme;
  }

  /** @param left, top of the canvas in the viewport */
  draw(layout: Layout, state: GizmoState, left: number, top: number, ratio: number): void {
    const { pen, side } = this;
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, side, side);
    if (!this.theme) return;
    pen.translate(-left, -top);
    pen.lineCap = pen.lineJoin = 'round';
    const { dragged } = state;
    // What is dragged is alone with the DOF in hand: nothing else is in the way of what is looked at.
    const shown = layout.shapes.filter(({ id }) => !dragged || sameHandle(id, dragged.id));
    for (const shape of shown) if (shape.form === 'disc') this.disc(layout, shape, state);
    for (const shape of shown) if (shape.form === 'ring') this.ring(shape, state, true);
    for (const shape of shown) {
      if (shape.form === 'ring') this.ring(shape, state, false);
      else if (shape.form !== 'disc') this.straight(shape, state);
    }
    this.dot(layout);
  }

  private disc({ pivot, radius }: Layout, { id, points }: Shape, { hovered, dragged }: GizmoState): void {
    const isLit = sameHandle(id, hovered) || sameHandle(id, dragged?.id);
    const { pen, theme } = this;
    if (!theme || !isLit) return;
    pen.globalAlpha = 0.1;
    pen.fillStyle = theme.label;
    pen.beginPath();
    pen.arc(pivot[0], pivot[1], points[0] - pivot[0] || radius, 0, 2 * Math.PI);
    pen.fill();
    pen.globalAlpha = 1;
  }

  /** Its pieces behind, or those in front with all that stands on it. */
  private ring(shape: Shape, state: GizmoState, behind: boolean): void {
    const { id, points, isBehind, step, range } = shape;
    const isActive = sameHandle(id, state.active);
    const isDragged = sameHandle(id, state.dragged?.id);
    const isLit = isDragged || sameHandle(id, state.hovered);
    const color = this.colorOf(shape, isLit);
    const width = isLit || isActive ? 3 : 1.75;
    const limited = hasArc(range);
    const inReach = (i: number) => !limited || isAllowed(range, (i + 0.5) * step);
    if (!behind) {
      if (isDragged && id.kind === 'dof') this.swept(shape, state);
      // A dark line beside a light one: over any skin it can be told.
      this.pieces(points, (i) => !isBehind[i] && inReach(i), width + 2, this.theme?.labelHalo ?? '#000', 0.45);
    }
    const alpha = behind ? FAINT : id.kind === 'view' && !isLit ? 0.6 : 1;
    const own = (i: number) => isBehind[i] === behind;
    this.pieces(points, (i) => own(i) && inReach(i), behind ? 1.25 : width, color, alpha);
    // Out of reach: every other piece, which reads as dashes.
    if (limited) this.pieces(points, (i) => own(i) && !inReach(i) && i % 2 === 0, 1.5, color, behind ? 0.2 : 0.4);
    if (behind || id.kind !== 'dof' || !(isActive || isLit)) return;
    if (limited) {
      this.tick(shape, range.min - range.value, state.dragged?.stop === 'min' && isDragged, color);
      this.tick(shape, range.max - range.value, state.dragged?.stop === 'max' && isDragged, color);
    }
    this.needle(shape, color);
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
  private swept(shape: Shape, { dragged }: GizmoState): void {
    const { pen, theme } = this;
    if (!dragged || !theme) return;
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
  private tick(shape: Shape, angle: number, isStop: boolean, color: string): void {
    const [x, y] = placeOn(shape, angle);
    const [cx, cy] = centreOf(shape);
    const length = Math.hypot(x - cx, y - cy) || 1;
    const [dx, dy] = [(x - cx) / length, (y - cy) / length];
    const size = isStop ? TICK + 3 : TICK;
    const { pen, theme } = this;
    for (const [width, stroke] of [
      [isStop ? 6 : 4, theme?.labelHalo ?? '#000'],
      [isStop ? 4 : 2, isStop ? (theme?.ghostAfter ?? color) : color],
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
  private needle(shape: Shape, color: string): void {
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
    this.knob(x, y, 4, color);
  }

  private straight(shape: Shape, state: GizmoState): void {
    const { id, points, form, isAway } = shape;
    const isActive = sameHandle(id, state.active);
    const isDragged = sameHandle(id, state.dragged?.id);
    const isLit = isDragged || sameHandle(id, state.hovered);
    const color = this.colorOf(shape, isLit);
    const { pen, theme } = this;
    const [ax, ay, bx, by] = points;
    pen.globalAlpha = isAway ? AWAY : 1;
    if (isActive || isLit) this.rail(shape, state, color);
    for (const [width, stroke] of [
      [isLit || isActive ? 5 : 4, theme?.labelHalo ?? '#000'],
      [isLit || isActive ? 3 : 1.75, color],
    ] as const) {
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
    pen.strokeStyle = theme?.labelHalo ?? '#000';
    pen.stroke();
    pen.fillStyle = color;
    pen.fill();
    pen.restore();
    pen.globalAlpha = 1;
  }

  /** How far a length may go along its arrow, where limits hold it: dashes, with a tick at either end that is near. */
  private rail({ points, range, step, form }: Shape, { dragged }: GizmoState, color: string): void {
    if (form !== 'arrow' || !(Number.isFinite(range.min) && Number.isFinite(range.max))) return;
    const [ax, ay, bx, by] = points;
    const { pen, side, theme } = this;
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
      pen.strokeStyle = isStop ? (theme?.ghostAfter ?? color) : color;
      pen.beginPath();
      pen.moveTo(x - TICK * nx, y - TICK * ny);
      pen.lineTo(x + TICK * nx, y + TICK * ny);
      pen.stroke();
    });
  }

  private dot({ pivot }: Layout): void {
    this.knob(pivot[0], pivot[1], 3, this.theme?.selected ?? '#fff');
  }

  private knob(x: number, y: number, radius: number, color: string): void {
    const { pen, theme } = this;
    pen.beginPath();
    pen.arc(x, y, radius, 0, 2 * Math.PI);
    pen.fillStyle = color;
    pen.fill();
    pen.lineWidth = 1.5;
    pen.strokeStyle = theme?.labelHalo ?? '#000';
    pen.stroke();
  }

  private colorOf({ hue }: Shape, isLit: boolean): string {
    const { theme } = this;
    if (!theme) return '#fff';
    if (isLit) return theme.selected;
    return hue === undefined ? theme.label : [theme.axisX, theme.axisY, theme.axisZ][hue];
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
