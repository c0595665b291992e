/**
 * Interpolates joints of three Euler angles between two close frames, which are nearly all in a capture: the same slerp
 * and conversion to angles as in `sampled-rotations.ts`, inlined so that a crowd can play. It gains from computing all
 * sines and cosines of a row at once; from the series of `math/slerp.ts`, whose terms, except for the powers of cos θ −
 * 1, are the same for all joints; from small changes of angles; and from keeping numbers out of arrays and calls.
 *
 * From the angles of the frame to those of the rotation q in between, with the vectors of `math/euler.ts`:
 *
 *     half sum, half difference     change by atan(cross product / dot product) of the frame's vector and that of q
 *     β                             changes by asin(sin β_q · cos β − cos β_q · sin β)
 *     sin β_q, cos β_q              are (d² − s²) / 2 and s·d, of the lengths s and d of the two vectors of q
 *
 * Polynomials are arranged to shorten chains of dependent operations, and truncated below the last digit: half of the
 * time was spent there.
 */
import type { Samples } from '../../model/takes/samples.ts';
import type { PoseRotations } from '../rotations/pose-rotations.ts';
import { HalfAngles } from './half-angles.ts';
import type { SampledJoints } from './sampled-joints.ts';

/** Terms of the slerp series, and the minimum of cos θ − 1 for which they are exact. */
const TERMS = 7;
const NEAR = -0.02;
/** From here on four terms are enough. */
const VERY_NEAR = -0.0003;
/** Maximum change of one of the angles above. */
const SMALL = 0.1;
/** Below this sum of all three squares, shorter series are enough. */
const VERY_SMALL = 4e-4;
/** Squared length of a vector one degree from gimbal lock. */
const BESIDE_LOCK = 1e-4;

/** Scratch, here and below. */
const fromRow = new HalfAngles();
const toRow = new HalfAngles();
const ownTerms = new Float64Array(TERMS);
const nextTerms = new Float64Array(TERMS);

/**
 * Computes what all rotations have in common.
 * @param row the frame before the time
 * @param part fraction of the way to the next frame
 */
export function readRows(
  { values, scales }: Samples,
  { eulerColumns, eulerHalves }: SampledJoints,
  row: number,
  part: number,
): void {
  const at = row * scales.length;
  fromRow.read(values, at, eulerColumns, eulerHalves);
  toRow.read(values, at + scales.length, eulerColumns, eulerHalves);
  if (nextTerms[0] === part) return;
  writeTerms(1 - part, ownTerms);
  writeTerms(part, nextTerms);
}

/**
 * Writes the DOFs of rotation `r`, after `readRows`. One rotation per call: a loop around all this sometimes runs in a
 * version compiled on-stack, at half the speed.
 * @returns false, writing nothing, if the frames are not close
 */
