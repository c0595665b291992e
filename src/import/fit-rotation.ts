/**
 * Fits channels of a joint's rotation, Euler angles or the four numbers of a quaternion, to a curve of quaternions.
 *
 * Each key of the curve becomes a key with its exact rotation. Between two keys the channels are linear if that is
 * within the tolerance, else Hermite cubics with the slopes that the curve has at its ends, which is off by the fourth
 * power of the rotation in between; where that is still too far, a key is added halfway, and so on.
 */

import { writeAnglesNear, writeQuaternion } from '../evaluate/rotations/euler-orders.ts';
import type { EulerOrder } from '../model/skeleton/skeleton.ts';
import { type Channel, NO_EXTRAPOLATION, restChannel } from '../model/takes/take.ts';
import { FIXED_TANGENT, LINEAR } from '../model/takes/tangent-kinds.ts';
import type { RotationForm, TrackedRotation } from '../model/takes/tracked-take.ts';
import { curveOf, hermite, normalize, type QuaternionCurve, rotationAt, rotationWithin } from './quaternion-curve.ts';

/**
 * Radians. A fiftieth of a 2000th: along a chain of as many joints the sum stays within a 2000th of the size.
 */
const TOLERANCE = 1e-5;
/** Halvings of the time between two keys: cubics of quaternions that pass near 0 turn in a moment. */
const MAX_HALVINGS = 16;
/** Fitted keys of a curve for each of its own; what it needs beyond is spare. */
const MAX_PER_KEY = 8;

/** Fitted keys that the curves of a character may need beyond the usual, in all of its takes together. */
export const SPARE_KEYS = 20_000;

/** Fitted keys that the curves of a take may still need beyond the usual. */
export class SpareKeys {
  constructor(public left: number) {}
}
/** Fraction of that time, for slopes. */
const STEP = 1e-3;

/** How a joint's DOFs say a rotation. */
export interface RotationDofs {
  readonly count: number;
  /** Writes the DOFs of a unit quaternion that are nearest to those in `dofs`. */
  write(q: Float64Array, dofs: Float64Array): void;
  /** Writes the unit quaternion of the DOFs. */
  read(dofs: Float64Array, q: Float64Array): void;
}

/** Angles about x, y and z. */
function eulerRotation(order: EulerOrder): RotationDofs {
  return {
    count: 3,
    write: (q, dofs) => writeAnglesNear(order, q, dofs),
    read: (dofs, q) => writeQuaternion(order, dofs, q),
  };
}

/** The rotation of a quaternion joint: four DOFs, with the sign nearer to those before. */
const QUATERNION_ROTATION: RotationDofs = {
  count: 4,
  write(q, dofs) {
    const sign = q[0] * dofs[0] + q[1] * dofs[1] + q[2] * dofs[2] + q[3] * dofs[3] < 0 ? -1 : 1;
    for (let k = 0; k < 4; k++) dofs[k] = sign * q[k];
  },
  read(dofs, q) {
    for (let k = 0; k < 4; k++) q[k] = dofs[k];
    normalize(q);
  },
};

/** Keys of all DOFs, in columns that grow. */
class FittedKeys {
  count = 0;
  times = new Float64Array(64);
  /** For each key, of every DOF. */
  values: Float64Array;
  slopesIn: Float64Array;
  slopesOut: Float64Array;
  /** 1 for a side with slopes; the others are linear. */
  hasIn = new Uint8Array(64);
  hasOut = new Uint8Array(64);

  constructor(private readonly width: number) {
    this.values = new Float64Array(64 * width);
    this.slopesIn = new Float64Array(64 * width);
    this.slopesOut = new Float64Array(64 * width);
  }

  add(time: number, values: Float64Array): void {
    if (this.count === this.times.length) this.grow();
    const { width } = this;
    const at = this.count++;
    this.times[at] = time;
    this.hasIn[at] = this.hasOut[at] = 0;
    for (let d = 0; d < width; d++) {
      this.values[at * width + d] = values[d];
      this.slopesIn[at * width + d] = this.slopesOut[at * width + d] = 0;
    }
  }

