/**
 * Handles on screen: polylines, their depths, and which parts are on the far side.
 *
 *     ring         64 pieces, the first at the mark (where the bone points), by the right-hand rule
 *     arrow, box   from the middle outwards along the axis
 *     square       its four edges, beside the middle
 */
import type { Hue } from '../../evaluate/handles/dof-axes.ts';
import type { Handle, HandleId, HandleRange, JointHandles, PlaneHandle } from '../../evaluate/handles/joint-handles.ts';
import { add, cross, dot, scaled, subtract, unit, type Vec3 } from '../../math/vec3.ts';

/**
 * Radius of the rings, in CSS pixels: the outer ring is a fifth larger. Smaller ones can't be hit, larger ones cover
 * the joints around.
 */
const MIN_RADIUS = 44;
const MAX_RADIUS = 110;
/** As a part of the joint's size: the rings stay clear of the next joint. */
const SIZE_PART = 0.9;
/** At most this part of the viewport's width and height. */
const VIEW_PART = 0.24;
/** As a part of the radius, if there are rings too: outside of them. */
const ARROW_PART = 1.35;
/** Where an arrow comes out of the rings, as a part of its length. */
export const RINGS_END = 1 / ARROW_PART;
const VIEW_RING_PART = 1.2;
/** The ball inside the rings; the gap between is empty, so that the rings are easy to hit. */
export const BALL_PART = 0.86;
const PIECES = 64;
/** From where to where a square is along either axis, as parts of the radius. */
const SQUARE = [0.36, 0.7] as const;
/** A plane seen closer to its edge than this can't be dragged in: the cosine to the line of sight. */
const EDGE_ON = 0.17;
/** An axis shorter than this on screen points at the viewer and can't be dragged along. */
const SHORTEST_PIXELS = 14;

/** Projects world points to the screen. */
export interface Projection {
  /** CSS pixels from the viewport's top left, written to `out`; false if behind the viewer. */
  project(point: Vec3, out: Float64Array, o: number): boolean;
  /** Unit vector from a point towards the viewer. */
  towardsViewer(point: Vec3): Vec3;
  /** World length of a CSS pixel at a point. */
  unitsPerPixel(point: Vec3): number;
  /** CSS pixels. */
  readonly width: number;
  readonly height: number;
}

export interface Shape {
  readonly id: HandleId;
  readonly form: 'ring' | 'arrow' | 'box' | 'diamond' | 'square' | 'disc';
  /** x y each. */
  readonly points: Float64Array;
  /** World length of each point in front of the pivot; negative behind it. */
  readonly depths: Float64Array;
  /** For each piece between two points, whether it is on the far side; never for a ring that faces the viewer. */
  readonly isBehind: readonly boolean[];
  /** Undefined: not one DOF's. */
  readonly hue: Hue | undefined;
  readonly range: HandleRange;
  /** Points at the viewer: drawn faintly, can't be dragged. */
  readonly isAway: boolean;
  /** Radians from one point of a ring to the next; for an arrow, the DOF's change from its first to its last point. */
  readonly step: number;
}

export interface Layout {
  /** On screen. */
  readonly pivot: readonly [number, number];
  readonly radius: number;
  /** Radius of the outermost ring. */
  readonly outer: number;
  readonly shapes: readonly Shape[];
}

const FREE: HandleRange = { value: 0, min: -Infinity, max: Infinity };

/**
 * Radius of the rings in CSS pixels: by the size of the joint on screen, within bounds.
 *
 * @param scale the size the user wants: a factor, 1 by default
 */
export function ringRadius({ pivot, size }: JointHandles, view: Projection, scale: number): number {
  const pixels = (SIZE_PART * size) / view.unitsPerPixel(pivot);
  const within = Math.min(MAX_RADIUS, Math.max(MIN_RADIUS, pixels));
  return Math.min(scale * within, VIEW_PART * Math.min(view.width, view.height));
}

