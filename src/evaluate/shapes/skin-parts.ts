/**
 * Roughly where the vertices of each joint are, as an ellipsoid: enough to tell what is behind what, without the skin's
 * triangles.
 *
 *     c = Σ w·v / Σ w          C = Σ w·(v − c)(v − c)ᵀ / Σ w          L·Lᵀ = 3·C (Cholesky)
 *     ellipsoid = { c + L·u : |u| ≤ 1 }
 *
 * The factor 3 is that of a shell: points all over the surface of an ellipsoid have a variance of a²/3 along a half
 * axis a. Weights count, so that the few vertices that a joint shares with its neighbours don't widen it.
 */
import { perObject } from '../../model/per-object.ts';
import { type Skin, vertexCount } from '../../model/skin.ts';
import { matrixCountOf } from '../skin/deform.ts';

/** Numbers per part: c (x y z), then the rows of L (xx, yx yy, zx zy zz). */
export const PART_STRIDE = 9;
/** Vertices looked at; of more, every second or third. */
const MAX_VERTICES = 20_000;
const SHELL = 3;
/** Smallest half axis, as a fraction of the largest: a flat sheet still has a front. */
const FLAT = 0.02;

/** `PART_STRIDE` numbers per joint, in the skin's own space; NaN for joints that move no vertex. Cached. */
export const skinParts = perObject(measure);

function measure(skin: Skin): Float64Array {
  const { positions, attachments } = skin;
  const vertices = vertexCount(skin);
  const joints = matrixCountOf(skin);
  const step = Math.max(1, Math.ceil(vertices / MAX_VERTICES));
  /** Per joint: Σ w, Σ w·v, Σ w·v·vᵀ as xx yx yy zx zy zz. */
  const sums = new Float64Array(10 * joints);
  for (let v = 0; v < vertices; v += step) {
    if (!attachments) add(sums, 0, 1, positions, v);
    else {
      for (let a = attachments.start[v]; a < attachments.start[v + 1]; a++) {
        if (attachments.weights[a] > 0) add(sums, attachments.joints[a], attachments.weights[a], positions, v);
      }
    }
  }
  const parts = new Float64Array(PART_STRIDE * joints).fill(Number.NaN);
  for (let j = 0; j < joints; j++) if (sums[10 * j] > 0) setPart(parts, PART_STRIDE * j, sums, 10 * j);
  return parts;
}

function add(sums: Float64Array, joint: number, weight: number, positions: Float64Array, vertex: number): void {
  const o = 10 * joint;
  const x = positions[3 * vertex];
  const y = positions[3 * vertex + 1];
  const z = positions[3 * vertex + 2];
  sums[o] += weight;
  sums[o + 1] += weight * x;
  sums[o + 2] += weight * y;
  sums[o + 3] += weight * z;
  sums[o + 4] += weight * x * x;
  sums[o + 5] += weight * y * x;
  sums[o + 6] += weight * y * y;
  sums[o + 7] += weight * z * x;
  sums[o + 8] += weight * z * y;
  sums[o + 9] += weight * z * z;
}

function setPart(parts: Float64Array, p: number, sums: Float64Array, o: number): void {
  const total = sums[o];
  const x = sums[o + 1] / total;
  const y = sums[o + 2] / total;
  const z = sums[o + 3] / total;
  const of = (k: number, mean: number) => SHELL * Math.max(0, sums[o + k] / total - mean);
  const widest = Math.max(of(4, x * x), of(6, y * y), of(9, z * z));
  const thin = FLAT * FLAT * widest;
  const xx = Math.sqrt(of(4, x * x) + thin);
  const yx = (SHELL * (sums[o + 5] / total - y * x)) / (xx || 1);
  const yy = Math.sqrt(Math.max(thin, of(6, y * y) + thin - yx * yx));
  const zx = (SHELL * (sums[o + 7] / total - z * x)) / (xx || 1);
  const zy = (SHELL * (sums[o + 8] / total - z * y) - zx * yx) / (yy || 1);
  const zz = Math.sqrt(Math.max(thin, of(9, z * z) + thin - zx * zx - zy * zy));
  parts.set([x, y, z, xx, yx, yy, zx, zy, zz], p);
}