  /** Writes the values of the last key. */
  last(out: Float64Array): void {
    const { width } = this;
    const o = (this.count - 1) * width;
    for (let d = 0; d < width; d++) out[d] = this.values[o + d];
  }

  private grow(): void {
    this.times = doubled(this.times);
    this.hasIn = doubled(this.hasIn);
    this.hasOut = doubled(this.hasOut);
    this.values = doubled(this.values);
    this.slopesIn = doubled(this.slopesIn);
    this.slopesOut = doubled(this.slopesOut);
  }

  channels(): readonly Channel[] {
    const { count } = this;
    const [kindsIn, kindsOut] = [this.hasIn, this.hasOut].map((has) =>
      has.slice(0, count).map((own) => (own ? FIXED_TANGENT : LINEAR)),
    );
    const isLinear = [kindsIn, kindsOut].every((kinds) => !kinds.includes(FIXED_TANGENT));
    const times = this.times.slice(0, count);
    return Array.from({ length: this.width }, (_, d): Channel => {
      const values = this.column(this.values, d);
      if (isLinear && values.every((value) => value === values[0])) return restChannel(values[0]);
      return {
        kind: 'keys',
        ...NO_EXTRAPOLATION,
        times,
        values,
        tangentsIn: { kinds: kindsIn, slopes: this.column(this.slopesIn, d) },
        tangentsOut: { kinds: kindsOut, slopes: this.column(this.slopesOut, d) },
      };
    });
  }

  private column(rows: Float64Array, d: number): Float64Array {
    const { width } = this;
    const out = new Float64Array(this.count);
    for (let k = 0; k < out.length; k++) out[k] = rows[k * width + d];
    return out;
  }
}

function doubled<A extends Float64Array | Uint8Array>(column: A): A {
  // A column of the same type, which TypeScript can't tell.
  const grown = new (column.constructor as new (length: number) => A)(2 * column.length);
  grown.set(column);
  return grown;
}

/** Scratch, by the number of DOFs. */
const THREE = new FittedKeys(3);
const FOUR = new FittedKeys(4);

/** The DOFs of a form. */
export function rotationDofs(form: RotationForm): RotationDofs {
  return form === 'xyzw' ? QUATERNION_ROTATION : eulerRotation(form);
}

/**
 * Channels for the DOFs of a rotation.
 * @param spare less by what this curve takes of it; where it runs out, fitted keys are further apart
 */
export function fitRotation({ track, form, rest }: TrackedRotation, spare: SpareKeys): readonly Channel[] {
  const curve = curveOf(track);
  const dofs = rotationDofs(form);
  const usual = MAX_PER_KEY * curve.times.length;
  const most = usual + spare.left;
  const keys = dofs.count === 4 ? FOUR : THREE;
  keys.count = 0;
  now.set(rest);
  rotationWithin(curve, 0, 0, exact);
  dofs.write(exact, now);
  keys.add(curve.times[0], now);
  for (let k = 0; k + 1 < curve.times.length; k++) {
    if (curve.interpolation === 'step') {
      keys.add(curve.times[k + 1], now);
      rotationWithin(curve, k + 1, 0, exact);
      dofs.write(exact, now);
      keys.add(curve.times[k + 1], now);
    } else fitBetween(curve, k, 0, 1, dofs, keys, 0, most);
  }
  spare.left -= Math.max(0, Math.min(keys.count, most) - usual);
  return keys.channels();
}

/** DOFs of the last key of a stepped curve. */
const now = new Float64Array(4);
const exact = new Float64Array(4);
const fitted = new Float64Array(4);
/** Rotations at the eighths of what is fitted, from the first to the last, and DOFs at its ends. */
const EIGHTHS = 8;
const eighths = Array.from({ length: EIGHTHS }, () => new Float64Array(4));
const before = new Float64Array(4);
const after = new Float64Array(4);
const slopesOut = new Float64Array(4);
const slopesIn = new Float64Array(4);

