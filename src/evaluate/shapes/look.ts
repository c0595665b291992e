/** The camera for thumbnails of poses: from the front, slightly from the left and above. */

import type { Space } from '../../model/space.ts';
import type { Shaded } from './rasterise.ts';
import type { Solid } from './solids.ts';

const YAW = (-35 * Math.PI) / 180;
const PITCH = (14 * Math.PI) / 180;
/** Fraction of the picture's sides that is left free. */
const MARGIN = 0.07;
/** Direction of the light in view space: from the upper left, behind the camera. */
const LIGHT = [-0.42, 0.62, 0.66];
const MIN_LIGHT = 0.12;

/** A solid as seen in a picture of this size, as large as fits. */
export function look(
  solid: Solid,
  up: Space['up'],
  front: readonly [number, number],
  width: number,
  height: number,
): Shaded {
  const { points, normals, triangles } = solid;
  const turn = viewMatrix(up, front);
  const count = points.length / 3;
  const seen = new Float64Array(points.length);
  const light = new Float64Array(count);
  const [low, high] = [
    [Infinity, Infinity],
    [-Infinity, -Infinity],
  ];
  for (let v = 0; v < count; v++) {
    const [x, y, z] = [points[3 * v], points[3 * v + 1], points[3 * v + 2]];
    const [nx, ny, nz] = [normals[3 * v], normals[3 * v + 1], normals[3 * v + 2]];
    let lit = 0;
    let facing = 0;
    for (let r = 0; r < 3; r++) {
      seen[3 * v + r] = turn[r] * x + turn[3 + r] * y + turn[6 + r] * z;
      const n = turn[r] * nx + turn[3 + r] * ny + turn[6 + r] * nz;
      lit += n * LIGHT[r];
      if (r === 2) facing = n;
    }
    // Some files have normals that point inward: visible faces are always lit from outside.
    const length = Math.hypot(nx, ny, nz) || 1;
    const part = (facing < 0 ? -lit : lit) / length;
    light[v] = MIN_LIGHT + (1 - MIN_LIGHT) * Math.min(1, Math.max(0, 0.5 + 0.5 * part) ** 1.3);
    for (let k = 0; k < 2; k++) {
      low[k] = Math.min(low[k], seen[3 * v + k]);
      high[k] = Math.max(high[k], seen[3 * v + k]);
    }
  }
  const inner = [width * (1 - 2 * MARGIN), height * (1 - 2 * MARGIN)];
  const scale = Math.min(inner[0] / (high[0] - low[0] || 1), inner[1] / (high[1] - low[1] || 1));
  for (let v = 0; v < count; v++) {
    seen[3 * v] = width / 2 + scale * (seen[3 * v] - (low[0] + high[0]) / 2);
    seen[3 * v + 1] = height / 2 - scale * (seen[3 * v + 1] - (low[1] + high[1]) / 2);
  }
  return { points: seen, light, triangles };
}

/** View matrix of the character's axes, nine numbers: x to the right, y up, z towards the viewer. */
function viewMatrix(up: Space['up'], [fx, fz]: readonly [number, number]): Float64Array {
  // Front towards the viewer, then turned by the yaw.
  const yaw = YAW - Math.atan2(fx, fz);
  const [cy, sy] = [Math.cos(yaw), Math.sin(yaw)];
  const [cp, sp] = [Math.cos(PITCH), Math.sin(PITCH)];
  const out = new Float64Array(9);
  for (let c = 0; c < 3; c++) {
    const own = [c === 0 ? 1 : 0, c === 1 ? 1 : 0, c === 2 ? 1 : 0];
    // (x, y, z) → (x, z, −y) if z is up, (x, −y, −z) if y is down.
    const [x, y, z] = up === 'y' ? own : up === 'z' ? [own[0], own[2], -own[1]] : [own[0], -own[1], -own[2]];
    const turnedX = cy * x + sy * z;
    const turnedZ = cy * z - sy * x;
    out[3 * c] = turnedX;
    out[3 * c + 1] = cp * y - sp * turnedZ;
    out[3 * c + 2] = sp * y + cp * turnedZ;
  }
  return out;
}
