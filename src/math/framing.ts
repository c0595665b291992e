/**
 * Camera framing: the position from which a camera shows boxes, and its depth range. Plain formulas without three.js,
 * testable without rendering.
 *
 *     camera's axes: x right, y up, z towards the viewer; the camera looks along −z
 *
 *              │╲ ←tan(fov/2)
 *     camera ──┼──·────────── box's centre at distance d
 *              │╱
 */

/** Where a camera of known rotation is: along its own axes, from the world's origin. */
export interface FittedEye {
  readonly x: number;
  readonly y: number;
  readonly z: number;
  /** Along z, the middle of what is seen. */
  readonly middle: number;
}

/** The camera is at least this many times as far from the middle as what is nearest to it. */
const MIN_DISTANCE = 1.5;

/**
 * The nearest place from which a camera with the rotation of world matrix `m` sees several boxes whole, with `margin`
 * (1.2: a fifth more room than needed). Several small boxes, one for each moment of a motion, show it larger than the
 * one around them all, whose corners nothing ever reaches.
 *
 * A corner at x, y, z along the camera's axes is seen from X, Y, Z between the left and the right edge if
 *
 *     x + t·z ≤ X + t·Z    and    −x + t·z ≤ −X + t·Z        t: tangent of half the horizontal angle
 *
 * so that with A and B, the largest of the left sides over all corners, Z ≥ (A + B) / 2t, and X is halfway between
 * A − t·Z and t·Z − B. The same holds for Y, with the tangents of the upper and of the lower edge.
 *
 * @param boxes minimum x y z and maximum x y z, 6 for each
 * @param tanHalfFov of the vertical angle
 * @param aspect width / height
 * @param coveredTop fraction of the height, at its top, that is kept clear
 */
export function fitEye(
  boxes: ArrayLike<number>,
  m: ArrayLike<number>,
  tanHalfFov: number,
  aspect: number,
  margin: number,
  coveredTop = 0,
): FittedEye {
  const half = ((1 - coveredTop) * tanHalfFov) / margin;
  const above = half - coveredTop * tanHalfFov;
  const below = half + coveredTop * tanHalfFov;
  const side = (aspect * tanHalfFov) / margin;
  const right = farthest(boxes, m, 0, 1, side);
  const left = farthest(boxes, m, 0, -1, side);
  const top = farthest(boxes, m, 4, 1, above);
  const bottom = farthest(boxes, m, 4, -1, below);
  const near = farthest(boxes, m, 8, 1, 0);
  const middle = (near - farthest(boxes, m, 8, -1, 0)) / 2;
  let z = Math.max((right + left) / (2 * side), (top + bottom) / (above + below));
  z = Math.max(z, middle + MIN_DISTANCE * (near - middle));
  if (z === middle) z += 1;
  return { x: (right - left) / 2, y: (top - above * z + below * z - bottom) / 2, z, middle };
}

/** The largest ±a + t·z in boxes, a along the axis at `m[axis]`: at a corner of each that the signs tell. */
function farthest(boxes: ArrayLike<number>, m: ArrayLike<number>, axis: number, sign: number, t: number): number {
  const [x, y, z] = [0, 1, 2].map((k) => (sign * m[axis + k] + t * m[8 + k] > 0 ? k + 3 : k));
  let most = -Infinity;
  for (let o = 0; o < boxes.length; o += 6) {
    const along = (i: number) => m[i] * boxes[o + x] + m[i + 1] * boxes[o + y] + m[i + 2] * boxes[o + z];
    most = Math.max(most, sign * along(axis) + t * along(8));
  }
  return most;
}

/**
 * Near and far plane as distances along the camera's view, in scene units; an orthographic camera's `near` may be
 * negative.
 */
export interface DepthRange {
  readonly near: number;
  readonly far: number;
}

/**
 * Near and far plane of a perspective camera at `distance` from its target. `reach` is how far drawn things (content
 * and grid) extend behind the target.
 *
 * Near is 2 % of the distance: this does not take the ground in front of the character, and 24 bits of depth still
 * resolve 3·10⁻⁶ of the distance. In scenes that are huge compared with the distance (a giant's fingertip), near is at
 * least 10⁻⁵ of far, to keep precision for the rest. Fitting near to the content would take the ground.
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
