/**
 * The fewest keys for a stretch of curve: the greedy algorithm of *simplify*.
 *
 * From each kept key, it searches for the farthest key that one cubic can reach within tolerance, and continues from
 * there. Kept keys keep their time and value, so the only unknown of each is its slope. The error of a cubic grows with
 * the fourth power of its length if its slopes are right, and with the third if not: good slopes keep the number of
 * keys low. For each key these are tried, and the farthest wins:
 *
 * 1. its own slope, if both its tangents agree: hand-made shapes are kept;
 * 2. the slope of a least-squares cubic through the values around it, over a narrow and a wide window: curves sampled
 * frame by frame are noisy, with meaningless `linear` tangents;
 * 3. for a key with broken tangents, as a last resort, an independent slope on either side.
 *
 * Each length is measured (`reaches`), never estimated, by doubling and then bisection, so that n keys take about
 * n·log(length) steps. (Schneider's fitting, *Graphics Gems* 1990, splits a curve where the error is largest: half of
 * the pieces are then shorter than necessary. It is also free to choose the length of tangents, unlike a function of
 * time.)
 */
import { placeOfLargest } from './difference.ts';

/** The curve to fit, with its resolved slopes. */
export interface Curve {
  readonly times: Float64Array;
  readonly values: Float64Array;
  /** Four per key, as in the evaluator. */
  readonly cubics: Float64Array;
  readonly slopesIn: Float64Array;
  readonly slopesOut: Float64Array;
  readonly tolerance: number;
}

/** The keys that are kept. */
export interface Knots {
  /** Indices of the curve's keys. */
  readonly indices: number[];
  readonly slopesIn: number[];
  readonly slopesOut: number[];
}

/** A slope to be chosen freely. */
export const FREE_SLOPE = Number.NaN;

/**
 * Appends the knots after key `lo` up to key `hi` to `knots`, whose last knot is `lo`; sets that one's out slope. Times
 * must be strictly ascending in between. `slopeOut` and `slopeIn` are those at the two ends, or FREE.
 */
export function fitStretch(curve: Curve, lo: number, hi: number, slopeOut: number, slopeIn: number, knots: Knots) {
  const walk = new Walk(curve, lo, hi, slopeIn);
  let out = slopeOut;
  for (let key = lo; key < hi; ) {
    walk.from(key, out);
    knots.slopesOut[knots.indices.length - 1] = walk.slopeOut;
    key = walk.end;
    knots.indices.push(key);
    knots.slopesIn.push(walk.slopeIn);
    out = walk.isBroken ? FREE_SLOPE : walk.slopeIn;
    knots.slopesOut.push(walk.slopeIn);
  }
}

class Walk {
  /** The span found: its end, and the slopes at both ends. */
  end = 0;
  slopeOut = 0;
  slopeIn = 0;
  /** Whether the key at its end has a different slope on the other side. */
  isBroken = false;

  private start = 0;
  private given = FREE_SLOPE;
  private length = 1;

  constructor(
    private readonly curve: Curve,
    private readonly lo: number,
    private readonly hi: number,
    private readonly lastSlope: number,
  ) {}

  /** The longest span from key `start`, leaving with the slope `given`, or a free one. */
  from(start: number, given: number): void {
    const { hi } = this;
    this.start = start;
    this.given = given;
    // Most spans are about as long as the previous one.
    let good = 0;
    let bad = hi - start + 1;
    let length = Math.min(this.length, hi - start);
    while (good === 0) {
      if (this.tries(length)) good = length;
      else if (length === 1) {
        this.leaves();
        good = 1;
      } else {
        bad = length;
        length >>>= 1;
      }
    }
    while (good + 1 < bad) {
      const next = Math.min(2 * good, bad === hi - start + 1 ? hi - start : (good + bad) >>> 1);
      if (this.tries(next)) good = next;
      else bad = next;
    }
    this.length = good;
  }

