/**
 * Where characters' names are placed: above the highest joint, centred on the mean of all joints. (The highest joint
 * may be a hand now and a head then; a name jumping between them couldn't be read.) Of a character that is only a few
 * pixels tall the name is what can be seen, and clicked.
 */
import type { Matrix4 } from 'three';
import type { DrawnSkeleton } from '../skeleton/drawn-skeletons.ts';

/** From the highest joint to the middle of the name, plus a part of the height for skull or hat. */
const GAP = 11;
const HEAD = 0.05;
/** Keeps names below the tools at the top of the viewport, in front of the face if necessary. */
export const MIN_Y = 56;
/** CSS pixels between a name and the edge of the viewport. */
const EDGE = 6;
/** Of the axis widget in the upper right corner: down to here, and from the right edge. */
const [WIDGET_BOTTOM, WIDGET_WIDTH] = [130, 92];
/** Joints looked at; of more, every second or third. */
const MAX_JOINTS = 48;

/**
 * Writes to `out` x and y of the middle of the name, then the highest and the lowest y of the character, all in CSS
 * pixels; false if it isn't in view. Uses the first placement. Allocates nothing.
 *
 * @param positions x y z of each instance of the skeleton drawing
 */
export function placeName(
  { firstInstance, nodes }: DrawnSkeleton,
  positions: Float64Array,
  toTake: Matrix4,
  width: number,
  height: number,
  out: Float64Array,
): boolean {
  const m = toTake.elements;
  const step = Math.ceil(nodes.count / MAX_JOINTS);
  let sum = 0;
  let count = 0;
  let top = Infinity;
  let bottom = -Infinity;
  for (let n = 0; n < nodes.count; n += step) {
    const o = 3 * (firstInstance + n);
    const x = positions[o];
    const y = positions[o + 1];
    const z = positions[o + 2];
    const w = m[3] * x + m[7] * y + m[11] * z + m[15];
    // Behind the camera, for example when it is inside the character.
    if (!(w > 0)) return false;
    const down = (0.5 - (0.5 * (m[1] * x + m[5] * y + m[9] * z + m[13])) / w) * height;
    sum += ((0.5 * (m[0] * x + m[4] * y + m[8] * z + m[12])) / w + 0.5) * width;
    count++;
    top = Math.min(top, down);
    bottom = Math.max(bottom, down);
  }
  out[0] = sum / count;
  out[1] = Math.max(MIN_Y, top - GAP - HEAD * (bottom - top));
  out[2] = top;
  out[3] = bottom;
  return out[0] >= 0 && out[0] <= width && bottom >= 0 && out[1] <= Math.max(bottom, MIN_Y) && top <= height;
}

/**
 * Where the first letter of a name is placed: centred on `x`, within the viewport, and beside its axis widget.
 *
 * @param y middle of the line
 * @param isBeside false: it may be behind the axis widget, partly
 */
export function nameLeft(x: number, y: number, nameWidth: number, viewportWidth: number, isBeside = true): number {
  const free = viewportWidth - (isBeside && y < WIDGET_BOTTOM ? WIDGET_WIDTH : EDGE);
  return Math.max(EDGE, Math.min(free - nameWidth, x - nameWidth / 2));
}
