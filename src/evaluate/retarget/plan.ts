/**
 * Everything that retargeting precomputes: how rotations are transferred (`align.ts`), the scale of the hips' movement,
 * heights of ankles and toes above the ground, and foot contacts (`contacts.ts`).
 *
 * Movement of the hips, in metres with y up, between the centres of the hip joints:
 *
 *     x, z     scale · s                      scale     ratio of the leg lengths by default
 *     y        a_t + scale · (s − a_s)        a_t, a_s  ankle heights when standing
 *
 * With legs in the same directions this puts ankles at a_t when the source's are at a_s: on the ground.
 */
import type { CompiledSkeleton } from '../kinematics.ts';
import type { JointFit } from './fit.ts';
import type { Limb } from './limbs.ts';
import type { PlayedSource } from './source-pose.ts';

export interface RetargetPlan {
  readonly source: CompiledSkeleton;
  readonly target: CompiledSkeleton;
  readonly played: PlayedSource;
  readonly range: readonly [number, number];
  /** The source's joint by target joint; -1 for none. */
  readonly sourceOf: Int32Array;
  /** V. */
  readonly across: Float64Array;
  /** K, nine numbers per target joint. */
  readonly corrections: Float64Array;
  readonly fits: readonly (JointFit | undefined)[];
  /** Unit vectors along the bones of arms and legs, x y z per target joint; 0 elsewhere. */
  readonly bones: Float64Array;
  /** Towards the front of the body, in each joint's own space; x y z per target joint. */
  readonly fronts: Float64Array;
  readonly limbs: readonly Limb[];
  /** All DOFs of the target at rest, without morphs. */
  readonly restDofs: Float64Array;
  readonly scale: number;
  readonly ground: Ground;
  readonly plantsFeet: boolean;
  /** Feet of complete legs. */
  readonly feet: readonly FootTrack[];
  readonly sourceSpace: SpaceRule;
  readonly targetSpace: SpaceRule;
  /** All scratch. */
  readonly dofs: Float64Array;
  readonly sourceWorld: Float64Array;
  readonly targetWorld: Float64Array;
  /** Nine numbers per target joint: its wanted rotation, in its own space. */
  readonly wanted: Float64Array;
}

export interface SpaceRule {
  /** To the scene's axes. */
  readonly up: Float64Array;
  readonly metres: number;
  readonly lift: number;
}

/** Matching points of both skeletons, and their heights when standing, metres. */
export interface Ground {
  /** One or two joints of the target whose centre follows the source's; none if nothing moves. */
  readonly carried: readonly number[];
  readonly ownHeight: number;
  readonly sourceHeight: number;
}

export interface FootTrack {
  readonly limb: Limb;
  /** Joints whose paths are kept: the balls of both feet, or the ankles. */
  readonly ball: number;
  readonly sourceBall: number;
  /** Heights of the balls when standing; metres. */
  readonly ownHeight: number;
  readonly sourceHeight: number;
  /** Seconds of the source's clip, ascending: start and end of each contact. */
  readonly contacts: Float64Array;
  /** x z per contact, metres; one entry if there are no contacts. */
  readonly offsets: Float64Array;
  /** One per contact, metres, not negative: how far it is raised to the foot's usual contact height. */
  readonly rises: Float64Array;
}
