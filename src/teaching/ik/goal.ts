/** A point of a joint that a program of inverse kinematics moves to a target, and other points it may move instead. */
import type { Vec3 } from '../../math/vec3.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';

/** The end effector: a point of a joint. */
export interface EndEffector {
  /** Index of the joint. */
  readonly joint: number;
  /** In the joint's space. */
  readonly point: Vec3;
}

/** A point of a joint with its target. */
export interface Goal extends EndEffector {
  /** In the space of the world matrices. */
  readonly target: Vec3;
}

/** Tips and origins of all joints. */
export function endEffectorsOf({ joints }: Skeleton): readonly EndEffector[] {
  return joints.flatMap(({ length = 0 }, joint) => {
    const origin: EndEffector = { joint, point: [0, 0, 0] };
    return length === 0 ? [origin] : [{ joint, point: [0, length, 0] }, origin];
  });
}

/** `the tip of "hand"`. */
export function effectorText({ joints }: Skeleton, { joint, point: [x, y, z] }: EndEffector): string {
  const { name, length = 0 } = joints[joint];
  const of = name === '' ? `joint ${joint}` : `"${name}"`;
  if (x !== 0 || z !== 0 || (y !== 0 && y !== length)) return `the point ${x},${y},${z} of ${of}`;
  return `the ${y === 0 ? 'origin' : 'tip'} of ${of}`;
}