/** Adds the key at the end of a part of the time between two keys, and those needed before it. */
function fitBetween(
  curve: QuaternionCurve,
  key: number,
  start: number,
  end: number,
  dofs: RotationDofs,
  keys: FittedKeys,
  halvings: number,
  most: number,
): void {
  const { times } = curve;
  const { count: width } = dofs;
  const seconds = times[key + 1] - times[key];
  const part = end - start;
  for (let n = 1; n <= EIGHTHS; n++) rotationAt(curve, key, start + (part * n) / EIGHTHS, eighths[n - 1]);
  keys.last(before);
  keys.last(after);
  // In a few steps: the nearest angles of the far end may be others than those on the way.
  for (let n = 1; n < EIGHTHS; n += 2) dofs.write(eighths[n], after);
  const time = end === 1 ? times[key + 1] : times[key] + seconds * end;
  const isTooFast = seconds <= 0 || halvings >= MAX_HALVINGS || keys.count >= most;
  if (isTooFast || isWithin(dofs, false)) {
    let jump = 0;
    for (let d = 0; d < width; d++) jump = Math.max(jump, Math.abs(after[d] - before[d]));
    // Past gimbal lock angles jump, while the rotation hardly changes.
    if (isTooFast && jump > 0.1) keys.add(time, before);
    keys.add(time, after);
    return;
  }
  writeSlopes(curve, key, start, part * STEP, seconds, dofs, before, slopesOut);
  writeSlopes(curve, key, end, -part * STEP, seconds, dofs, after, slopesIn);
  const span = part * seconds;
  for (let d = 0; d < width; d++) {
    tangentOut[d] = slopesOut[d] * span;
    tangentIn[d] = slopesIn[d] * span;
  }
  if (isWithin(dofs, true)) {
    const from = keys.count - 1;
    keys.hasOut[from] = 1;
    for (let d = 0; d < width; d++) keys.slopesOut[from * width + d] = slopesOut[d];
    keys.add(time, after);
    keys.hasIn[from + 1] = 1;
    for (let d = 0; d < width; d++) keys.slopesIn[(from + 1) * width + d] = slopesIn[d];
    return;
  }
  const middle = (start + end) / 2;
  fitBetween(curve, key, start, middle, dofs, keys, halvings + 1, most);
  fitBetween(curve, key, middle, end, dofs, keys, halvings + 1, most);
}

const one = new Float64Array(4);
const two = new Float64Array(4);

/** Per second, one-sided: the curve may have a corner at its keys. */
function writeSlopes(
  curve: QuaternionCurve,
  key: number,
  part: number,
  step: number,
  seconds: number,
  dofs: RotationDofs,
  here: Float64Array,
  out: Float64Array,
): void {
  const { count } = dofs;
  rotationAt(curve, key, part + step, exact);
  for (let d = 0; d < count; d++) one[d] = here[d];
  dofs.write(exact, one);
  rotationAt(curve, key, part + 2 * step, exact);
  for (let d = 0; d < count; d++) two[d] = one[d];
  dofs.write(exact, two);
  for (let d = 0; d < count; d++) out[d] = (4 * one[d] - two[d] - 3 * here[d]) / (2 * step * seconds);
}

/** Slopes at both ends of what is fitted, per part. */
const tangentOut = new Float64Array(4);
const tangentIn = new Float64Array(4);

/** Whether channels between the DOFs `before` and `after` keep to the rotations at the eighths. */
function isWithin(dofs: RotationDofs, isCubic: boolean): boolean {
  for (let n = 1; n < EIGHTHS; n++) {
    const t = n / EIGHTHS;
    for (let d = 0; d < dofs.count; d++) {
      one[d] = isCubic
        ? hermite(before[d], after[d], tangentOut[d], tangentIn[d], t)
        : before[d] + t * (after[d] - before[d]);
    }
    dofs.read(one, fitted);
    const own = eighths[n - 1];
    const sign = own[0] * fitted[0] + own[1] * fitted[1] + own[2] * fitted[2] + own[3] * fitted[3] < 0 ? -1 : 1;
    let chord = 0;
    for (let k = 0; k < 4; k++) {
      const apart = own[k] - sign * fitted[k];
      chord += apart * apart;
    }
    // The chord between unit quaternions is half the angle.
    if (!(4 * chord <= TOLERANCE * TOLERANCE)) return false;
  }
  return true;
}
