/** Rotations on a curve of quaternions, at and between its keys. */
import { slerp } from '../math/slerp.ts';
import type { QuaternionTrack } from '../model/takes/tracked-take.ts';

/** A track in doubles, with columns of its own for slopes. */
export interface QuaternionCurve {
  readonly times: Float64Array;
  /** x y z w per key, of any length. */
  readonly values: Float64Array;
  readonly interpolation: QuaternionTrack['interpolation'];
  /** Slopes of `cubic`: x y z w per key, per second. */
  readonly slopesIn?: Float64Array;
  readonly slopesOut?: Float64Array;
}

/** The curve of a track. */
export function curveOf({ times, values, interpolation }: QuaternionTrack): QuaternionCurve {
  if (interpolation !== 'cubic') return { times, values: new Float64Array(values), interpolation };
  const part = (p: number) => {
    const out = new Float64Array(4 * times.length);
    for (let i = 0; i < out.length; i++) out[i] = values[(3 * (i >> 2) + p) * 4 + (i & 3)];
    return out;
  };
  return { times, interpolation, values: part(1), slopesIn: part(0), slopesOut: part(2) };
}

const from = new Float64Array(4);
const to = new Float64Array(4);

/** Scratch: unit quaternions of the keys of one curve, 4 each. A curve is asked for again and again before another. */
let units = new Float64Array(256);
let unitsAreOf: QuaternionCurve | undefined;

function unitsOf(curve: QuaternionCurve): Float64Array {
  if (curve === unitsAreOf) return units;
  const { values } = curve;
  if (units.length < values.length) units = new Float64Array(2 * values.length);
  for (let o = 0; o < values.length; o += 4) {
    for (let k = 0; k < 4; k++) from[k] = values[o + k];
    normalize(from);
    for (let k = 0; k < 4; k++) units[o + k] = from[k];
  }
  unitsAreOf = curve;
  return units;
}

/** Unit quaternions at the keys of a curve and halfway between them, 4 each. */
export function visited(curve: QuaternionCurve): Float64Array {
  const out = new Float64Array(4 * (2 * curve.times.length - 1));
  const q = new Float64Array(4);
  for (let i = 0; 4 * i < out.length; i++) {
    rotationWithin(curve, i >> 1, (i & 1) / 2, q);
    for (let k = 0; k < 4; k++) out[4 * i + k] = q[k];
  }
  return out;
}

/** The rotation of a curve between two of its keys. @param part 0 to 1 */
export function rotationWithin(curve: QuaternionCurve, key: number, part: number, q: Float64Array): void {
  const { times, values, interpolation, slopesIn: ins, slopesOut: outs } = curve;
  const [a, b] = [4 * key, 4 * Math.min(key + 1, times.length - 1)];
  if (interpolation === 'step' || a === b || part === 0) {
    const own = unitsOf(curve);
    for (let k = 0; k < 4; k++) q[k] = own[a + k];
    return;
  }
  if (interpolation === 'linear' || !ins || !outs) {
    const own = unitsOf(curve);
    for (let k = 0; k < 4; k++) {
      from[k] = own[a + k];
      to[k] = own[b + k];
    }
    slerp(from, to, part, q);
  } else {
    const seconds = times[key + 1] - times[key];
    for (let k = 0; k < 4; k++) {
      q[k] = hermite(values[a + k], values[b + k], seconds * outs[a + k], seconds * ins[b + k], part);
    }
  }
  normalize(q);
}

/** The same; `part` may be 1. */
export function rotationAt(curve: QuaternionCurve, key: number, part: number, q: Float64Array): void {
  if (part === 1) rotationWithin(curve, key + 1, 0, q);
  else rotationWithin(curve, key, part, q);
}

/** Makes a quaternion of any length one of length 1. */
export function normalize(q: Float64Array): void {
  const length = lengthOf(q);
  if (length > 0) for (let k = 0; k < 4; k++) q[k] /= length;
  else {
    q[0] = q[1] = q[2] = 0;
    q[3] = 1;
  }
}

/** As `Math.hypot` has it, which takes ten times as long for four numbers. */
function lengthOf(q: Float64Array): number {
  const most = Math.max(Math.abs(q[0]), Math.abs(q[1]), Math.abs(q[2]), Math.abs(q[3]));
  if (!(most > 0 && most < Infinity)) return most;
  let sum = 0;
  let lost = 0;
  for (let k = 0; k < 4; k++) {
    const part = q[k] / most;
    const added = part * part - lost;
    const next = sum + added;
    lost = next - sum - added;
    sum = next;
  }
  return Math.sqrt(sum) * most;
}

/** A cubic from p to q, with the slopes there per `t` from 0 to 1. */
export function hermite(p: number, q: number, slopeP: number, slopeQ: number, t: number): number {
  const u = 1 - t;
  return p * u * u * (1 + 2 * t) + q * t * t * (3 - 2 * t) + slopeP * t * u * u - slopeQ * t * t * u;
}
