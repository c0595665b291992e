/** Unit quaternions x y z w in arrays, frame after frame. */
import { quaternionOfRotation } from '../math/quaternion.ts';

/** Writes a 3 × 3 rotation as a unit quaternion: of columns that were nearly parallel it is one only roughly. */
export function writeUnitQuaternion(rotation: Float64Array, quaternion: Float64Array): void {
  quaternionOfRotation(rotation, 0, quaternion);
  let square = 0;
  for (let k = 0; k < 4; k++) square += quaternion[k] * quaternion[k];
  const length = Math.sqrt(square);
  for (let k = 0; k < 4; k++) quaternion[k] /= length;
}

/** Writes a quaternion with the sign nearer to the one before, which it becomes. */
export function put(
  out: Float64Array,
  o: number,
  x: number,
  y: number,
  z: number,
  w: number,
  before: Float64Array,
  p: number,
): void {
  const near = x * before[p] + y * before[p + 1] + z * before[p + 2] + w * before[p + 3];
  const sign = near < 0 ? -1 : 1;
  out[o] = before[p] = sign * x;
  out[o + 1] = before[p + 1] = sign * y;
  out[o + 2] = before[p + 2] = sign * z;
  out[o + 3] = before[p + 3] = sign * w;
}

/** Turns q by the up axis, (x, y, z) → (x, z, −y): the product of −√½ i + √½ and q. */
export function turnUp(q: Float64Array, o: number, up: 'z' | '-y'): void {
  const x = q[o];
  const y = q[o + 1];
  const z = q[o + 2];
  const w = q[o + 3];
  if (up === '-y') {
    q[o] = w;
    q[o + 1] = -z;
    q[o + 2] = y;
    q[o + 3] = -x;
    return;
  }
  q[o] = Math.SQRT1_2 * (x - w);
  q[o + 1] = Math.SQRT1_2 * (y + z);
  q[o + 2] = Math.SQRT1_2 * (z - y);
  q[o + 3] = Math.SQRT1_2 * (w + x);
}
