/** What readers of arrays share: checks of shapes and rates, and rotations as quaternions x y z w. */

import { LONGEST_FRAME, SHORTEST_FRAME } from '../../model/takes/samples.ts';
import { USUAL_FRAMES_PER_SECOND } from '../../model/takes/take.ts';
import type { Remarks } from '../imported.ts';
import { fail, type Numbers, type NumpyArray, shapeText } from './npy.ts';
import type { Arrays } from './npz.ts';

/** Numbers of an array a frame, all but the first dimension together; 0 without frames. */
export function widthOf({ shape, values }: NumpyArray): number {
  return shape[0] > 0 ? values.length / shape[0] : 0;
}

/**
 * An array of a number of frames, if the file has it.
 * @param names that it may have, the first that is there counts
 * @throws ImportError if it has another shape
 */
export function framesOf(
  arrays: Arrays,
  names: readonly string[],
  frameCount: number,
  width: number,
): Numbers | undefined {
  const name = names.find((own) => arrays.has(own));
  const array = name === undefined ? undefined : arrays.array(name);
  if (!array) return undefined;
  if (array.shape[0] !== frameCount || widthOf(array) !== width) {
    fail(
      'arrays-shape',
      `Expected ${frameCount} frames of ${width} numbers in ${name}, found the shape ${shapeText(array)}.`,
    );
  }
  return array.values;
}

/** Names of arrays with a frame rate. */
const RATES = ['mocap_framerate', 'mocap_frame_rate', 'fps'];

/** The frames per second that a file states, else a usual rate, and says so. */
export function rateOf(arrays: Arrays, remarks: Remarks, otherwise = USUAL_FRAMES_PER_SECOND): number {
  let unread = '';
  for (const name of RATES) {
    const header = arrays.header(name);
    if (header && 'USO'.includes(header.type)) unread = name;
    if (!header || name === unread) continue;
    const rate = arrays.array(name)?.values[0] ?? 0;
    if (rate >= 1 / LONGEST_FRAME && rate <= 1 / SHORTEST_FRAME) return rate;
    remarks.warn('rate-expected', `Expected frames per second in ${name}, found ${rate}.`, `used ${otherwise}`);
    return otherwise;
  }
  const found = `${unread} holds texts or Python objects instead of a number, so that`;
  const message = unread === '' ? 'The file states no frame rate (fps).' : `${found} the file states no frame rate.`;
  if (otherwise === USUAL_FRAMES_PER_SECOND)
    remarks.tell('rate-assumed', message, `used ${otherwise} frames per second`);
  return otherwise;
}

/** Writes R⁻¹·v to `out[p …]`, from the quaternion of R at `q[o]`. */
export function turnBack(q: Numbers, o: number, v: Float64Array, out: Float64Array, p: number): void {
  const [x, y, z, w] = [-q[o], -q[o + 1], -q[o + 2], q[o + 3]];
  const u = 2 * (y * v[2] - z * v[1]);
  const s = 2 * (z * v[0] - x * v[2]);
  const t = 2 * (x * v[1] - y * v[0]);
  const [a, b, c] = [v[0] + w * u + y * t - z * s, v[1] + w * s + z * u - x * t, v[2] + w * t + x * s - y * u];
  out[p] = a;
  out[p + 1] = b;
  out[p + 2] = c;
}

/** Writes the quaternion of an axis-angle vector in radians to `out[o …]`. */
export function writeOfVector(x: number, y: number, z: number, out: Float64Array, o: number): void {
  const s = (x * x + y * y + z * z) / 4;
  let sine = 0;
  let cosine = 0;
  if (s < SMALL_SQUARE) {
    // sin √s / √s and cos √s by their series, arranged to shorten chains of dependent operations.
    const t = s * s;
    const sineTail = 1 / 362880 - s * (1 / 39916800) + t * (1 / 6227020800 - s * (1 / 1307674368000));
    sine = 1 - s * (1 / 6) + t * (1 / 120 - s * (1 / 5040)) + t * t * sineTail;
    const cosineTail = 1 / 40320 - s * (1 / 3628800) + t * (1 / 479001600 - s * (1 / 87178291200));
    cosine = 1 - s * (1 / 2) + t * (1 / 24 - s * (1 / 720)) + t * t * cosineTail;
  } else {
    const half = Math.sqrt(s);
    sine = Math.sin(half) / half;
    cosine = Math.cos(half);
  }
  out[o] = 0.5 * x * sine;
  out[o + 1] = 0.5 * y * sine;
  out[o + 2] = 0.5 * z * sine;
  out[o + 3] = cosine;
}

/** Up to it, the next terms of the series above are less than 1e-17. */
const SMALL_SQUARE = 0.36;

/** `out` = p · q, of quaternions; `out` may be neither. */
export function multiplyInto(
  p: Float64Array,
  po: number,
  q: Float64Array,
  qo: number,
  out: Float64Array,
  o: number,
): void {
  const [a, b, c, d] = [p[po], p[po + 1], p[po + 2], p[po + 3]];
  const [x, y, z, w] = [q[qo], q[qo + 1], q[qo + 2], q[qo + 3]];
  out[o] = d * x + a * w + b * z - c * y;
  out[o + 1] = d * y - a * z + b * w + c * x;
  out[o + 2] = d * z + a * y - b * x + c * w;
  out[o + 3] = d * w - a * x - b * y - c * z;
}
