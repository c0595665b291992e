/**
 * Quantities over time from sampled positions and rotations. Those that change by time are central differences, at the
 * ends one-sided; h is the time between frames.
 *
 *     speed            | p(t + h) − p(t − h) | / 2h
 *     acceleration     | p(t + h) − 2 p(t) + p(t − h) | / h²         at the ends that of the frame beside
 *     angle            of the rotation from rest, 0 to 180°
 *     angularSpeed     angle of R(t − h)⁻¹ · R(t + h), by 2h         relative to the parent
 *
 * Positions are those of the scene: y is the height above the ground.
 */
import { RADIANS_PER_DEGREE } from '../../math/degrees.ts';
import { length3 } from '../../math/vec3.ts';

/**
 * Quantities that can be measured over time: three coordinates in the scene, their derivatives, rotations, and contact
 * of feet with the ground.
 */
export const QUANTITIES = ['x', 'height', 'z', 'speed', 'acceleration', 'angle', 'angularSpeed', 'contact'] as const;
/** A quantity over time; see `QUANTITIES`. */
export type Quantity = (typeof QUANTITIES)[number];

/** A point's or a joint's motion in evenly spaced frames. */
export interface Motion {
  /** x y z per frame. */
  readonly positions: Float64Array;
  /** x y z w per frame, unit; absent: a point, which does not rotate. */
  readonly rotations?: Float64Array;
  /** 1 or 0 per frame; absent: no foot. */
  readonly contacts?: Float64Array;
}

/**
 * One value per frame: lengths as positions, times in seconds, angles in degrees; undefined if the motion has no such
 * quantity. Fewer frames than a difference needs give 0.
 */
export function quantityOf(motion: Motion, quantity: Quantity, frameSeconds: number): Float64Array | undefined {
  const { positions, rotations, contacts } = motion;
  switch (quantity) {
    case 'x':
      return component(positions, 0);
    case 'height':
      return component(positions, 1);
    case 'z':
      return component(positions, 2);
    case 'speed':
      return speeds(positions, frameSeconds);
    case 'acceleration':
      return accelerations(positions, frameSeconds);
    case 'angle':
      return rotations && angles(rotations);
    case 'angularSpeed':
      return rotations && angularSpeeds(rotations, frameSeconds);
    case 'contact':
      return contacts;
  }
}

function component(positions: Float64Array, k: number): Float64Array {
  const out = new Float64Array(positions.length / 3);
  for (let f = 0; f < out.length; f++) out[f] = positions[3 * f + k];
  return out;
}

/** Per frame how far apart its neighbours are, a second; at the ends it is one of them itself. */
function rates(frameCount: number, frameSeconds: number, apart: (a: number, b: number) => number): Float64Array {
  const out = new Float64Array(frameCount);
  const last = frameCount - 1;
  for (let f = 0; f <= last && last > 0; f++) {
    const a = Math.max(0, f - 1);
    const b = Math.min(last, f + 1);
    out[f] = apart(a, b) / ((b - a) * frameSeconds);
  }
  return out;
}

function speeds(p: Float64Array, frameSeconds: number): Float64Array {
  return rates(p.length / 3, frameSeconds, (from, to) => {
    const a = 3 * from;
    const b = 3 * to;
    return length3(p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]);
  });
}

function accelerations(p: Float64Array, frameSeconds: number): Float64Array {
  const out = new Float64Array(p.length / 3);
  const last = out.length - 1;
  for (let f = 0; f <= last && last > 1; f++) {
    const o = 3 * Math.min(last - 1, Math.max(1, f));
    const x = p[o + 3] - 2 * p[o] + p[o - 3];
    const y = p[o + 4] - 2 * p[o + 1] + p[o - 2];
    const z = p[o + 5] - 2 * p[o + 2] + p[o - 1];
    out[f] = length3(x, y, z) / (frameSeconds * frameSeconds);
  }
  return out;
}

function angles(q: Float64Array): Float64Array {
  const out = new Float64Array(q.length / 4);
  for (let f = 0; f < out.length; f++) out[f] = turn(q[4 * f], q[4 * f + 1], q[4 * f + 2], q[4 * f + 3]);
  return out;
}

function angularSpeeds(q: Float64Array, frameSeconds: number): Float64Array {
  return rates(q.length / 4, frameSeconds, (from, to) => {
    const a = 4 * from;
    const b = 4 * to;
    // conj(q_a) · q_b
    const x = -q[a];
    const y = -q[a + 1];
    const z = -q[a + 2];
    const w = q[a + 3];
    return turn(
      w * q[b] + x * q[b + 3] + y * q[b + 2] - z * q[b + 1],
      w * q[b + 1] - x * q[b + 2] + y * q[b + 3] + z * q[b],
      w * q[b + 2] + x * q[b + 1] - y * q[b] + z * q[b + 3],
      w * q[b + 3] - x * q[b] - y * q[b + 1] - z * q[b + 2],
    );
  });
}

/** Angle of a unit quaternion, 0 to 180 degrees; exact for small ones, unlike by the arc cosine of w. */
function turn(x: number, y: number, z: number, w: number): number {
  return (2 * Math.atan2(length3(x, y, z), Math.abs(w))) / RADIANS_PER_DEGREE;
}
