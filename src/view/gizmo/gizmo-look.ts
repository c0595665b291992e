/** What the gizmo's pens share: what is in hand, and how that changes a colour. */
import { type HandleId, sameHandle } from '../../evaluate/handles/joint-handles.ts';
import type { StageTheme } from '../theme.ts';
import type { Shape } from './shapes.ts';

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

/** Of one shape. */
export interface Look {
  readonly isActive: boolean;
  readonly isDragged: boolean;
  /** Dragged, or under the pointer. */
  readonly isLit: boolean;
  readonly color: string;
}

export function lookOf({ id, hue }: Shape, { active, hovered, dragged }: GizmoState, theme: StageTheme): Look {
  const isDragged = sameHandle(id, dragged?.id);
  const isLit = isDragged || sameHandle(id, hovered);
  const ofAxis = [theme.axisX, theme.axisY, theme.axisZ];
  const own = hue === undefined ? theme.label : hue === 'other' ? theme.vertex : ofAxis[hue];
  return { isActive: sameHandle(id, active), isDragged, isLit, color: isLit ? theme.selected : own };
}

/** A dot with a dark rim. */
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

/** How far a tick goes to either side of its line: CSS pixels. */
export const TICK = 7;
