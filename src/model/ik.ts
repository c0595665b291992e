/**
 * A character's IK settings: pinned points, joints that are stiff or locked, and whether the root may move. Part of the
 * document: undoable, and saved with the session.
 *
 * A pin does not store its target: that is its point's position in the pose shown, which a drag keeps while it lasts.
 */
import type { Vec3 } from '../math/vec3.ts';
import type { Skeleton } from './skeleton/skeleton.ts';

/** IK settings of a character. Joint indices are those of its skeleton. */
export interface IkSetup {
  /** In creation order; no two hold the same point of the same joint. */
  readonly pins: readonly Pin[];
  /** Locked or stiffened joints by index, ascending; all others bend normally. */
  readonly stiff: readonly StiffJoint[];
  /** Whether root translation (`rootDofs`, or a root that moves by itself) takes part. */
  readonly rootIsFree: boolean;
}

/** A pinned point of a joint. */
export interface Pin {
  /** Unique among the character's pins; kept across edits. */
  readonly id: number;
  /** Index of the joint. */
  readonly joint: number;
  /** In the joint's space. */
  readonly point: Vec3;
  /** Weight relative to the other pins; greater than 0, default 1. */
  readonly weight: number;
  /** Whether the joint's orientation is held too. */
  readonly holdsOrientation: boolean;
}

/** A joint that IK bends less than others, or not at all. */
export interface StiffJoint {
  readonly joint: number;
  /**
   * Resistance of its DOFs to moving; greater than 1 (4: moves half as far for the same error); absent: locked.
   */
  readonly stiffness?: number;
}

/**
 * The defaults. Skeletons in the axis-angle form keep their root in place, as in the program that form comes from;
 * others may move.
 */
export function defaultIk(skeleton: Skeleton | undefined): IkSetup {
  return { pins: [], stiff: [], rootIsFree: skeleton?.form !== 'axis-angle' };
}