/** Undefined if the joint is behind the viewer. @param radius of the rings, CSS pixels */
export function layOut(joint: JointHandles, view: Projection, radius: number): Layout | undefined {
  const at = new Float64Array(2);
  if (!view.project(joint.pivot, at, 0)) return undefined;
  const depthOf = depthsFrom(joint.pivot, view);
  const hasRings = joint.handles.some(({ kind }) => kind === 'turn');
  const shapes: Shape[] = [];
  for (const handle of joint.handles) {
    const shape =
      handle.kind === 'turn' ? ring(handle, view, radius, depthOf) : straight(handle, view, radius, hasRings, depthOf);
    if (shape) shapes.push(shape);
  }
  for (const plane of joint.planes ?? []) {
    const shape = square(plane, view, radius, depthOf);
    if (shape) shapes.push(shape);
  }
  if (joint.freeTurn) {
    shapes.push(circle({ kind: 'view' }, 'ring', at, VIEW_RING_PART * radius));
    shapes.push(circle({ kind: 'ball' }, 'disc', at, BALL_PART * radius));
  }
  return { pivot: [at[0], at[1]], radius, outer: joint.freeTurn ? VIEW_RING_PART * radius : radius, shapes };
}

/** World length of a point in front of the pivot. */
type DepthOf = (point: Vec3) => number;

function depthsFrom(pivot: Vec3, view: Projection): DepthOf {
  const eye = view.towardsViewer(pivot);
  return (point) => dot(subtract(point, pivot), eye);
}

function ring(handle: Handle, view: Projection, pixels: number, depthOf: DepthOf): Shape | undefined {
  const { axis, centre, mark, id, hue, range } = handle;
  const size = pixels * view.unitsPerPixel(centre);
  const side = cross(axis, mark);
  const eye = view.towardsViewer(centre);
  // Almost face-on, no part is on the far side.
  const faces = Math.abs(dot(axis, eye)) > 0.96;
  const points = new Float64Array(2 * (PIECES + 1));
  const depths = new Float64Array(PIECES + 1);
  const isBehind: boolean[] = [];
  for (let i = 0; i <= PIECES; i++) {
    const angle = (2 * Math.PI * i) / PIECES;
    const out = add(scaled(mark, Math.cos(angle)), side, Math.sin(angle));
    const point = add(centre, out, size);
    if (!view.project(point, points, 2 * i)) return undefined;
    depths[i] = depthOf(point);
    if (i === PIECES) break;
    const middle = angle + Math.PI / PIECES;
    const away = add(scaled(mark, Math.cos(middle)), side, Math.sin(middle));
    isBehind.push(!faces && dot(away, eye) < 0);
  }
  return { id, form: 'ring', points, depths, isBehind, hue, range, isAway: false, step: (2 * Math.PI) / PIECES };
}

function straight(
  handle: Handle,
  view: Projection,
  pixels: number,
  hasRings: boolean,
  depthOf: DepthOf,
): Shape | undefined {
  const { kind, axis, centre, id, hue, range, reach, arm } = handle;
  const size = pixels * view.unitsPerPixel(centre);
  const points = new Float64Array(4);
  if (!view.project(centre, points, 0)) return undefined;
  if (kind === 'grow') {
    // Uniform scale has no axis: up to the right in any view.
    const out = (hasRings ? ARROW_PART : 0.8) * pixels * Math.SQRT1_2;
    points.set([points[0] + out, points[1] - out], 2);
    const depths = new Float64Array(2).fill(depthOf(centre));
    return { id, form: 'box', points, depths, isBehind: [false], hue: undefined, range, isAway: false, step: size };
  }
  const length = (hasRings ? ARROW_PART : 1) * size;
  let from = centre;
  let to = add(centre, axis, length);
  if (kind === 'shear') {
    // A shear's handle is on its arm and moves along the axis with the value.
    const far = shearPart(handle) * size;
    const out = scaled(unit(arm ?? [0, 1, 0]) ?? [0, 1, 0], far);
    const goes = (far / (Math.hypot(...(arm ?? [0, 1, 0])) || 1)) * reach * range.value;
    from = centre;
    to = add(add(centre, out), axis, goes);
  }
  if (!view.project(from, points, 0) || !view.project(to, points, 2)) return undefined;
  const seen = Math.hypot(points[2] - points[0], points[3] - points[1]);
  const across = kind === 'shear' ? acrossOnScreen(to, axis, size, view) : seen;
  const form = kind === 'slide' ? 'arrow' : kind === 'shear' ? 'diamond' : 'box';
  const step = kind === 'slide' ? length / (reach || 1) : 1;
  const depths = Float64Array.of(depthOf(from), depthOf(to));
  return { id, form, points, depths, isBehind: [false], hue, range, isAway: across < SHORTEST_PIXELS, step };
}

