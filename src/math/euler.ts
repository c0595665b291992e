/**
 * Converts between Euler angles α β γ of a rotation Rz(γ)·Ry(β)·Rx(α) and unit quaternions x y z w.
 *
 * Other orders are the same with the axes renamed; `evaluate/motions.ts` does that. Angles are recovered from half the
 * sum and half the difference of the outer angles (Bernardes and Viollet, "Quaternion to Euler angles conversion: A
 * direct, general and computationally efficient method", 2022):
 *
 *     (w − y, x + z) = √2·cos(β/2 + 45°) · (cos, sin) (γ + α)/2
 *     (w + y, z − x) = √2·sin(β/2 + 45°) · (cos, sin) (γ − α)/2
 *
 * Through a matrix, β is an arc sine, which loses half its digits near 90°, exactly where the choice of angles matters.
 * From a nearby rotation whose angles are known, it takes three small rotations of these vectors.
 */

/** Writes x y z w to `out[o]`. Takes half angles, since only their sines and cosines are needed. */
export function quaternionOfEuler(
  halfAlpha: number,
  halfBeta: number,
  halfGamma: number,
  out: Float64Array,
  o: number,
): void {
  const sx = Math.sin(halfAlpha);
  const cx = Math.cos(halfAlpha);
  const sy = Math.sin(halfBeta);
  const cy = Math.cos(halfBeta);
  const sz = Math.sin(halfGamma);
  const cz = Math.cos(halfGamma);
  writeQuaternion(sx, cx, sy, cy, sz, cz, out, o);
}

/**
 * The quaternions of two sets of half angles, of one frame and the next; the same as two calls of `quaternionOfEuler`.
 * If the sets are close, the second's sines and cosines are derived from the first's by a four-term series, which takes
 * half the time.
 *
 *     sin(α + δ) = sin α · cos δ + cos α · sin δ          cos(α + δ) = cos α · cos δ − sin α · sin δ
 */
export function quaternionsOfEulers(
  halfAlpha0: number,
  halfBeta0: number,
  halfGamma0: number,
  halfAlpha1: number,
  halfBeta1: number,
  halfGamma1: number,
  out0: Float64Array,
  out1: Float64Array,
): void {
  const a = halfAlpha1 - halfAlpha0;
  const b = halfBeta1 - halfBeta0;
  const c = halfGamma1 - halfGamma0;
  const isNear = a < SMALL && a > -SMALL && b < SMALL && b > -SMALL && c < SMALL && c > -SMALL;
  if (!isNear) {
    quaternionOfEuler(halfAlpha0, halfBeta0, halfGamma0, out0, 0);
    quaternionOfEuler(halfAlpha1, halfBeta1, halfGamma1, out1, 0);
    return;
  }
  const sx = Math.sin(halfAlpha0);
  const cx = Math.cos(halfAlpha0);
  const sy = Math.sin(halfBeta0);
  const cy = Math.cos(halfBeta0);
  const sz = Math.sin(halfGamma0);
  const cz = Math.cos(halfGamma0);
  writeQuaternion(sx, cx, sy, cy, sz, cz, out0, 0);
  const sa = smallSine(a);
  const ca = smallCosine(a);
  const sb = smallSine(b);
  const cb = smallCosine(b);
  const sc = smallSine(c);
  const cc = smallCosine(c);
  writeQuaternion(
    sx * ca + cx * sa,
    cx * ca - sx * sa,
    sy * cb + cy * sb,
    cy * cb - sy * sb,
    sz * cc + cz * sc,
    cz * cc - sz * sc,
    out1,
    0,
  );
}

function writeQuaternion(
  sx: number,
  cx: number,
  sy: number,
  cy: number,
  sz: number,
  cz: number,
  out: Float64Array,
  o: number,
): void {
  out[o] = sx * cy * cz - cx * sy * sz;
  out[o + 1] = cx * sy * cz + sx * cy * sz;
  out[o + 2] = cx * cy * sz - sx * sy * cz;
  out[o + 3] = cx * cy * cz + sx * sy * sz;
}

