/**
 * Camera framing: the position from which a camera shows a box, and its depth range. Plain formulas without three.js,
 * testable without rendering.
 *
 *     camera's axes: x right, y up, z towards the viewer; the camera looks along −z
 *
 *              │╲ ←tan(fov/2)
 *     camera ──┼──·────────── box's centre at distance d
 *              │╱
 */

/**
 * Distance from a box's centre at which a camera with the rotation of world matrix `m` sees all of it with `margin`
 * (1.2: a fifth more room than needed). The box has half sizes hx, hy, hz; `tanHalfFov` is of the vertical angle,
 * `aspect` width / height. A corner at (x, y, z) from the centre, in camera axes, is visible from
 *
 *     d ≥ z + max(|x| / (tan · aspect), |y| / tan)
 *
 * If a fraction `coveredTop` of the picture's height is covered, the centre is shown in the middle of the rest: the
 * camera is coveredTop · tan · d above it, and a corner is visible from
 *
 *     d ≥ (z − y / tan) / (1 − coveredTop)                          above the lower edge
 *     d ≥ ((1 − 2 coveredTop) · z + y / tan) / (1 − coveredTop)     below the covered part
 *
 * Fitting a bounding sphere would be simpler, but shows long characters too small.
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
  // Keeps clear of thin boxes that point at the camera: they would touch the edge, whatever the margin.
  return Math.max(distance, (1.5 * deepest) / (1 - coveredTop)) || 1;
}

export interface DepthRange {
  readonly near: number;
  readonly far: number;
}

/**
 * Near and far plane of a perspective camera at `distance` from its target. `reach` is how far drawn things (content
 * and grid) extend behind the target.
 *
 * Near is 2 % of the distance: this does not clip the ground in front of the character, and 24 bits of depth still
 * resolve 3·10⁻⁶ of the distance. In scenes that are huge compared with the distance (a giant's fingertip), near is at
 * least 10⁻⁵ of far, to keep precision for the rest. Fitting near to the content would clip the ground.
 */
export function perspectiveDepth(distance: number, reach: number): DepthRange {
  const far = distance + reach;
  return { near: Math.max(distance * 0.02, far * 1e-5), far };
}

/** Depth range of an orthographic camera: linear, so it includes everything, even behind the camera. */
export function orthographicDepth(distance: number, reach: number): DepthRange {
  return { near: distance - reach, far: distance + reach };
}

/**
 * Distance at which a perspective camera shows the same height at the target as an orthographic one of this half
 * height.
 */
export function distanceForHalfHeight(halfHeight: number, tanHalfFov: number): number {
  return halfHeight / tanHalfFov;
}

/** Ease-out: starts fast, ends smoothly. From 0 to 1 for `t` from 0 to 1. */
export function easeOut(t: number): number {
  const left = 1 - Math.min(1, Math.max(0, t));
  return 1 - left * left * left;
}

/**
 * Writes the axes of a camera placed at an azimuth (from +z towards +x) and a polar angle (from +y): right, up and
 * towards the viewer, as the columns of its world matrix.
 */
export function lookingFrom(azimuth: number, polar: number, m: Float64Array): void {
  const [sin, cos] = [Math.sin(azimuth), Math.cos(azimuth)];
  const [out, up] = [Math.sin(polar), Math.cos(polar)];
  m.set([cos, 0, -sin, 0, -up * sin, out, -up * cos, 0, out * sin, up, out * cos, 0]);
}

/** The shorter turn from angle `a` to `b`, in −π … π. */
export function shortTurn(a: number, b: number): number {
  const turn = (b - a) % (2 * Math.PI);
  return turn > Math.PI ? turn - 2 * Math.PI : turn < -Math.PI ? turn + 2 * Math.PI : turn;
}