function square(
  { id, centre, axes: [u, v], hue }: PlaneHandle,
  view: Projection,
  pixels: number,
  depthOf: DepthOf,
): Shape | undefined {
  const size = pixels * view.unitsPerPixel(centre);
  const [near, far] = SQUARE;
  const corners = [near, near, far, near, far, far, near, far, near, near];
  const points = new Float64Array(10);
  const depths = new Float64Array(5);
  for (let i = 0; i < 5; i++) {
    const point = add(add(centre, u, corners[2 * i] * size), v, corners[2 * i + 1] * size);
    if (!view.project(point, points, 2 * i)) return undefined;
    depths[i] = depthOf(point);
  }
  const isAway = Math.abs(dot(cross(u, v), view.towardsViewer(centre))) < EDGE_ON;
  const isBehind = [false, false, false, false];
  return { id, form: 'square', points, depths, isBehind, hue, range: FREE, isAway, step: size };
}

/**
 * Distance of a shear's handle along its arm, as a part of a ring's radius. Two share an arm, so they are kept apart.
 */
export function shearPart({ hue }: Pick<Handle, 'hue'>): number {
  return hue === 'other' ? 1 : 1 - 0.3 * hue;
}

/** Length of an axis in pixels on screen. */
function acrossOnScreen(from: Vec3, axis: Vec3, size: number, view: Projection): number {
  const ends = new Float64Array(4);
  if (!view.project(from, ends, 0) || !view.project(add(from, axis, size), ends, 2)) return 0;
  return Math.hypot(ends[2] - ends[0], ends[3] - ends[1]);
}

function circle(id: HandleId, form: 'ring' | 'disc', at: Float64Array, radius: number): Shape {
  const points = new Float64Array(2 * (PIECES + 1));
  for (let i = 0; i <= PIECES; i++) {
    const angle = (2 * Math.PI * i) / PIECES;
    points.set([at[0] + radius * Math.cos(angle), at[1] - radius * Math.sin(angle)], 2 * i);
  }
  const isBehind = Array.from({ length: PIECES }, () => false);
  const depths = new Float64Array(PIECES + 1);
  return {
    id,
    form,
    points,
    depths,
    isBehind,
    hue: undefined,
    range: FREE,
    isAway: false,
    step: (2 * Math.PI) / PIECES,
  };
}

/** Whether a point of the viewport is in a square. */
export function isInSquare({ points }: Shape, x: number, y: number): boolean {
  const sides = [0, 2, 4, 6].map((o) => {
    return (points[o + 2] - points[o]) * (y - points[o + 1]) - (points[o + 3] - points[o + 1]) * (x - points[o]);
  });
  return sides.every((side) => side >= 0) || sides.every((side) => side <= 0);
}

/** Whether a ring has limits to show: a range of less than a full turn. */
export function hasArc({ min, max }: HandleRange): boolean {
  return Number.isFinite(min) && Number.isFinite(max) && max - min < 2 * Math.PI;
}

/** Whether the DOF can reach an angle from the ring's mark. */
export function isAllowed({ value, min, max }: HandleRange, angle: number): boolean {
  const turn = 2 * Math.PI;
  // The first equivalent angle from the lower limit on.
  const from = value + angle - min;
  return from - turn * Math.floor(from / turn) <= max - min;
}