/** Below this length, one of the two vectors above has no usable direction: gimbal lock. */
const LOCKED = 1e-12;

const TURN = 2 * Math.PI;

/**
 * Replaces the three angles at `angles[o]` by the nearest ones that give the unit quaternion at `q[qo]`. Each rotation
 * has two sets of angles, (α, β, γ) and (α + 180°, 180° − β, γ + 180°), each up to whole turns. In gimbal lock the
 * rotation determines only one of γ + α and γ − α; the other is kept.
 */
export function eulerNear(q: Float64Array, angles: Float64Array, o: number, qo = 0): void {
  const x = q[qo];
  const y = q[qo + 1];
  const z = q[qo + 2];
  const w = q[qo + 3];
  const alpha0 = angles[o];
  const beta0 = angles[o + 1];
  const gamma0 = angles[o + 2];
  const ofSum = Math.sqrt((w - y) * (w - y) + (x + z) * (x + z));
  const ofDifference = Math.sqrt((w + y) * (w + y) + (z - x) * (z - x));
  let sum = Math.atan2(x + z, w - y);
  let difference = Math.atan2(z - x, w + y);
  const isSumFree = ofSum < LOCKED;
  if (isSumFree || ofDifference < LOCKED) {
    // Half a turn of the determined one is a whole turn of both angles together.
    if (isSumFree) {
      sum = (gamma0 + alpha0) / 2;
      difference += Math.PI * Math.round(((gamma0 - alpha0) / 2 - difference) / Math.PI);
    } else {
      difference = (gamma0 - alpha0) / 2;
      sum += Math.PI * Math.round(((gamma0 + alpha0) / 2 - sum) / Math.PI);
    }
    angles[o] = sum - difference;
    angles[o + 1] = turnedNear(isSumFree ? Math.PI / 2 : -Math.PI / 2, beta0);
    angles[o + 2] = sum + difference;
    return;
  }
  const alpha = turnedNear(sum - difference, alpha0);
  const beta = turnedNear(2 * Math.atan2(ofDifference, ofSum) - Math.PI / 2, beta0);
  const gamma = turnedNear(sum + difference, gamma0);
  const a = Math.abs(alpha - alpha0);
  const b = Math.abs(beta - beta0);
  const c = Math.abs(gamma - gamma0);
  angles[o] = alpha;
  angles[o + 1] = beta;
  angles[o + 2] = gamma;
  // The other set's outer angles are π − a and π − c away: if b² < 2π·(π − a − c) it can't be nearer.
  if (b * b < TURN * (Math.PI - a - c)) return;
  const otherBeta = turnedNear(Math.PI - beta, beta0);
  const d = Math.abs(otherBeta - beta0);
  if (d * d + TURN * (Math.PI - a - c) >= b * b) return;
  angles[o] = turnedNear(alpha + Math.PI, alpha0);
  angles[o + 1] = otherBeta;
  angles[o + 2] = turnedNear(gamma + Math.PI, gamma0);
}

/**
 * If the three angles at `angles[o]` are those of the quaternion p at `from[fo]` and the one at `q[qo]` is close to p,
 * updates them to those of q by small changes. Otherwise returns false and changes nothing; then use `eulerNear`, which
 * takes three times as long. Neither quaternion has to be normalised.
 */
