/**
 * Converts pointer positions of a drag to radians about an axis or lengths along one. Each measure returns the change
 * since the last position, counting whole turns, so that a drag can be slowed down or snapped.
 */
import { acrossOf, add, cross, dot, scaled, subtract, unit, type Vec3, ZERO } from '../../math/vec3.ts';
import type { Eye } from '../camera/eye.ts';

/** The camera functions needed. */
export type Sight = Pick<Eye, 'toScreen' | 'rayAt' | 'inPlaneOf' | 'unitsPerPixel'>;

/** The change from the last position to this one; the first position is given when the measure is created. */
export type Measure = (x: number, y: number) => number;

/** A ring seen closer to its edge than this is rotated along its edge, as its plane is almost a line. */
const EDGE_ON = 0.2;

/**
 * Radians about an axis through a centre. The pointer stays on the spot of the ring that it grabbed, from either side;
 * edge-on, it moves along the ring's line on screen.
 *
 * @param size the ring's radius in the world
 */
export function turnMeasure(sight: Sight, axis: Vec3, centre: Vec3, size: number, x: number, y: number): Measure {
  const eye = scaled(sight.rayAt(...onScreen(sight, centre)).direction, -1);
  if (Math.abs(dot(axis, eye)) < EDGE_ON) return alongEdge(sight, axis, centre, size, eye, x, y);
  const start = inPlane(sight, axis, centre, x, y);
  const u = unit(start ?? [0, 0, 0]) ?? cross(axis, eye);
  const v = cross(axis, u);
  let last = 0;
  return (nextX, nextY) => {
    const at = inPlane(sight, axis, centre, nextX, nextY);
    if (!at) return 0;
    const angle = Math.atan2(dot(at, v), dot(at, u));
    const by = shortest(angle - last);
    last = angle;
    return by;
  };
}

/** From the centre to where the ray hits the plane perpendicular to the axis; undefined if it doesn't. */
function inPlane(sight: Sight, axis: Vec3, centre: Vec3, x: number, y: number): Vec3 | undefined {
  const { origin, direction } = sight.rayAt(x, y);
  const speed = dot(direction, axis);
  if (Math.abs(speed) < 1e-9) return undefined;
  const t = dot(subtract(centre, origin), axis) / speed;
  return t > 0 ? subtract(add(origin, direction, t), centre) : undefined;
}

/** The half facing the viewer moves along axis × eye. */
function alongEdge(sight: Sight, axis: Vec3, centre: Vec3, size: number, eye: Vec3, x: number, y: number): Measure {
  const along = unit(cross(axis, eye)) ?? [1, 0, 0];
  const from = onScreen(sight, centre);
  const to = onScreen(sight, add(centre, along, size));
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  // A radian takes as many pixels as the radius.
  const square = dx * dx + dy * dy || 1;
  let [lastX, lastY] = [x, y];
  return (nextX, nextY) => {
    const by = ((nextX - lastX) * dx + (nextY - lastY) * dy) / square;
    [lastX, lastY] = [nextX, nextY];
    return by;
  };
}

/**
 * Radians about the line of sight through a centre, like turning a wheel that faces the viewer; positive:
 * counterclockwise.
 */
export function viewTurnMeasure(sight: Sight, centre: Vec3, x: number, y: number): Measure {
  const [cx, cy] = onScreen(sight, centre);
  let last = Math.atan2(cy - y, x - cx);
  return (nextX, nextY) => {
    if (Math.hypot(nextX - cx, nextY - cy) < 1) return 0;
    const angle = Math.atan2(cy - nextY, nextX - cx);
    const by = shortest(angle - last);
    last = angle;
    return by;
  };
}

/** World length along an axis: the point on it nearest to the pointer's ray. */
export function slideMeasure(sight: Sight, axis: Vec3, centre: Vec3, x: number, y: number): Measure {
  const place = (atX: number, atY: number): number | undefined => {
    const { origin, direction } = sight.rayAt(atX, atY);
    const between = subtract(centre, origin);
    const cosine = dot(axis, direction);
    const sine = 1 - cosine * cosine;
    if (sine < 1e-6) return undefined;
    return (cosine * dot(between, direction) - dot(between, axis)) / sine;
  };
  let last = place(x, y);
  return (nextX, nextY) => {
    const next = place(nextX, nextY);
    const by = next === undefined || last === undefined ? 0 : next - last;
    last = next ?? last;
    return by;
  };
}

/** World length along two axes: where the pointer's ray meets their plane. */
export function planeMeasure(
  sight: Sight,
  [u, v]: readonly [Vec3, Vec3],
  centre: Vec3,
  x: number,
  y: number,
): (x: number, y: number) => readonly [alongU: number, alongV: number] {
  const normal = unit(cross(u, v)) ?? acrossOf(u);
  let last = inPlane(sight, normal, centre, x, y);
  return (nextX, nextY) => {
    const next = inPlane(sight, normal, centre, nextX, nextY);
    const by = next && last ? subtract(next, last) : ZERO;
    last = next ?? last;
    return [dot(by, u), dot(by, v)];
  };
}

/** Pixels upwards. */
export function upMeasure(y: number): Measure {
  let last = y;
  return (_x, nextY) => {
    const by = last - nextY;
    last = nextY;
    return by;
  };
}

/** Pixels up to the right. */
export function diagonalMeasure(x: number, y: number): Measure {
  let last = (x - y) * Math.SQRT1_2;
  return (nextX, nextY) => {
    const next = (nextX - nextY) * Math.SQRT1_2;
    const by = next - last;
    last = next;
    return by;
  };
}

/** Rotation of a ball rolled under the pointer. */
export interface Roll {
  /** Unit length, in the world. */
  readonly axis: Vec3;
  /** Radians. */
  readonly angle: number;
}

/** @param pixels the ball's radius */
export function rollMeasure(
  sight: Sight,
  centre: Vec3,
  pixels: number,
  x: number,
  y: number,
): (x: number, y: number) => Roll | undefined {
  const [cx, cy] = onScreen(sight, centre);
  const middle = sight.inPlaneOf(centre, cx, cy);
  const right = unit(subtract(sight.inPlaneOf(centre, cx + 1, cy), middle)) ?? [1, 0, 0];
  const up = unit(subtract(sight.inPlaneOf(centre, cx, cy - 1), middle)) ?? [0, 1, 0];
  let [lastX, lastY] = [x, y];
  return (nextX, nextY) => {
    const [dx, dy] = [nextX - lastX, nextY - lastY];
    [lastX, lastY] = [nextX, nextY];
    const axis = unit(add(scaled(up, dx), right, dy));
    return axis && { axis, angle: Math.hypot(dx, dy) / pixels };
  };
}

/** A world axis towards the viewer, for rotating about the line of sight. */
export function lineOfSight(sight: Sight, centre: Vec3): Vec3 {
  return scaled(sight.rayAt(...onScreen(sight, centre)).direction, -1);
}

function onScreen(sight: Sight, point: Vec3): [number, number] {
  const { x, y } = sight.toScreen(point);
  return [x, y];
}

/** The same rotation within ±π. */
function shortest(angle: number): number {
  return angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
}
