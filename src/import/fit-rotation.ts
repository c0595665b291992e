/**
 * Fits channels of a joint's rotation, Euler angles or the four numbers of a quaternion, to a curve of quaternions.
 *
 * Each key of the curve becomes a key with its exact rotation. Between two keys the channels are linear if that is
 * within the tolerance, else Hermite cubics with the slopes that the curve has at its ends, which is off by the fourth
 * power of the rotation in between; where that is still too far, a key is added halfway, and so on.
 */
import { slerp } from '../math/slerp.ts';
import type { EulerOrder } from '../model/skeleton/skeleton.ts';
import { type Channel, FIXED_TANGENT, LINEAR, restChannel } from '../model/takes/clip.ts';
import { writeAnglesNear, writeQuaternion } from './rotations.ts';
import type { QuaternionCurve } from './scene.ts';

/**
 * Radians. A fiftieth of a 2000th: along a chain of as many joints the sum stays within a 2000th of the size.
 */
const TOLERANCE = 1e-5;
/** Halvings of the time between two keys: cubics of quaternions that pass near 0 turn in a moment. */
const MAX_HALVINGS = 16;
/** Fitted keys of a curve for each of its own; what it needs beyond is spare. */
const MAX_PER_KEY = 8;

/** Fitted keys that the curves of a character may need beyond the usual, together. */
export class SpareKeys {
  left = 20_000;
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
export function eulerRotation(order: EulerOrder): RotationDofs {
  return {
    count: 3,
    write: (q, dofs) => writeAnglesNear(order, q, dofs),
    read: (dofs, q) => writeQuaternion(order, dofs, q),
  };
}

/** The rotation of a quaternion joint: four DOFs, with the sign nearer to those before. */
export const QUATERNION_ROTATION: RotationDofs = {
  count: 4,
  write(q, dofs) {
    const sign = q[0] * dofs[0] + q[1] * dofs[1] + q[2] * dofs[2] + q[3] * dofs[3] < 0 ? -1 : 1;
    for (let k = 0; k < 4; k++) dofs[k] = sign * q[k];
  },
  read(dofs, q) {
    q.set(dofs);
    normalize(q);
  },
};

/** The rotation of a curve between two of its keys. @param part 0 to 1 */
export function rotationWithin(curve: QuaternionCurve, key: number, part: number, q: Float64Array): void {
  const { times, values, interpolation, slopesIn, slopesOut } = curve;
  const [a, b] = [4 * key, 4 * Math.min(key + 1, times.length - 1)];
  if (interpolation === 'step' || a === b || part === 0) q.set(values.subarray(a, a + 4));
  else if (interpolation === 'linear' || !slopesIn || !slopesOut) {
    from.set(values.subarray(a, a + 4));
    to.set(values.subarray(b, b + 4));
    normalize(from);
    normalize(to);
    slerp(from, to, part, q);
  } else {
    const seconds = times[key + 1] - times[key];
    for (let k = 0; k < 4; k++) {
      q[k] = hermite(values[a + k], values[b + k], seconds * slopesOut[a + k], seconds * slopesIn[b + k], part);
    }
  }
  normalize(q);
}

const from = new Float64Array(4);
const to = new Float64Array(4);

function normalize(q: Float64Array): void {
  const length = Math.hypot(q[0], q[1], q[2], q[3]);
  if (length > 0) for (let k = 0; k < 4; k++) q[k] /= length;
  else q.set([0, 0, 0, 1]);
}

function hermite(p: number, q: number, slopeP: number, slopeQ: number, t: number): number {
  const u = 1 - t;
  return p * u * u * (1 + 2 * t) + q * t * t * (3 - 2 * t) + slopeP * t * u * u - slopeQ * t * t * u;
}

/** A key of all DOFs. */
interface FittedKey {
  readonly time: number;
  readonly values: Float64Array;
  /** Absent: linear. */
  slopesIn: Float64Array | undefined;
  slopesOut: Float64Array | undefined;
}

/**
 * Channels for the DOFs.
 * @param rest DOFs to be near to at the first key
 * @param spare less by what this curve takes of it; where it runs out, fitted keys are further apart
 */
export function fitRotation(
  curve: QuaternionCurve,
  dofs: RotationDofs,
  rest: Float64Array,
  spare: SpareKeys,
): readonly Channel[] {
  const usual = MAX_PER_KEY * curve.times.length;
  const most = usual + spare.left;
  const keys: FittedKey[] = [];
  const now = rest.slice();
  const q = new Float64Array(4);
  const add = (time: number) => {
    const key: FittedKey = { time, values: now.slice(), slopesIn: undefined, slopesOut: undefined };
    keys.push(key);
    return key;
  };
  rotationWithin(curve, 0, 0, q);
  dofs.write(q, now);
  add(curve.times[0]);
  for (let k = 0; k + 1 < curve.times.length; k++) {
    if (curve.interpolation === 'step') {
      add(curve.times[k + 1]);
      rotationWithin(curve, k + 1, 0, q);
      dofs.write(q, now);
      add(curve.times[k + 1]);
    } else fitBetween(curve, k, 0, 1, dofs, keys, now, 0, most);
  }
  spare.left -= Math.max(0, Math.min(keys.length, most) - usual);
  return Array.from({ length: dofs.count }, (_, d) => channelOf(keys, d));
}

const exact = new Float64Array(4);
const fitted = new Float64Array(4);

/** Adds the key at the end of a part of the time between two keys, and those needed before it. */
function fitBetween(
  curve: QuaternionCurve,
  key: number,
  start: number,
  end: number,
  dofs: RotationDofs,
  keys: FittedKey[],
  now: Float64Array,
  halvings: number,
  most: number,
): void {
  const before = keys[keys.length - 1];
  const { times } = curve;
  const seconds = times[key + 1] - times[key];
  const after = before.values.slice();
  // In a few steps: the nearest angles of the far end may be others than those on the way.
  for (let n = 1; n <= 4; n++) {
    at(curve, key, start + ((end - start) * n) / 4, exact);
    dofs.write(exact, after);
  }
  const time = end === 1 ? times[key + 1] : times[key] + seconds * end;
  const isTooFast = seconds <= 0 || halvings >= MAX_HALVINGS || keys.length >= most;
  const push = (slopesIn: Float64Array | undefined, slopesOut: Float64Array | undefined) => {
    before.slopesOut = slopesOut;
    now.set(after);
    keys.push({ time, values: after, slopesIn, slopesOut: undefined });
  };
  if (isTooFast || isWithin(curve, key, start, end, dofs, before.values, after)) {
    const jump = after.reduce((most, value, d) => Math.max(most, Math.abs(value - before.values[d])), 0);
    // Past gimbal lock angles jump, while the rotation hardly changes.
    if (isTooFast && jump > 0.1) keys.push({ time, values: before.values, slopesIn: undefined, slopesOut: undefined });
    push(undefined, undefined);
    return;
  }
  const span = (end - start) * seconds;
  const slopesOut = slopesAt(curve, key, start, (end - start) * STEP, seconds, dofs, before.values);
  const slopesIn = slopesAt(curve, key, end, (start - end) * STEP, seconds, dofs, after);
  if (isWithin(curve, key, start, end, dofs, before.values, after, scaled(slopesOut, span), scaled(slopesIn, span))) {
    push(slopesIn, slopesOut);
    return;
  }
  const middle = (start + end) / 2;
  fitBetween(curve, key, start, middle, dofs, keys, now, halvings + 1, most);
  fitBetween(curve, key, middle, end, dofs, keys, now, halvings + 1, most);
}

/** `part` may be 1. */
function at(curve: QuaternionCurve, key: number, part: number, q: Float64Array): void {
  if (part === 1) rotationWithin(curve, key + 1, 0, q);
  else rotationWithin(curve, key, part, q);
}

function scaled(values: Float64Array, by: number): Float64Array {
  return values.map((value) => value * by);
}

const one = new Float64Array(4);
const two = new Float64Array(4);

/** Per second, one-sided: the curve may have a corner at its keys. */
function slopesAt(
  curve: QuaternionCurve,
  key: number,
  part: number,
  step: number,
  seconds: number,
  dofs: RotationDofs,
  here: Float64Array,
): Float64Array {
  at(curve, key, part + step, exact);
  one.set(here);
  dofs.write(exact, one);
  at(curve, key, part + 2 * step, exact);
  two.set(one);
  dofs.write(exact, two);
  return here.map((value, d) => (4 * one[d] - two[d] - 3 * value) / (2 * step * seconds));
}

/** Whether channels between two sets of DOFs keep to the curve. Slopes are per part; absent: linear. */
function isWithin(
  curve: QuaternionCurve,
  key: number,
  start: number,
  end: number,
  dofs: RotationDofs,
  before: Float64Array,
  after: Float64Array,
  slopesOut?: Float64Array,
  slopesIn?: Float64Array,
): boolean {
  for (const t of CHECKED) {
    for (let d = 0; d < dofs.count; d++) {
      one[d] =
        slopesOut && slopesIn
          ? hermite(before[d], after[d], slopesOut[d], slopesIn[d], t)
          : before[d] + t * (after[d] - before[d]);
    }
    dofs.read(one, fitted);
    at(curve, key, start + t * (end - start), exact);
    let cross = 0;
    const sign = exact[0] * fitted[0] + exact[1] * fitted[1] + exact[2] * fitted[2] + exact[3] * fitted[3] < 0 ? -1 : 1;
    for (let k = 0; k < 4; k++) cross += (exact[k] - sign * fitted[k]) ** 2;
    // The chord between unit quaternions is half the angle.
    if (!(4 * cross <= TOLERANCE * TOLERANCE)) return false;
  }
  return true;
}

const CHECKED = [0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875];

function channelOf(keys: readonly FittedKey[], d: number): Channel {
  const first = keys[0].values[d];
  const isLinear = keys.every(({ slopesIn, slopesOut }) => !slopesIn && !slopesOut);
  if (isLinear && keys.every(({ values }) => values[d] === first)) return restChannel(first);
  const tangents = (side: 'slopesIn' | 'slopesOut') => ({
    kinds: Uint8Array.from(keys, (key) => (key[side] ? FIXED_TANGENT : LINEAR)),
    slopes: Float64Array.from(keys, (key) => key[side]?.[d] ?? 0),
  });
  return {
    kind: 'keys',
    extrapolateIn: 'constant',
    extrapolateOut: 'constant',
    times: Float64Array.from(keys, ({ time }) => time),
    values: Float64Array.from(keys, ({ values }) => values[d]),
    tangentsIn: tangents('slopesIn'),
    tangentsOut: tangents('slopesOut'),
  };
}
