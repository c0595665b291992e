/**
 * Everything that retargeting precomputes: how rotations are transferred (`align.ts`), how joints that slide do so, the
 * scale of the hips' movement, how high it is above the ground (`ground.ts`), and foot contacts (`contacts.ts`).
 *
 * Movement of the hips, in metres with y up, between the centres of the hip joints:
 *
 *     x, z     scale · s              scale     ratio of the leg lengths by default
 *     y        scale · s + shift      shift     what puts the target's soles where the source's are, times the scale
 *
 * and what they move beside for feet in contact (`hips.ts`).
 */
import type { CompiledSkeleton } from '../kinematics.ts';
import type { JointFit } from './fit.ts';
import type { Limb } from './limbs.ts';
import type { SameBones } from './same-bones.ts';
import type { FootSlope } from './slopes.ts';
import type { PlayedSource } from './source-pose.ts';

/** Everything about one retargeting that is the same at all times. */
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
  readonly slopes: readonly FootSlope[];
  readonly fits: readonly (JointFit | undefined)[];
  /** Unit vectors along the bones of arms and legs, x y z per target joint; 0 elsewhere. */
  readonly bones: Float64Array;
  /** Towards the front of the body, in each joint's own space; x y z per target joint. */
  readonly fronts: Float64Array;
  readonly limbs: readonly Limb[];
  /** From ankles to toes and from wrists to middle fingers. */
  readonly tips: readonly Tip[];
  /** By target joint; undefined for those that don't slide. */
  readonly slides: readonly (Slide | undefined)[];
  /** DOFs that are no rotation and no position, like scales: target, source, and factor. */
  readonly copied: readonly CopiedDof[];
  readonly carrier: Carrier;
  /** Whether the plan depends on the target's own take, or would if it had one. */
  readonly asksOwnTake: boolean;
  /** All DOFs of the target at rest, without morphs. */
  readonly restDofs: Float64Array;
  readonly scale: number;
  /** One or two joints of the target whose centre follows the source's; none if nothing moves. */
  readonly carried: readonly number[];
  /** Metres. */
  readonly shift: number;
  readonly plantsFeet: boolean;
  /** Then both are compared in their file poses, whatever the options say. */
  readonly sameBones: SameBones;
  /** Whether the target takes the source's DOFs as they are: a copy of it, moved as far. */
  readonly isCopy: boolean;
  /** Feet of complete legs that touch the ground. */
  readonly feet: readonly FootTrack[];
  /** Absent where no foot touches the ground, and on the source's own skeleton. */
  readonly hips?: HipsTrack;
  readonly sourceSpace: SpaceRule;
  readonly targetSpace: SpaceRule;
  /** All scratch. */
  readonly dofs: Float64Array;
  readonly sourceWorld: Float64Array;
  readonly targetWorld: Float64Array;
  /** Nine numbers per target joint: its wanted rotation, in its own space. */
  readonly wanted: Float64Array;
}

/** Joints at both ends of a bone: the target's, and the source's. */
export type Tip = readonly [own: number, ownTip: number, source: number, sourceTip: number];

/** A character's space as numbers: nine of a rotation, metres per unit, and metres up. */
export interface SpaceRule {
  /** To the scene's axes. */
  readonly up: Float64Array;
  readonly metres: number;
  readonly lift: number;
}

/** A joint with position DOFs whose source has some too: it moves from its rest position as the source's does. */
export interface Slide {
  readonly source: number;
  /** The source's parent; -1 for the root, whose position is taken as a whole. */
  readonly parent: number;
  /** The source's position in its parent's space at its file pose. */
  readonly sourceRest: Float64Array;
  /** DOFs along x, y and z, -1 for none, and their values at rest. */
  readonly dofs: Int32Array;
  readonly rest: Float64Array;
}

/** A DOF whose value is copied from the source, times a factor; both are indices into the characters' DOFs. */
export interface CopiedDof {
  readonly target: number;
  readonly source: number;
  readonly factor: number;
}

/** The joint whose position DOFs move the target over the ground: the root, or one below a root that doesn't move. */
export interface Carrier {
  readonly joint: number;
  /** DOFs along x, y and z; -1 for none. */
  readonly dofs: Int32Array;
}

/** A foot that is put where the source's is while it has contact. */
export interface FootTrack {
  readonly limb: Limb;
  /** Joints whose paths are kept: the balls of both feet, or the ankles. */
  readonly ball: number;
  readonly sourceBall: number;
  /** Height of the source's ball when standing; metres. */
  readonly sourceHeight: number;
  /** Seconds of the source's take, ascending: start and end of each contact. */
  readonly contacts: Float64Array;
  /** x y z per contact, from the source's ball times the scale to the target's; metres. */
  readonly offsets: Float64Array;
  /** One per contact, metres, not negative: how far it is raised to the foot's usual contact height. */
  readonly rises: Float64Array;
  /** The most by which thigh and shin turn for it while it stands; radians. */
  readonly turns: number;
}

/** How the hips are moved for the feet (`hips.ts`). */
export interface HipsTrack {
  /** Seconds of the source's take: the second knot, and the time between knots. */
  readonly start: number;
  readonly step: number;
  /** x y z per knot, in the target's own axes and unit. */
  readonly knots: Float64Array;
}
