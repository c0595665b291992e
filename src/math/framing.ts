/**
 * Where a camera stands to show a box, and how deep it sees: plain formulas over numbers, apart from three.js so that
 * they are tested without a picture.
 *
 *     camera's axes: x right, y up, z towards the viewer; the camera looks along −z
 *
 *              │╲ ←tan(fov/2)
 *     camera ──┼──·────────── box's centre at distance d
 *              │╱
 */

/**
 * Distance from a box's centre at which all of it is seen with `margin` (1.2: a fifth more room than it needs), by a
 * camera turned as the world matrix `m` says. The box has half sizes hx, hy, hz; `tanHalfFov` is of the vertical angle,
 * `aspect` width / height. A corner at (x, y, z) from the centre, along the camera's axes, is in the picture from
 *
 *     d ≥ z + max(|x| / (tan · aspect), |y| / tan)
 *
 * Where a part `coveredTop` of the picture's height lies under something else, the centre is seen in the middle of what
 * is left: the camera stands higher than it by coveredTop · tan · d, and a corner is seen from
 *
 *     d ≥ (z − y / tan) / (1 − coveredTop)                          over the lower edge
 *     d ≥ ((1 − 2 coveredTop) · z + y / tan) / (1 − coveredTop)     under what covers the upper one
 *
 * Around a sphere was simpler, and leaves long characters small.
 */
export function fitDistance(
  hx: number,
  hy: number,
  hz: number,
  m: ArrayLike<number>,
  tanHalfFov: number,
  aspect: number,
  margin: number,
  coveredTop = 0,
): number {
  let distance = 0;
  let deepest = 0;
  for (let corner = 0; corner < 8; corner++) {
    const x = corner & 1 ? hx : -hx;
    const y = corner & 2 ? hy : -hy;
    const z = corner & 4 ? hz : -hz;
    const right = Math.abs(m[0] * x + m[1] * y + m[2] * z);
    const up = (margin * (m[4] * x + m[5] * y + m[6] * z)) / tanHalfFov;
    const nearer = m[8] * x + m[9] * y + m[10] * z;
    const inHeight = Math.max(nearer - up, (1 - 2 * coveredTop) * nearer + up) / (1 - coveredTop);
    distance = Math.max(distance, inHeight, nearer + (margin * right) / (tanHalfFov * aspect));
    deepest = Math.max(deepest, nearer);
  }
  // Not nose to nose with what is thin and points at the camera: it would touch the edge, whatever the margin.
  return Math.max(distance, (1.5 * deepest) / (1 - coveredTop)) || 1;
}

export interface DepthRange {
  readonly near: number;
  readonly far: number;
}

/**
 * Near and far plane of a perspective camera `distance` away from what it looks at. `reach` is how far behind the
 * target anything drawn goes (content and grid).
 *
 * Near is 2 % of the distance: the ground in front of the character stays whole, and 24 bits of depth still resolve
 * 3·10⁻⁶ of the distance there. Where the scene is huge beside the distance (a fingertip of a giant), near keeps within
 * 10⁻⁵ of far, for the rest of the scene's sake. Fitting near to the content was tried first: it cuts the ground.
 */
export function perspectiveDepth(distance: number, reach: number): DepthRange {
  const far = distance + reach;
  return { near: Math.max(distance * 0.02, far * 1e-5), far };
}

/** Depth of an orthographic camera: linear, so it simply takes in everything, behind the camera too. */
export function orthographicDepth(distance: number, reach: number): DepthRange {
  return { near: distance - reach, far: distance + reach };
}

/** Distance at which a perspective camera shows what an orthographic one of this half height shows, at the target. */
export function distanceForHalfHeight(halfHeight: number, tanHalfFov: number): number {
  return halfHeight / tanHalfFov;
}

/** Eases out: quick to answer, soft to arrive. From 0 to 1 for `t` from 0 to 1. */
export function easeOut(t: number): number {
  const left = 1 - Math.min(1, Math.max(0, t));
  return 1 - left * left * left;
}

/**
 * Writes the axes of a camera that looks from an azimuth (from +z towards +x) and a polar angle (from +y): right, up, and
 * towards the viewer, as the columns of its world matrix.
 */
export function lookingFrom(azimuth: number, polar: number, m: Float64Array): void {
  const [sin, cos] = [Math.sin(azimuth), Math.cos(azimuth)];
  const [out, up] = [Math.sin(polar), Math.cos(polar)];
  m.set([cos, 0, -sin, 0, -up * sin, out, -up * cos, 0, out * sin, up, out * cos, 0]);
}

/** The turn from angle `a` to `b` the short way round, in −π … π. */
export function shortTurn(a: number, b: number): number {
  const turn = (b - a) % (2 * Math.PI);
  return turn > Math.PI ? turn - 2 * Math.PI : turn < -Math.PI ? turn + 2 * Math.PI : turn;
}
