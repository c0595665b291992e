/**
 * What inverse kinematics holds on to in a character: points that are pinned, joints that are not to bend, and whether
 * the whole may travel. Part of the document: undone, and kept with the session.
 *
 * Where a pin holds is not in it: that is where its point is in the pose shown, and whoever drags keeps it meanwhile.
 */
import type { Vec3 } from '../math/vec3.ts';
import type { Skeleton } from './skeleton.ts';

export interface IkSetup {
  /** In the order in which they were made; no two of them hold the same point of the same joint. */
  readonly pins: readonly Pin[];
  /** Joints that are locked or stiffened, by index, ascending; all others bend as usual. */
  readonly stiff: readonly StiffJoint[];
  /** Whether what carries the whole character (`rootDofs`, or a root that moves by itself) takes part. */
  readonly rootIsFree: boolean;
}

/** A point of a joint that is held. */
export interface Pin {
  /** Unique among the character's pins, and kept over edits. */
  readonly id: number;
  /** Index of the joint. */
  readonly joint: number;
  /** In the joint's space. */
  readonly point: Vec3;
  /** How much it counts beside the others; more than 0, and 1 as usual. */
  readonly weight: number;
  /** Whether the joint's orientation is held too. */
  readonly holdsOrientation: boolean;
}

export interface StiffJoint {
  readonly joint: number;
  /** How unwilling its DOFs are to move: more than 1 (4: half as far for the same need); absent: locked. */
  readonly stiffness?: number;
}

/**
 * What holds for a character where nothing is said. The root of the axis-angle form stays, as in the program that the
 * form is from; others travel.
 */
export function defaultIk(skeleton: Skeleton | undefined): IkSetup {
  return { pins: [], stiff: [], rootIsFree: skeleton?.form !== 'axis-angle' };
}
