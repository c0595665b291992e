/**
 * The rotation R that fits vectors aₖ best to vectors bₖ: it makes Σ|R·aₖ − bₖ|² least, so tr(Rᵀ·M) greatest with
 * M = Σ bₖ·aₖᵀ. Newton's method on rotations, from one that is near:
 *
 *     A = Rᵀ·M   H = tr(A)·I − (A + Aᵀ)/2   H·δ = g, the axis of A − Aᵀ   R ← R·exp(δ)
 *
 * Where H is positive definite and δ is 0, it is the best of all: no other rotation is a local maximum. Else four
 * rotations far from each other are tried.
 */
import { copy3, multiply3, setIdentity3, turnAbout } from '../../math/mat3.ts';

const MAX_STEPS = 24;
/** Where M's largest number is 1: what a step gains when the next, its square, gains nothing. */
const LITTLE = 1e-15;
/** Likewise, below which a minor counts as 0. */
const LEAST = 1e-14;
/** M has no direction if its numbers are smaller. */
const TINY = 1e-300;

/** How much a rotation is drawn to the one that it should be near, for turns that the vectors don't tell. */
const DRAWN = 1e-9;

/**
 * Replaces the rotation at `r` by the best one for M, beginning from it.
 * @param products M, 9 numbers, column-major
 * @param r 9 numbers, column-major
 * @param near of all that are as good, the one nearest to this is meant: 9 numbers from `n`
 */
export function nearestRotation(products: Float64Array, r: Float64Array, near: Float64Array, n = 0): void {
  let size = 0;
  for (let k = 0; k < 9; k++) size = Math.max(size, Math.abs(products[k]));
  if (!(size > TINY)) {
    copy3(near, n, r, 0);
    return;
  }
  // So that no product of a few of them is too small or too large.
  for (let k = 0; k < 9; k++) m[k] = products[k] / size + DRAWN * near[n + k];
  if (climbs(r)) return;
  let best = Number.NEGATIVE_INFINITY;
  copy3(r, 0, found, 0);
  for (let axis = -1; axis < 3; axis++) {
    if (axis < 0) setIdentity3(tried);
    else turnAbout(axis === 0 ? 1 : 0, axis === 1 ? 1 : 0, axis === 2 ? 1 : 0, -1, 0, tried, 0);
    climbs(tried);
    let trace = 0;
    for (let k = 0; k < 9; k++) trace += tried[k] * m[k];
    if (trace <= best) continue;
    best = trace;
    copy3(tried, 0, found, 0);
  }
  copy3(found, 0, r, 0);
}

/** Whether it ends at the best rotation. */
function climbs(r: Float64Array): boolean {
  for (let step = 0; step < MAX_STEPS; step++) {
    // A = Rᵀ·M, by its diagonal, its symmetric and its skew part.
    const a = r[0] * m[0] + r[1] * m[1] + r[2] * m[2];
    const b = r[3] * m[0] + r[4] * m[1] + r[5] * m[2];
    const c = r[6] * m[0] + r[7] * m[1] + r[8] * m[2];
    const d = r[0] * m[3] + r[1] * m[4] + r[2] * m[5];
    const e = r[3] * m[3] + r[4] * m[4] + r[5] * m[5];
    const f = r[6] * m[3] + r[7] * m[4] + r[8] * m[5];
    const g = r[0] * m[6] + r[1] * m[7] + r[2] * m[8];
    const h = r[3] * m[6] + r[4] * m[7] + r[5] * m[8];
    const i = r[6] * m[6] + r[7] * m[7] + r[8] * m[8];
    const x = f - h;
    const y = g - c;
    const z = b - d;
    const xx = e + i;
    const yy = a + i;
    const zz = a + e;
    const xy = -(b + d) / 2;
    const xz = -(c + g) / 2;
    const yz = -(f + h) / 2;
    // By cofactors. H is positive definite if its leading minors are positive, each by the one before.
    const minor = xx * yy - xy * xy;
    const ux = yy * zz - yz * yz;
    const uy = xz * yz - xy * zz;
    const uz = xy * yz - xz * yy;
    const determinant = xx * ux + xy * uy + xz * uz;
    let u = x;
    let v = y;
    let w = z;
    const isMaximum = xx > LEAST && minor > LEAST * xx && determinant > LEAST * minor;
    if (isMaximum) {
      const vz = xy * xz - xx * yz;
      const by = 1 / determinant;
      u = (ux * x + uy * y + uz * z) * by;
      v = (uy * x + (xx * zz - xz * xz) * y + vz * z) * by;
      w = (uz * x + vz * y + minor * z) * by;
    }
    const length = Math.sqrt(u * u + v * v + w * w);
    // Shorter ones lose digits.
    if (!(length > 1e-150)) return isMaximum;
    const along = 1 / length;
    const gain = x * u + y * v + z * w;
    // Of all turns about that axis the best: what they gain is a sine, whose slope and curvature are known.
    const curvature =
      (xx * u * u + yy * v * v + zz * w * w + 2 * (xy * u * v + xz * u * w + yz * v * w)) * along * along;
    const slope = gain * along;
    const reach = Math.sqrt(slope * slope + curvature * curvature);
    if (!(reach > 0)) return isMaximum;
    turnAbout(u * along, v * along, w * along, curvature / reach, slope / reach, turn, 0);
    multiply3(r, 0, turn, 0, next, 0);
    copy3(next, 0, r, 0);
    if (isMaximum && gain < LITTLE) return true;
    if (!isMaximum && slope * Math.abs(Math.atan2(slope, curvature)) < LITTLE) return false;
  }
  return false;
}

/** Scratch; never escapes. */
const m = new Float64Array(9);
const turn = new Float64Array(9);
const next = new Float64Array(9);
const tried = new Float64Array(9);
const found = new Float64Array(9);
