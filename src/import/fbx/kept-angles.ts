/**
 * Whether the angles of a node are those of its joint, so that its curves can be kept as they are:
 *
 *     rotation = before · R(angles) · after        of constant rotations before and after
 *
 * They are, but for a constant, where `before` turns about the axis that is turned last and `after` about the one that
 * is turned first. Elbows, knees and fingers turn about one axis only: what is before it is constant then, and so are
 * the two other angles in an order that turns about that axis first.
 */

import {
  axesOfOrder,
  lockedness,
  multiplyQuaternions,
  ordersFrom,
  writeAnglesNear,
  writeQuaternion,
} from '../../evaluate/rotations/euler-orders.ts';
import { RADIANS_PER_DEGREE } from '../../math/degrees.ts';
import type { Vec3 } from '../../math/vec3.ts';
import type { EulerOrder } from '../../model/skeleton/skeleton.ts';
import type { Driven, FbxTake } from './animation.ts';
import { staysAt } from './curve.ts';
import { driversOf } from './motion.ts';
import type { FbxNode } from './nodes.ts';

/** The joint's angle about axis k is `turns[k]`, and the node's where it `follows`. */
export interface KeptAngles {
  readonly order: EulerOrder;
  readonly turns: Vec3;
  readonly follows: readonly [boolean, boolean, boolean];
}

/** Radians: angles that differ by less are one. */
const SAME = 1e-6;
/** From here on the middle angle is too near to gimbal lock for angles that are to be edited. */
const LOCKED = Math.sin((88 * Math.PI) / 180);

/** How the angles of a node are those of its joint; undefined if they are not. */
export function keptAngles(node: FbxNode, takes: readonly FbxTake[]): KeptAngles | undefined {
  return turnedAtEnds(node) ?? turnedAboutOne(node, takes);
}

function turnedAtEnds({ order, pivots }: FbxNode): KeptAngles | undefined {
  const [inner, , outer] = axesOfOrder(order);
  const before = angleAbout(pivots.before, outer);
  const after = angleAbout(pivots.after, inner);
  if (before === undefined || after === undefined) return undefined;
  const turns: [number, number, number] = [0, 0, 0];
  turns[outer] += before;
  turns[inner] += after;
  return { order, turns, follows: [true, true, true] };
}

function turnedAboutOne(node: FbxNode, takes: readonly FbxTake[]): KeptAngles | undefined {
  const axis = onlyAxis(node, takes);
  if (axis === undefined) return undefined;
  const axes = axesOfOrder(node.order);
  const place = axes.indexOf(axis);
  const part = (isLater: boolean) => {
    const angles = [0, 0, 0];
    axes.forEach((k, p) => {
      if (isLater ? p > place : p < place) angles[k] = node.angles[k];
    });
    const q = new Float64Array(4);
    writeQuaternion(node.order, angles, q);
    return q;
  };
  const later = part(true);
  const earlier = part(false);
  multiplyQuaternions(earlier, node.pivots.after, earlier);
  const own = angleAbout(earlier, axis);
  if (own === undefined) return undefined;
  multiplyQuaternions(node.pivots.before, later, later);
  const [a, b] = ordersFrom(axis);
  const order = lockedness(a, later) <= lockedness(b, later) ? a : b;
  if (lockedness(order, later) > LOCKED) return undefined;
  const turns = new Float64Array(3);
  writeAnglesNear(order, later, turns);
  turns[axis] += own;
  return {
    order,
    turns: [turns[0], turns[1], turns[2]],
    follows: [axis === 0, axis === 1, axis === 2],
  };
}

/** The one axis about which takes ever turn a node, each by a single layer; undefined if there are several or none. */
function onlyAxis(node: FbxNode, takes: readonly FbxTake[]): number | undefined {
  const moving = new Set<number>();
  for (const take of takes) {
    const [lowest, ...others] = driversOf(take, node.object.id, 'Lcl Rotation');
    if (others.some((driver) => driver !== undefined)) return undefined;
    if (!lowest) continue;
    for (const k of [0, 1, 2]) if (!rests(lowest, k, node.angles[k])) moving.add(k);
  }
  return moving.size === 1 ? [...moving][0] : undefined;
}

/** Whether an angle never leaves a value. */
function rests({ curves, values }: Driven, k: number, angle: number): boolean {
  const [degrees, tolerance] = [angle / RADIANS_PER_DEGREE, SAME / RADIANS_PER_DEGREE];
  const curve = curves[k];
  return curve ? staysAt(curve, degrees, tolerance) : Math.abs(values[k] - degrees) <= tolerance;
}

/** A quaternion's angle about an axis; undefined if it turns about another. */
function angleAbout(q: Float64Array, axis: number): number | undefined {
  const isAbout = [0, 1, 2].every((k) => k === axis || Math.abs(q[k]) < 1e-9);
  if (!isAbout) return undefined;
  const angle = 2 * Math.atan2(q[axis], q[3]);
  return angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
}
