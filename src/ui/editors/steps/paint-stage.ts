/** Draws one stage over the scene: the axes of a frame, or the places of a vertex, with the way there. */
import type { Vec3 } from '../../../math/vec3.ts';
import type { PinPainter } from '../../../view/pins/pin-overlay.ts';
import type { Stages } from './stages.ts';

/** Length of an axis without scale, CSS pixels. */
const AXIS_PIXELS = 64;
/** Factors of that for frames that scale. */
const MAX_SCALE = 3;
const AXES = ['axisX', 'axisY', 'axisZ'] as const;

/**
 * @param index of the stage
 * @param placement from the character's space to the world, column-major
 * @param unitsPerPixel world length of a CSS pixel at a place
 */
export function paintStage(
  painter: PinPainter,
  stages: Stages,
  index: number,
  placement: Float64Array,
  unitsPerPixel: (at: Vec3) => number,
): void {
  if (stages.kind === 'places') paintPlaces(painter, stages.places, index, placement);
  else paintFrames(painter, stages.frames, index, placement, unitsPerPixel);
}

function paintFrames(
  painter: PinPainter,
  frames: readonly Float64Array[],
  index: number,
  placement: Float64Array,
  unitsPerPixel: (at: Vec3) => number,
): void {
  let from: Vec3 | undefined;
  for (let k = 0; k <= index; k++) {
    const at = toWorld(placement, frames[k][12], frames[k][13], frames[k][14]);
    if (from && !isSame(from, at)) painter.line(from, at, 'label', 1.5, true);
    from = at;
    // The frame where it begins stays, thin.
    if (k === 0 || k === index) {
      paintAxes(painter, frames[k], at, placement, unitsPerPixel(at) * AXIS_PIXELS, k === index ? 3.5 : 1.25);
    }
  }
  if (from) painter.mark(from, { shape: 'dot', color: 'selected', size: 7 });
}

function paintAxes(
  painter: PinPainter,
  frame: Float64Array,
  at: Vec3,
  placement: Float64Array,
  length: number,
  widthPx: number,
): void {
  const placed = Math.hypot(placement[0], placement[1], placement[2]) || 1;
  AXES.forEach((color, c) => {
    const end = direction(placement, frame[4 * c], frame[4 * c + 1], frame[4 * c + 2]);
    const size = Math.hypot(...end) / placed;
    const by = (length / placed) * (size > MAX_SCALE ? MAX_SCALE / size : 1);
    painter.line(at, [at[0] + by * end[0], at[1] + by * end[1], at[2] + by * end[2]], color, widthPx, false);
  });
}

function paintPlaces(painter: PinPainter, places: readonly Vec3[], index: number, placement: Float64Array): void {
  const last = places.length - 1;
  const seen = places.slice(0, index + 1).map(([x, y, z]) => toWorld(placement, x, y, z));
  const here = seen[index];
  if (!here) return;
  seen.slice(0, -1).forEach((at) => {
    if (isSame(at, here)) return;
    if (index === last) painter.line(at, here, 'label', 1, true);
    painter.mark(at, { shape: 'dot', color: 'label', size: 6 });
  });
  painter.mark(here, { shape: 'dot', color: 'selected', size: 10 });
}

function isSame(a: Vec3, b: Vec3): boolean {
  return a[0] === b[0] && a[1] === b[1] && a[2] === b[2];
}

function toWorld(m: Float64Array, x: number, y: number, z: number): Vec3 {
  const [dx, dy, dz] = direction(m, x, y, z);
  return [dx + m[12], dy + m[13], dz + m[14]];
}

function direction(m: Float64Array, x: number, y: number, z: number): Vec3 {
  const row = (r: number) => m[r] * x + m[r + 4] * y + m[r + 8] * z;
  return [row(0), row(1), row(2)];
}
