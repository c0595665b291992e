/**
 * The weights of spherical linear interpolation (Shoemake 1985) of unit vectors p and q with an angle θ between them:
 *
 *     slerp(p, q, t) = s(1 − t)·p + s(t)·q          s(t) = sin(t·θ) / sin θ
 *
 * Rotations of consecutive frames are close. For these, s is the sum of a series in cos θ − 1 (Eberly, "A Fast and
 * Accurate Algorithm for Computing SLERP", 2011), which needs no sine and loses no digits at small θ:
 *
 *     s(t) = Σ aₖ        a₀ = t        aₖ = aₖ₋₁ · (t² − k²) / (k·(2k + 1)) · (cos θ − 1)
 */

/** Down to this value of cos θ − 1, seven terms are exact to 1e-14; for quaternions, rotations up to 22° apart. */
const NEAR = -0.02;

/** s(t) for t from 0 to 1. `cosine` is cos θ, from 0 (a right angle) to 1: use the nearer of q and −q. */
export function slerpWeight(t: number, cosine: number): number {
  const e = cosine - 1;
  if (e > NEAR) {
    const s = t * t;
    // Multiplies by constants such as 1/78, since a division takes as long as the whole line.
    const a6 = 1 + (s - 36) * (1 / 78) * e;
    const a5 = 1 + (s - 25) * (1 / 55) * e * a6;
    const a4 = 1 + (s - 16) * (1 / 36) * e * a5;
    const a3 = 1 + (s - 9) * (1 / 21) * e * a4;
    const a2 = 1 + (s - 4) * (1 / 10) * e * a3;
    return t * (1 + (s - 1) * (1 / 3) * e * a2);
  }
  return Math.sin(t * Math.acos(cosine)) / Math.sqrt(1 - cosine * cosine);
}

/** Interpolates unit quaternions along the shorter arc, towards −`q` if that is nearer; `out` may be either. */
export function slerp(p: Float64Array, q: Float64Array, t: number, out: Float64Array): void {
  const cosine = p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3];
  const nearness = cosine < 0 ? -cosine : cosine;
  const a = slerpWeight(1 - t, nearness);
  const b = cosine < 0 ? -slerpWeight(t, nearness) : slerpWeight(t, nearness);
  out[0] = a * p[0] + b * q[0];
  out[1] = a * p[1] + b * q[1];
  out[2] = a * p[2] + b * q[2];
  out[3] = a * p[3] + b * q[3];
}