export function turnEuler(
  from: Float64Array,
  fo: number,
  q: Float64Array,
  qo: number,
  angles: Float64Array,
  o: number,
): boolean {
  // Sine and cosine of half the sum and half the difference, times the lengths of the vectors.
  const s0 = from[fo] + from[fo + 2];
  const c0 = from[fo + 3] - from[fo + 1];
  const d0 = from[fo + 2] - from[fo];
  const e0 = from[fo + 3] + from[fo + 1];
  const s1 = q[qo] + q[qo + 2];
  const c1 = q[qo + 3] - q[qo + 1];
  const d1 = q[qo + 2] - q[qo];
  const e1 = q[qo + 3] + q[qo + 1];
  const sumCosine = c0 * c1 + s0 * s1;
  const sum = (c0 * s1 - s0 * c1) / sumCosine;
  const differenceCosine = e0 * e1 + d0 * d1;
  const difference = (e0 * d1 - d0 * e1) / differenceCosine;
  const sumLength0 = c0 * c0 + s0 * s0;
  const sumLength1 = c1 * c1 + s1 * s1;
  const differenceLength0 = e0 * e0 + d0 * d0;
  const differenceLength1 = e1 * e1 + d1 * d1;
  // Cosine and sine of β, times the squared length of the quaternion.
  const cosine0 = 2 * Math.sqrt(sumLength0 * differenceLength0);
  const sine0 = differenceLength0 - sumLength0;
  const cosine1 = 2 * Math.sqrt(sumLength1 * differenceLength1);
  const sine1 = differenceLength1 - sumLength1;
  const lengths = (sumLength0 + differenceLength0) * (sumLength1 + differenceLength1);
  const beta = (cosine0 * sine1 - sine0 * cosine1) / (lengths + cosine0 * cosine1 + sine0 * sine1);
  // Written so that NaN counts as far. Both cosines are negative if the quaternions have opposite signs. Close to
  // β = ±90° there is hardly a direction.
  const isClose =
    sumCosine * differenceCosine > 0 &&
    sumLength0 > BESIDE_LOCK &&
    differenceLength0 > BESIDE_LOCK &&
    sumLength1 > BESIDE_LOCK &&
    differenceLength1 > BESIDE_LOCK &&
    Math.abs(sum) < CLOSE &&
    Math.abs(difference) < CLOSE &&
    Math.abs(beta) < CLOSE;
  if (!isClose) return false;
  const halfSum = arcTangent(sum);
  const halfDifference = arcTangent(difference);
  const turned = 2 * arcTangent(beta);
  angles[o] += halfSum - halfDifference;
  // Beyond ±90°, up to ±270°, the cosine of β is negative, and so on.
  angles[o + 1] += Math.round(angles[o + 1] / Math.PI) & 1 ? -turned : turned;
  angles[o + 2] += halfSum + halfDifference;
  return true;
}

const SMALL = 0.1;
/** Tangents of a quarter of a turn of an angle: up to it, no other angles of the same rotation are nearer. */
const CLOSE = 0.4;
/** Squared length of a vector one degree from gimbal lock. */
const BESIDE_LOCK = 1e-4;

/**
 * Exact to 1e-16; up to `SMALL` by the polynomial that is nearest to it there, arranged to shorten chains of dependent
 * operations: a tenth of the time of `Math.atan2`.
 */
function arcTangent(x: number): number {
  const s = x * x;
  if (s > SMALL * SMALL) return Math.atan(x);
  const t = s * s;
  const tail = -0.14285708398092528 + s * 0.11109459259903585 - t * 0.08901277908754404;
  return x + x * s * (-0.3333333333333186 + s * 0.1999999999264716 + t * tail);
}

/** Exact to 1e-16 up to `SMALL`. */
function smallSine(x: number): number {
  const s = x * x;
  return x * (1 - s * (1 / 6) * (1 - s * (1 / 20) * (1 - s * (1 / 42) * (1 - s * (1 / 72)))));
}

/** Exact to 1e-16 up to `SMALL`. */
function smallCosine(x: number): number {
  const s = x * x;
  return 1 - s * (1 / 2) * (1 - s * (1 / 12) * (1 - s * (1 / 30) * (1 - s * (1 / 56))));
}

/**
 * Adds whole turns to an angle to bring it nearest to another; adding none returns the same number (except −0, which
 * becomes 0).
 */
export function turnedNear(angle: number, near: number): number {
  return angle + TURN * Math.round((near - angle) / TURN);
}
