/** Shared by the gizmo's pens: active and hovered handles, and their colours. */
import { type HandleId, sameHandle } from '../../evaluate/handles/joint-handles.ts';
import type { StageTheme } from '../theme.ts';
import type { Shape } from './shapes.ts';

export interface GizmoState {
  /** The DOF that dragging the bone rotates. */
  readonly active: HandleId | undefined;
  readonly hovered: HandleId | undefined;
  readonly dragged: DraggedHandle | undefined;
}

export interface DraggedHandle {
  readonly id: HandleId;
  /** The DOF's value when the drag began. */
  readonly from: number;
  /** The limit that it has hit, if any. */
  readonly stop: 'min' | 'max' | undefined;
}

/** Appearance of one shape. */
export interface Look {
  readonly isActive: boolean;
  readonly isDragged: boolean;
  /** Dragged, or hovered. */
  readonly isLit: boolean;
  readonly color: string;
}

export function lookOf({ id, form, hue }: Shape, { active, hovered, dragged }: GizmoState, theme: StageTheme): Look {
  const isDragged = sameHandle(id, dragged?.id);
  const isLit = isDragged || sameHandle(id, hovered);
  const isActive = sameHandle(id, active);
  const moves = form === 'arrow' || form === 'square';
  const ofAxis = moves ? [theme.moveX, theme.moveY, theme.moveZ] : [theme.axisX, theme.axisY, theme.axisZ];
  const own = hue === undefined ? theme.label : hue === 'other' ? theme.vertex : ofAxis[hue];
  return { isActive, isDragged, isLit, color: isLit || isActive ? theme.selected : own };
}

/** A dot with a dark outline. */
export function drawKnob(
  pen: CanvasRenderingContext2D,
  x: number,
  y: number,
  radius: number,
  color: string,
  theme: StageTheme,
): void {
  pen.beginPath();
  pen.arc(x, y, radius, 0, 2 * Math.PI);
  pen.fillStyle = color;
  pen.fill();
  pen.lineWidth = 1.5;
  pen.strokeStyle = theme.labelHalo;
  pen.stroke();
}

/** Widths of lines, in CSS pixels: of a handle, of one in use, and of the ground's colour around both. */
export const LINE = 2.5;
export const LINE_IN_USE = 3.5;
export const EDGE = 2.5;
/** Opacity of that edge. */
export const EDGE_OPACITY = 0.55;

/** Opacity of what points at the viewer. */
export const AWAY = 0.2;

/** Half length of a tick: CSS pixels. */
export const TICK = 7;
