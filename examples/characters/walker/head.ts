/**
 * The walker's head: a ball with cheeks, muzzle and tufts at the sides, and the features on its front (eyes, nose,
 * mouth).
 *
 *     p = centre + d · halfSize · (1 + Σ amount · exp(−(angle to bump / width)²))        d: a unit direction
 */
import { add, dot, scaled, subtract, type Vec3 } from '../../../src/math/vec3.ts';
import { normalise } from '../shape/vectors.ts';

export const HEAD_CENTRE: Vec3 = [0, 1.56, 0.02];
const HALF_SIZE: Vec3 = [0.455, 0.4, 0.4];

interface Bump {
  readonly direction: Vec3;
  readonly amount: number;
  /** Radians. */
  readonly width: number;
}

const bumps: readonly Bump[] = [
  ...[1, -1].flatMap((side): Bump[] => [
    { direction: normalise([0.78 * side, -0.42, 0.45]), amount: 0.07, width: 0.5 },
    { direction: normalise([0.93 * side, -0.4, 0.1]), amount: 0.13, width: 0.24 },
    { direction: normalise([0.33 * side, 0.12, 0.9]), amount: -0.035, width: 0.25 },
  ]),
  { direction: normalise([0, -0.36, 0.93]), amount: 0.16, width: 0.36 },
  { direction: [0, 1, 0], amount: -0.03, width: 0.6 },
];

/** Radius of the surface in a unit direction, in half sizes. */
function swell(direction: Vec3): number {
  let sum = 1;
  for (const { direction: centre, amount, width } of bumps) {
    const angle = Math.acos(Math.max(-1, Math.min(1, dot(direction, centre))));
    sum += amount * Math.exp(-((angle / width) ** 2));
  }
  return sum;
}

/** v 0 … 1 from the chin to the crown; rows are slightly denser about the face. */
export function headPoint(angle: number, v: number): Vec3 {
  const latitude = (v - 0.5) * Math.PI + 0.12 * Math.sin(2 * Math.PI * v) * 0.9;
  const level = Math.cos(latitude);
  const d: Vec3 = [Math.sin(angle) * level, Math.sin(latitude), Math.cos(angle) * level];
  const s = swell(d);
  return add(HEAD_CENTRE, [d[0] * HALF_SIZE[0] * s, d[1] * HALF_SIZE[1] * s, d[2] * HALF_SIZE[2] * s]);
}

/** Depth of the face's surface at a point of the xy plane, by bisection. */
function faceDepth(x: number, y: number): number {
  let inside = HEAD_CENTRE[2];
  let outside = HEAD_CENTRE[2] + 0.8;
  for (let i = 0; i < 40; i++) {
    const z = (inside + outside) / 2;
    const p = subtract([x, y, z], HEAD_CENTRE);
    const q: Vec3 = [p[0] / HALF_SIZE[0], p[1] / HALF_SIZE[1], p[2] / HALF_SIZE[2]];
    const far = Math.hypot(q[0], q[1], q[2]);
    if (far < swell(scaled(q, 1 / far))) inside = z;
    else outside = z;
  }
  return inside;
}

/** Maps a square −1 … 1 to a disc, without crowding a grid's corners. */
export function squareToDisc(x: number, y: number): readonly [number, number] {
  return [x * Math.sqrt(1 - (y * y) / 2), y * Math.sqrt(1 - (x * x) / 2)];
}

const EYE = { x: 0.175, y: 1.555, width: 0.066, height: 0.092 } as const;
const NOSE = { y: 1.49, width: 0.052, height: 0.036 } as const;
const MOUTH = { y: 1.405, width: 0.075, thickness: 0.011 } as const;

/** An eye: a low dome. `closed` 0 … 1 presses it into a line that bows down, as a cartoon's closed eye is drawn. */
export function eyePoint(side: number, s: number, t: number, closed: number, squint: number): Vec3 {
  const [u, w] = squareToDisc(2 * s - 1, 2 * t - 1);
  const r = Math.hypot(u, w);
  const x = EYE.x * side + u * EYE.width * (1 + 0.12 * closed);
  // Smiling cheeks push the lower half up.
  const open = EYE.y + (w < 0 ? w * (1 - 0.45 * squint) : w) * EYE.height;
  // The dark lower half becomes the line; the upper, with its highlights, moves below the surface.
  const strip = 0.011 * (1 - u * u * 0.5) * Math.max(-1, Math.min(1, (w + 0.65) * 3));
  const line = EYE.y - 0.02 - 0.024 * (1 - u * u) + strip;
  const y = open + (line - open) * closed;
  const tuck = closed * Math.max(0, Math.min(1, (w + 0.3) * 3)) * 0.03;
  const dome = 0.034 * (1 - r * r) * (1 - 0.75 * closed) - 0.006 + 0.016 * closed * (1 - r * r * 0.9);
  return [x, y, faceDepth(x, y) + dome - tuck];
}

export function nosePoint(s: number, t: number): Vec3 {
  const [u, w] = squareToDisc(2 * s - 1, 2 * t - 1);
  const x = u * NOSE.width * (w < 0 ? 1 + 0.3 * w : 1);
  const y = NOSE.y + w * NOSE.height;
  const r2 = u * u + w * w;
  return [x, y, faceDepth(x, y) - 0.012 + 0.045 * Math.sqrt(Math.max(0, 1 - r2 * 0.98))];
}

/** The mouth: a thin smiling line that `smile` 0 … 1 widens and opens. */
export function mouthPoint(s: number, t: number, smile: number): Vec3 {
  const u = 2 * s - 1;
  const width = MOUTH.width * (1 + 0.4 * smile);
  const bow = (0.024 + 0.018 * smile) * u * u;
  const thickness = MOUTH.thickness * (1 - 0.6 * u * u);
  const open = smile * 0.062 * (1 - u * u) ** 0.8;
  const x = u * width;
  const y = MOUTH.y + 0.008 * smile + bow + (t - 0.5) * thickness - (1 - t) * open;
  return [x, y, faceDepth(x, y) + 0.005];
}