  /** Whether a cubic reaches that many keys ahead; if so, stores it. */
  private tries(length: number): boolean {
    const { curve, start, hi, lo } = this;
    const end = start + length;
    const isUnified = agrees(curve.slopesIn[end], curve.slopesOut[end]);
    if (end === hi) {
      const isFree = Number.isNaN(this.lastSlope);
      if (length === 1 && isFree && this.keeps(end, this.given, curve.slopesIn[end], false)) return true;
      return this.keeps(end, this.given, this.lastSlope, false);
    }
    if (isUnified && this.keeps(end, this.given, curve.slopesIn[end], false)) return true;
    const wide = Math.max(2, length >>> 1);
    if (this.keeps(end, this.given, slopeAround(curve, end, wide, lo, hi), true)) return true;
    const narrow = Math.max(2, length >>> 3);
    if (narrow < wide && this.keeps(end, this.given, slopeAround(curve, end, narrow, lo, hi), true)) return true;
    return false;
  }

  /** Advances by one key with its own slopes. */
  private leaves(): void {
    const { curve, start } = this;
    const end = start + 1;
    const wanted = end === this.hi && !Number.isNaN(this.lastSlope) ? this.lastSlope : curve.slopesIn[end];
    this.isBroken = end < this.hi && !agrees(curve.slopesIn[end], curve.slopesOut[end]);
    this.end = end;
    this.slopeIn = wanted;
    this.slopeOut = this.given;
    const isGiven = !Number.isNaN(this.given);
    if (isGiven && reaches(curve, start, end, this.given, wanted)) return;
    this.slopeOut = curve.slopesOut[start];
    if (!reaches(curve, start, end, this.slopeOut, wanted)) this.slopeIn = curve.slopesIn[end];
  }

  private keeps(end: number, slopeOut: number, slopeIn: number, looksAhead: boolean): boolean {
    const { curve, start } = this;
    if (Number.isNaN(slopeOut) && end === start + 1) slopeOut = curve.slopesOut[start];
    if (Number.isNaN(slopeOut) || Number.isNaN(slopeIn)) {
      leastSquares(curve, start, end, slopeOut, slopeIn);
      slopeOut = fitted[0];
      slopeIn = fitted[1];
    }
    if (!reaches(curve, start, end, slopeOut, slopeIn)) return false;
    // With a slope other than the key's own, the next span must still be possible.
    if (looksAhead) {
      const last = end + 1 === this.hi && !Number.isNaN(this.lastSlope);
      if (!reaches(curve, end, end + 1, slopeIn, last ? this.lastSlope : curve.slopesIn[end + 1])) return false;
    }
    this.end = end;
    this.slopeOut = slopeOut;
    this.slopeIn = slopeIn;
    this.isBroken = false;
    return true;
  }
}

/** Whether two slopes are equal up to rounding. */
export function agrees(a: number, b: number): boolean {
  return Math.abs(a - b) <= 1e-9 * Math.max(Math.abs(a), Math.abs(b));
}

/** Whether the cubic from key `i` to key `j` with these slopes is within tolerance of the curve everywhere. */
export function reaches(curve: Curve, i: number, j: number, slopeOut: number, slopeIn: number): boolean {
  const { times, values, cubics, tolerance } = curve;
  const start = times[i];
  const length = times[j] - start;
  const secant = (values[j] - values[i]) / length;
  const c = (3 * secant - 2 * slopeOut - slopeIn) / length;
  const d = (slopeOut + slopeIn - 2 * secant) / (length * length);
  for (let k = i; k < j; k++) {
    const s = times[k] - start;
    const h = times[k + 1] - times[k];
    const o = 4 * k;
    const d0 = ((d * s + c) * s + slopeOut) * s + values[i] - cubics[o];
    const d1 = (3 * d * s + 2 * c) * s + slopeOut - cubics[o + 1];
    const d2 = 3 * d * s + c - cubics[o + 2];
    const d3 = d - cubics[o + 3];
    const end = ((d3 * h + d2) * h + d1) * h + d0;
    if (!(Math.abs(d0) <= tolerance && Math.abs(end) <= tolerance)) return false;
    // A cubic lies within the hull of its Bézier points.
    const p1 = Math.abs(d0 + (d1 * h) / 3);
    const p2 = Math.abs(d0 + (2 * d1 * h + d2 * h * h) / 3);
    if (p1 <= tolerance && p2 <= tolerance) continue;
    const t = placeOfLargest(d0, d1, d2, d3, h);
    if (!(Math.abs(((d3 * t + d2) * t + d1) * t + d0) <= tolerance)) return false;
  }
  return true;
}