export function nearEuler(
  { eulerJoints, eulerDofs, eulerSigns, eulerAxes }: SampledJoints,
  r: number,
  out: Float64Array,
  rotations: PoseRotations | undefined,
): boolean {
  const { halves: from, turned: fromTurned } = fromRow;
  const { halves: to, turned: toTurned } = toRow;
  const i = 3 * r;
  const k = 2 * i;
  let sx = fromTurned[k];
  let cx = fromTurned[k + 1];
  const sy = fromTurned[k + 2];
  const cy = fromTurned[k + 3];
  let sz = fromTurned[k + 4];
  let cz = fromTurned[k + 5];
  const x0 = sx * cy * cz - cx * sy * sz;
  const y0 = cx * sy * cz + sx * cy * sz;
  const z0 = cx * cy * sz - sx * sy * cz;
  const w0 = cx * cy * cz + sx * sy * sz;
  // Of the frame's β.
  const sine = 2 * sy * cy;
  const cosine = cy * cy - sy * sy;

  sx = toTurned[k];
  cx = toTurned[k + 1];
  const ty = toTurned[k + 2];
  const uy = toTurned[k + 3];
  sz = toTurned[k + 4];
  cz = toTurned[k + 5];
  const x1 = sx * uy * cz - cx * ty * sz;
  const y1 = cx * ty * cz + sx * uy * sz;
  const z1 = cx * uy * sz - sx * ty * cz;
  const w1 = cx * uy * cz + sx * ty * sz;

  const e = x0 * x1 + y0 * y1 + z0 * z1 + w0 * w1 - 1;
  const ee = e * e;
  let p = ownTerms[0] + e * ownTerms[1] + ee * (ownTerms[2] + e * ownTerms[3]);
  let q = nextTerms[0] + e * nextTerms[1] + ee * (nextTerms[2] + e * nextTerms[3]);
  if (e < VERY_NEAR) {
    p += ee * ee * (ownTerms[4] + e * ownTerms[5] + ee * ownTerms[6]);
    q += ee * ee * (nextTerms[4] + e * nextTerms[5] + ee * nextTerms[6]);
  }
  const x = p * x0 + q * x1;
  const y = p * y0 + q * y1;
  const z = p * z0 + q * z1;
  const w = p * w0 + q * w1;

  const s0 = x0 + z0;
  const c0 = w0 - y0;
  const d0 = z0 - x0;
  const e0 = w0 + y0;
  const s1 = x + z;
  const c1 = w - y;
  const d1 = z - x;
  const e1 = w + y;
  const ofSum = s1 * s1 + c1 * c1;
  const ofDifference = d1 * d1 + e1 * e1;
  const sumCosine = c0 * c1 + s0 * s1;
  const differenceCosine = e0 * e1 + d0 * d1;
  let sum = (c0 * s1 - s0 * c1) / sumCosine;
  let difference = (e0 * d1 - d0 * e1) / differenceCosine;
  let beta = 0.5 * (ofDifference - ofSum) * cosine - Math.sqrt(ofSum * ofDifference) * sine;
  const a = from[i] - to[i];
  const b = from[i + 1] - to[i + 1];
  const c = from[i + 2] - to[i + 2];
  const u = sum * sum;
  const v = difference * difference;
  const t = beta * beta;
  // Written so that NaN counts as far. Beyond β = ±90° the cosine is negative; close to it one vector has hardly a
  // direction. A dot product is negative if a vector turns by more than a quarter.
  const isNear =
    e > NEAR &&
    a * a + b * b + c * c < 0.25 &&
    sumCosine > 0 &&
    differenceCosine > 0 &&
    cosine > 0 &&
    ofSum > BESIDE_LOCK &&
    ofDifference > BESIDE_LOCK &&
    u + v + t < SMALL * SMALL;
  if (!isNear) return false;
  if (u + v + t < VERY_SMALL) {
    sum *= 1 - u * (1 / 3 - u * (1 / 5 - u * (1 / 7 - u * (1 / 9))));
    difference *= 1 - v * (1 / 3 - v * (1 / 5 - v * (1 / 7 - v * (1 / 9))));
    beta *= 1 + t * (1 / 6 + t * (3 / 40 + t * (5 / 112 + t * (35 / 1152))));
  } else {
    sum *= 1 - u * (1 / 3 - u * (1 / 5 - u * (1 / 7 - u * (1 / 9 - u * (1 / 11 - u * (1 / 13))))));
    difference *= 1 - v * (1 / 3 - v * (1 / 5 - v * (1 / 7 - v * (1 / 9 - v * (1 / 11 - v * (1 / 13))))));
    beta *= 1 + t * (1 / 6 + t * (3 / 40 + t * (5 / 112 + t * (35 / 1152 + t * (63 / 2816 + t * (231 / 13312))))));
  }
  let alpha = 2 * from[i];
  let middle = 2 * from[i + 1];
  let gamma = 2 * from[i + 2];
  // Joints at rest keep exactly the angles of the file.
  if (a !== 0 || b !== 0 || c !== 0) {
    alpha += sum - difference;
    middle += beta;
    gamma += sum + difference;
  }
  const sign = eulerSigns[r];
  if (rotations) {
    const { values } = rotations;
    const o = 8 * eulerJoints[r];
    values[o] = sign * alpha;
    values[o + 1] = sign * middle;
    values[o + 2] = sign * gamma;
    values[o + 3 + eulerAxes[i]] = sign * x;
    values[o + 3 + eulerAxes[i + 1]] = sign * y;
    values[o + 3 + eulerAxes[i + 2]] = sign * z;
    values[o + 6] = w;
  }
  out[eulerDofs[i]] = sign * alpha;
  out[eulerDofs[i + 1]] = sign * middle;
  out[eulerDofs[i + 2]] = sign * gamma;
  return true;
}

/**
 * Σ aₖ·(cos θ − 1)ᵏ is the weight of one of the two rotations; these are aₖ for a fraction of the way from the other.
 */
function writeTerms(t: number, out: Float64Array): void {
  out[0] = t;
  for (let k = 1; k < TERMS; k++) out[k] = (out[k - 1] * (t * t - k * k)) / (k * (2 * k + 1));
}
