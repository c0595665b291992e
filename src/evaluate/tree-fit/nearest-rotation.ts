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

/** Part of λ³ that ζ must be for the direct solution: below it, digits are lost, as there is no best rotation at 0. */
const CLEAR = 1e-3;
/** Its fourth power is still exact. */
const SMALLEST_EIGENVALUE = 1e-60;
const MAX_EIGENVALUE_STEPS = 30;
/** Relative change of λ after which it is found: the next is its cube, by the square of how far the next root is. */
const FOUND = 1e-7;

/**
 * Writes the best rotation for M where one is clearly the best, else returns false: directly, by the largest eigenvalue
 * λ of Davenport's matrix (Markley, "Attitude Determination Using Vector Observations: A Fast Optimal Matrix
 * Algorithm", 1993).
 *
 *     (λ² − ‖M‖²)² − 8·λ·det M − 4·‖cof M‖² = 0
 *     R = ((κ + ‖M‖²)·M + λ·cof M − M·Mᵀ·M) / ζ        κ = (λ² − ‖M‖²)/2   ζ = κ·λ − det M
 *
 * @param products M, 9 numbers, column-major
 * @param most what λ can't exceed, such as √(Σ|aₖ|²·Σ|bₖ|²)
 * @param r 9 numbers, column-major
 */
export function clearRotation(products: Float64Array, most: number, r: Float64Array): boolean {
  const a = products[0];
  const b = products[1];
  const c = products[2];
  const d = products[3];
  const e = products[4];
  const f = products[5];
  const g = products[6];
  const h = products[7];
  const i = products[8];
  const ca = e * i - f * h;
  const cb = f * g - d * i;
  const cc = d * h - e * g;
  const cd = c * h - b * i;
  const ce = a * i - c * g;
  const cf = b * g - a * h;
  const cg = b * f - c * e;
  const ch = c * d - a * f;
  const ci = a * e - b * d;
  const determinant = a * ca + b * cb + c * cc;
  const squares = a * a + b * b + c * c + d * d + e * e + f * f + g * g + h * h + i * i;
  const cofactors = ca * ca + cb * cb + cc * cc + cd * cd + ce * ce + cf * cf + cg * cg + ch * ch + ci * ci;
  const eightfold = 8 * determinant;
  const fourfold = 4 * cofactors;
  let eigenvalue = most;
  let change = 0;
  // From above, Halley's method never goes below the largest of real roots.
  for (let step = 0; step < MAX_EIGENVALUE_STEPS; step++) {
    const square = eigenvalue * eigenvalue;
    const over = square - squares;
    const value = over * over - eightfold * eigenvalue - fourfold;
    const slope = 4 * eigenvalue * over - eightfold;
    const curve = 12 * square - 4 * squares;
    change = (2 * value * slope) / (2 * slope * slope - value * curve);
    eigenvalue -= change;
    if (!(change > FOUND * eigenvalue)) break;
  }
  const kappa = (eigenvalue * eigenvalue - squares) / 2;
  const zeta = kappa * eigenvalue - determinant;
  const isFound = eigenvalue > SMALLEST_EIGENVALUE && Math.abs(change) <= FOUND * eigenvalue;
  if (!(isFound && zeta > CLEAR * eigenvalue * eigenvalue * eigenvalue)) return false;
  const by = 1 / zeta;
  const own = (kappa + squares) * by;
  const other = eigenvalue * by;
  // Mᵀ·M, by its columns' products.
  const aa = (a * a + b * b + c * c) * by;
  const dd = (d * d + e * e + f * f) * by;
  const gg = (g * g + h * h + i * i) * by;
  const ad = (a * d + b * e + c * f) * by;
  const ag = (a * g + b * h + c * i) * by;
  const dg = (d * g + e * h + f * i) * by;
  r[0] = own * a + other * ca - (a * aa + d * ad + g * ag);
  r[1] = own * b + other * cb - (b * aa + e * ad + h * ag);
  r[2] = own * c + other * cc - (c * aa + f * ad + i * ag);
  r[3] = own * d + other * cd - (a * ad + d * dd + g * dg);
  r[4] = own * e + other * ce - (b * ad + e * dd + h * dg);
  r[5] = own * f + other * cf - (c * ad + f * dd + i * dg);
  r[6] = own * g + other * cg - (a * ag + d * dg + g * gg);
  r[7] = own * h + other * ch - (b * ag + e * dg + h * gg);
  r[8] = own * i + other * ci - (c * ag + f * dg + i * gg);
  return true;
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