/** Gauss–Legendre points in 0 … 1 and their weights: four are exact for these squares. */
const POINTS = [0.0694318442029737, 0.330009478207572, 0.669990521792428, 0.930568155797026];
const WEIGHTS = [0.173927422568727, 0.326072577431273, 0.326072577431273, 0.173927422568727];

const fitted = new Float64Array(2);

/**
 * Chooses the free ones of two slopes so that the cubic from key `i` to key `j` has the least square error; written to
 * `fitted`.
 *
 *     cubic(u) = v_i·h00 + v_j·h01 + T·(m_i·h10 + m_j·h11)        u = 0 … 1 over T seconds
 */
function leastSquares(curve: Curve, i: number, j: number, slopeOut: number, slopeIn: number): void {
  const { times, values, cubics } = curve;
  const start = times[i];
  const length = times[j] - start;
  let a = 0;
  let b = 0;
  let c = 0;
  let p = 0;
  let q = 0;
  for (let k = i; k < j; k++) {
    const h = times[k + 1] - times[k];
    const o = 4 * k;
    for (let g = 0; g < POINTS.length; g++) {
      const t = POINTS[g] * h;
      const u = (times[k] - start + t) / length;
      const w = WEIGHTS[g] * h;
      const h01 = u * u * (3 - 2 * u);
      const h10 = length * u * (1 - u) * (1 - u);
      const h11 = length * u * u * (u - 1);
      const curveAt = ((cubics[o + 3] * t + cubics[o + 2]) * t + cubics[o + 1]) * t + cubics[o];
      const left = curveAt - values[i] * (1 - h01) - values[j] * h01;
      a += w * h10 * h10;
      b += w * h10 * h11;
      c += w * h11 * h11;
      p += w * left * h10;
      q += w * left * h11;
    }
  }
  if (!Number.isNaN(slopeOut)) {
    fitted[0] = slopeOut;
    fitted[1] = (q - b * slopeOut) / c;
  } else if (!Number.isNaN(slopeIn)) {
    fitted[0] = (p - b * slopeIn) / a;
    fitted[1] = slopeIn;
  } else {
    const determinant = a * c - b * b;
    fitted[0] = (p * c - q * b) / determinant;
    fitted[1] = (a * q - b * p) / determinant;
  }
}

/** Sums of powers of time, and of values times them; then the rows for elimination. */
const rows = new Float64Array(4 * 5);
const powers = new Float64Array(7);

/**
 * Slope at key `k` of the least-squares cubic through the keys around it, up to `width` on either side within `lo` and
 * `hi`; of lower degree if there are too few.
 */
function slopeAround({ times, values }: Curve, k: number, width: number, lo: number, hi: number): number {
  const from = Math.max(lo, k - width);
  const to = Math.min(hi, k + width);
  const unknowns = Math.min(4, to - from + 1);
  const scale = Math.max(times[to] - times[k], times[k] - times[from]);
  powers.fill(0);
  rows.fill(0);
  for (let i = from; i <= to; i++) {
    const x = (times[i] - times[k]) / scale;
    const y = values[i] - values[k];
    let power = 1;
    for (let n = 0; n < 2 * unknowns - 1; n++) {
      powers[n] += power;
      if (n < unknowns) rows[5 * n + 4] += power * y;
      power *= x;
    }
  }
  for (let r = 0; r < unknowns; r++) for (let n = 0; n < unknowns; n++) rows[5 * r + n] = powers[r + n];
  // Symmetric and positive definite: no pivoting needed.
  for (let r = 0; r < unknowns; r++) {
    for (let below = r + 1; below < unknowns; below++) {
      const factor = rows[5 * below + r] / rows[5 * r + r];
      for (let n = r; n < unknowns; n++) rows[5 * below + n] -= factor * rows[5 * r + n];
      rows[5 * below + 4] -= factor * rows[5 * r + 4];
    }
  }
  for (let r = unknowns - 1; r >= 1; r--) {
    for (let n = r + 1; n < unknowns; n++) rows[5 * r + 4] -= rows[5 * r + n] * rows[5 * n + 4];
    rows[5 * r + 4] /= rows[5 * r + r];
  }
  return rows[5 + 4] / scale;
}
