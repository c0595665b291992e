/**
 * Where a character is drawn. A placement's matrix is
 *
 *     P = T(position) · Rz·Ry·Rx(turn) · S(scale) · [ T(0, lift, 0) · S(metres per unit) · Up ] · T(−travel)
 *
 * In brackets: the character's space (`evaluate/space.ts`), omitted if it has none. The last factor is only used "in
 * place": it cancels the travel over the ground (`evaluate/travel.ts`) without changing pose or document.
 */
import type { Placement } from '../../model/document.ts';
import { DEFAULT_SPACE, type Space } from '../../model/space.ts';
import { metresPerUnit } from './metres.ts';

/** For placements that cancel no travel. */
export const NO_TRAVEL: Float64Array = new Float64Array(3);

/**
 * Writes P at `out[o] …`, column-major.
 * @param travel x y z to cancel, in the character's own space: see `groundTravel`
 */
export function placementMatrix(
  p: Placement,
  space: Space | undefined,
  travel: Float64Array,
  out: Float64Array,
  o = 0,
): void {
  const { up, lift } = space ?? DEFAULT_SPACE;
  const [rx, ry, rz] = p.turn;
  const cx = Math.cos(rx);
  const sx = Math.sin(rx);
  const cy = Math.cos(ry);
  const sy = Math.sin(ry);
  const cz = Math.cos(rz);
  const sz = Math.sin(rz);
  const s = space ? p.scale * metresPerUnit(space) : p.scale;
  // Columns of the rotation: images of x, y and z of the scene's metres. In a space with z up, y is their −z.
  const yAt = up === 'z' ? o + 8 : o + 4;
  const zAt = up === 'z' ? o + 4 : o + 8;
  // With y down, both are turned by half a turn about x.
  const yScale = up === '-y' ? -s : s;
  const zScale = up === 'y' ? s : -s;
  const upX = cz * sy * sx - sz * cx;
  const upY = sz * sy * sx + cz * cx;
  const upZ = cy * sx;
  out[o] = cz * cy * s;
  out[o + 1] = sz * cy * s;
  out[o + 2] = -sy * s;
  out[yAt] = upX * yScale;
  out[yAt + 1] = upY * yScale;
  out[yAt + 2] = upZ * yScale;
  out[zAt] = (cz * sy * cx + sz * sx) * zScale;
  out[zAt + 1] = (sz * sy * cx - cz * sx) * zScale;
  out[zAt + 2] = cy * cx * zScale;
  out[o + 3] = out[o + 7] = out[o + 11] = 0;
  const raised = p.scale * lift;
  const x = travel[0];
  const y = travel[1];
  const z = travel[2];
  out[o + 12] = p.position[0] + upX * raised - out[o] * x - out[o + 4] * y - out[o + 8] * z;
  out[o + 13] = p.position[1] + upY * raised - out[o + 1] * x - out[o + 5] * y - out[o + 9] * z;
  out[o + 14] = p.position[2] + upZ * raised - out[o + 2] * x - out[o + 6] * y - out[o + 10] * z;
  out[o + 15] = 1;
}
