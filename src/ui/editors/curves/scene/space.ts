/**
 * The curve editor's coordinates. Everything on screen is in CSS pixels from the plot's top left corner, everything in
 * the document in seconds of the take and model units (radians, lengths, factors, weights).
 *
 *      x = 0                                  width
 *      ┌────────────────────────────────────────┐ y = 0            axis.high
 *      │        ╭──╮                            │
 *      │  ──────╯  ╰──────── curves             │ value up, y down
 *      └────────────────────────────────────────┘ y = height       axis.low
 * window.from   (transport's seconds)     window.to
 *
 *      take's time = transport's time + offsetSeconds
 *
 * Angles, lengths, factors and weights have an axis each: three metres and three radians need not be at the same
 * height. All axes are zoomed and panned together, so that curves don't move against each other. Normalised lines share
 * a fifth axis, on which each line's smallest key is −1 and its largest is 1.
 */
import { DOF_UNITS } from '../../../../model/skeleton/skeleton.ts';
import { pixelsPerSecond, type TimeStrip, timeAt, zoomWindow } from '../../../widgets/time/time-window.ts';

/** The units of DOFs, and the axis of normalised lines. */
export const VALUE_AXES = [...DOF_UNITS, 'normalised'] as const;
export type AxisName = (typeof VALUE_AXES)[number];

/** Range of an axis from bottom to top, in model units; `high` is above `low`. */
export interface ValueAxis {
  readonly low: number;
  readonly high: number;
}

/** The window is in seconds of the transport. */
export interface CurveSpace extends TimeStrip {
  /** CSS pixels. */
  readonly height: number;
  readonly axes: Readonly<Record<AxisName, ValueAxis>>;
}

/** On its axis, a value is at value · scale + shift. */
export interface Normalise {
  readonly scale: number;
  readonly shift: number;
}

/** The part of a line that determines where its values are drawn. */
export interface OnAxis {
  readonly axis: AxisName;
  readonly normalise?: Normalise;
}

export const DEFAULT_AXES: CurveSpace['axes'] = {
  angle: { low: -Math.PI / 2, high: Math.PI / 2 },
  length: { low: -1, high: 1 },
  factor: { low: -0.2, high: 2.2 },
  weight: { low: -0.1, high: 1.1 },
  normalised: { low: -1.15, high: 1.15 },
};

/** Limits of zooming, in model units. */
const SMALLEST_EXTENT = 1e-9;
const LARGEST_EXTENT = 1e9;

export function yOf(space: CurveSpace, line: OnAxis, value: number): number {
  const { low } = space.axes[line.axis];
  const n = line.normalise;
  return space.height - ((n ? value * n.scale + n.shift : value) - low) * axisPixels(space, line.axis);
}

/** The value at a height, in model units. */
export function valueAt(space: CurveSpace, line: OnAxis, y: number): number {
  const { low } = space.axes[line.axis];
  const shown = low + (space.height - y) / axisPixels(space, line.axis);
  return line.normalise ? (shown - line.normalise.shift) / line.normalise.scale : shown;
}

/** Pixels per unit of an axis. */
function axisPixels(space: CurveSpace, axis: AxisName): number {
  const { low, high } = space.axes[axis];
  return Math.max(1, space.height) / (high - low);
}

/** Pixels upwards per model unit of a line. */
export function pixelsPerUnit(space: CurveSpace, line: OnAxis): number {
  return axisPixels(space, line.axis) * (line.normalise?.scale ?? 1);
}

/** Zooms about a point; factors above 1 zoom out, 1 keeps that direction. */
export function zoom(
  space: CurveSpace,
  aboutX: number,
  aboutY: number,
  timeFactor: number,
  valueFactor: number,
): CurveSpace {
  const window = timeFactor === 1 ? space.window : zoomWindow(space.window, timeAt(space, aboutX), timeFactor);
  if (valueFactor === 1) return { ...space, window };
  const part = (space.height - aboutY) / Math.max(1, space.height);
  const axes = mapAxes(space.axes, ({ low, high }) => {
    const extent = high - low;
    const next = Math.min(LARGEST_EXTENT, Math.max(SMALLEST_EXTENT, extent * valueFactor));
    const about = low + part * extent;
    return { low: about - part * next, high: about + (1 - part) * next };
  });
  return { ...space, window, axes };
}

/** Pans with the pointer: `dx` to the right, `dy` down. */
export function pan(space: CurveSpace, dx: number, dy: number): CurveSpace {
  const seconds = -dx / pixelsPerSecond(space);
  const window = dx === 0 ? space.window : { from: space.window.from + seconds, to: space.window.to + seconds };
  if (dy === 0) return { ...space, window };
  const part = dy / Math.max(1, space.height);
  const axes = mapAxes(space.axes, ({ low, high }) => {
    const move = part * (high - low);
    return { low: low + move, high: high + move };
  });
  return { ...space, window, axes };
}

/** Resizes the plot: time and value ranges stay. */
export function resize(space: CurveSpace, width: number, height: number): CurveSpace {
  return width === space.width && height === space.height ? space : { ...space, width, height };
}

function mapAxes(axes: CurveSpace['axes'], change: (axis: ValueAxis) => ValueAxis): CurveSpace['axes'] {
  return {
    angle: change(axes.angle),
    length: change(axes.length),
    factor: change(axes.factor),
    weight: change(axes.weight),
    normalised: change(axes.normalised),
  };
}
