/**
 * All that retargeting knows before the first frame: which rotations to take over and how (`align.ts`), how far the hips
 * go, where ankles and toes are above the ground, and when which foot stands on it (`contacts.ts`).
 *
 * The hips' way, in metres with y up, between the middles of the hip joints:
 *
 *     x, z     scale · s                      scale     ratio of the legs' lengths, if nothing else is said
 *     y        a_t + scale · (s − a_s)        a_t, a_s  height of the ankles of who stands
 *
 * With legs in the same directions that puts ankles at a_t where the source's are at a_s: on the ground.
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
  /** The source's joint by the target's; -1 for none. */
  readonly sourceOf: Int32Array;
  /** V. */
  readonly across: Float64Array;
  /** K, nine numbers a joint of the target. */
  readonly corrections: Float64Array;
  readonly fits: readonly (JointFit | undefined)[];
  /** Unit vectors along the bones of arms and legs, x y z a joint of the target; 0 elsewhere. */
  readonly bones: Float64Array;
  /** To the front of the body, in each joint's own space; x y z a joint of the target. */
  readonly fronts: Float64Array;
  readonly limbs: readonly Limb[];
  /** All DOFs of the target at rest, without morphs. */
  readonly restDofs: Float64Array;
  readonly scale: number;
  readonly ground: Ground;
  readonly plantsFeet: boolean;
  /** Those that have a whole leg. */
  readonly feet: readonly FootTrack[];
  readonly sourceSpace: SpaceRule;
  readonly targetSpace: SpaceRule;
  /** Scratch, all of it. */
  readonly dofs: Float64Array;
  readonly sourceWorld: Float64Array;
  readonly targetWorld: Float64Array;
  /** Nine numbers a joint of the target: its rotation as it should be, in its own space. */
  readonly wanted: Float64Array;
}

export interface SpaceRule {
  /** To the scene's axes. */
  readonly up: Float64Array;
  readonly metres: number;
  readonly lift: number;
}

/** What is brought into the same place: points in both skeletons, and their heights when standing, metres. */
export interface Ground {
  /** One or two joints of the target, whose middle goes where the source's goes; none where nothing travels. */
  readonly carried: readonly number[];
  readonly ownHeight: number;
  readonly sourceHeight: number;
}

export interface FootTrack {
  readonly limb: Limb;
  /** Joints whose way is kept: the balls of both feet, or the ankles. */
  readonly ball: number;
  readonly sourceBall: number;
  /** Of the balls of who stands; metres. */
  readonly ownHeight: number;
  readonly sourceHeight: number;
  /** Seconds of the source's clip, ascending: start and end of each contact. */
  readonly contacts: Float64Array;
  /** x z a contact, metres; one where there are no contacts. */
  readonly offsets: Float64Array;
  /** One a contact, metres, not below 0: how far it is raised to where the foot mostly stands. */
  readonly rises: Float64Array;
}
