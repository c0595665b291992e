/**
 * Where a character is drawn. A placement's matrix is
 *
 *     P = T(position) · Rz·Ry·Rx(turn) · S(scale) · T(−tx, 0, −tz)
 *
 * where the last factor is there only "in place": it takes the root's travel over the ground out of the picture, and
 * leaves pose and document alone.
 */
import type { Placement } from '../model/document.ts';

/** Writes P at `out[o] …`, column-major. `travelX`, `travelZ`: root translation to cancel, 0 for none. */
export function placementMatrix(p: Placement, travelX: number, travelZ: number, out: Float64Array, o = 0): void {
  const [rx, ry, rz] = p.turn;
  const cx = Math.cos(rx);
  const sx = Math.sin(rx);
  const cy = Math.cos(ry);
  const sy = Math.sin(ry);
  const cz = Math.cos(rz);
  const sz = Math.sin(rz);
  const s = p.scale;
  out[o] = cz * cy * s;
  out[o + 1] = sz * cy * s;
  out[o + 2] = -sy * s;
  out[o + 3] = 0;
  out[o + 4] = (cz * sy * sx - sz * cx) * s;
  out[o + 5] = (sz * sy * sx + cz * cx) * s;
  out[o + 6] = cy * sx * s;
  out[o + 7] = 0;
  out[o + 8] = (cz * sy * cx + sz * sx) * s;
  out[o + 9] = (sz * sy * cx - cz * sx) * s;
  out[o + 10] = cy * cx * s;
  out[o + 11] = 0;
  out[o + 12] = p.position[0] - out[o] * travelX - out[o + 8] * travelZ;
  out[o + 13] = p.position[1] - out[o + 1] * travelX - out[o + 9] * travelZ;
  out[o + 14] = p.position[2] - out[o + 2] * travelX - out[o + 10] * travelZ;
  out[o + 15] = 1;
}
