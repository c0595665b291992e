/**
 * All that a problem of inverse kinematics holds: what is known of it, and the arrays that solving it writes to. Made
 * once by `ikProblem`; after that nothing is allocated.
 *
 * The joints that matter, those on the paths from the pins to the root, are numbered anew, in the skeleton's order:
 * SLOTS. Everything is in the space of the world matrices.
 */
import type { CompiledSkeleton } from '../kinematics.ts';
import type { IkVariables } from './variables.ts';

export interface IkProblem {
  readonly skeleton: CompiledSkeleton;
  readonly clamps: boolean;
  /** The longest way along the bones from the root to a joint or a pin; 1 where there is none. */
  readonly reach: number;
  readonly pins: PinArrays;
  readonly slots: Slots;
  readonly links: Links;
  readonly screwColumns: ScrewColumns;
  readonly balls: Balls;
  readonly variables: IkVariables;
  /** Of the root translation, those that are unknowns: -1 for the others. */
  readonly rootVariables: Int32Array;
  /** Numbers that the errors of all pins make. */
  readonly rows: number;
  readonly errors: Float64Array;
  readonly shape: JacobianShape;
  /** ∂ error / ∂ unknown: a row of `variables.count` for each error. */
  readonly jacobian: Float64Array;
  readonly foresight: Foresight;
  readonly scratch: Scratch;
  /** Overwritten by every solution. */
  readonly result: IkResult;
}

/** What a solution came to; the problem's own, overwritten by its next one. */
export interface IkResult {
  /** Steps tried, of all attempts together. */
  iterations: number;
  /** Whether every pin is within the aim of its target. */
  isSolved: boolean;
  /** By pin: how far it is from its target, in the character's unit. */
  readonly residuals: Float64Array;
  /** By pin: the angle by which its joint misses its orientation, radians; 0 where none is held. */
  readonly turns: Float64Array;
  /** The character's DOFs that a limit keeps from bringing the pins nearer: the first `bindingCount` of `binding`. */
  readonly binding: Int32Array;
  bindingCount: number;
}

export interface PinArrays {
  readonly count: number;
  readonly slot: Int32Array;
  /** x y z each, in the joint's space. */
  readonly points: Float64Array;
  /** x y z each: where they should be. Written by `movePin`. */
  readonly targets: Float64Array;
  /** x y z each: the nearest place that can be. */
  readonly aims: Float64Array;
  readonly holdsOrientation: Uint8Array;
  /** 9 each. Written by `turnPin`. */
  readonly targetFrames: Float64Array;
  /** Of the errors of position and of orientation. */
  readonly weights: Float64Array;
  readonly turnWeights: Float64Array;
  /** Its first error. */
  readonly row: Int32Array;
  /** At the pose last looked at: x y z each, `FRAME_SIZE` each, the turn left, 3 each. */
  readonly positions: Float64Array;
  readonly frames: Float64Array;
  readonly turns: Float64Array;
}

export interface Slots {
  readonly count: number;
  readonly joint: Int32Array;
  /** Its slot, or -1. */
  readonly parent: Int32Array;
  /** 16 each, at the pose last looked at. */
  readonly locals: Float64Array;
  /** Of those that are kept, and of joints that go by their own rule. */
  readonly worlds: Float64Array;
  /** 1 where somebody asks for the world matrix: a pin, a ball, a joint below that doesn't go on from it at once. */
  readonly isKept: Uint8Array;
  /** 1 where neither the joint nor any above it stretches. */
  readonly isRigid: Uint8Array;
  readonly allScrews: boolean;
  /** The pins on the joint or below it: `pinsBelow[firstPin[s]]` up to `firstPin[s + 1]`. */
  readonly firstPin: Int32Array;
  readonly pinsBelow: Int32Array;
  /** Its DOFs that an unknown moves: from `firstPart[s]` up to `firstPart[s + 1]` in the lists that follow. */
  readonly firstPart: Int32Array;
  /** Counted from the joint's first DOF. */
  readonly partDof: Int32Array;
  readonly partVariable: Int32Array;
  /** The follower that it is, or -1. */
  readonly partFollower: Int32Array;
  /** 1 where the joint is a product of screws under none that stretches: then `locals` has nothing of it. */
  readonly takesScrews: Uint8Array;
}

/** What the solver writes to, none of it of meaning between its calls. */
export interface Scratch {
  readonly twists: Float64Array;
  readonly matrix: Float64Array;
  /** By unknown. */
  readonly step: Float64Array;
  readonly held: Uint8Array;
  /** Those that are held, and those that would cross their limits and go by `fixedStep`. */
  readonly fixed: Uint8Array;
  readonly fixedStep: Float64Array;
  readonly before: Float64Array;
  /** The pose last looked at. */
  readonly seen: Float64Array;
  readonly bestPose: Float64Array;
  readonly startPose: Float64Array;
  /** Rows × unknowns. */
  readonly freeColumns: Float64Array;
  /** By row. */
  readonly rest: Float64Array;
  readonly errorsBefore: Float64Array;
  /** The errors that a step should come to. */
  readonly expected: Float64Array;
  /** Square, of `systemSize`. */
  readonly normal: Float64Array;
  readonly factor: Float64Array;
  readonly solution: Float64Array;
}

/** Where a Jacobian is not 0 for certain; a BLOCK of it is the three errors of a position, or of an orientation. */
export interface JacobianShape {
  /** Of block b, those unknowns that move it: `column[first[b]]` up to `column[first[b + 1]]`, ascending. */
  readonly first: Int32Array;
  readonly column: Int32Array;
  /** By two blocks: past how many of all unknowns none moves both. */
  readonly shared: Int32Array;
}

/** From one step of a drag to the next, by row (`foresight.ts`). */
export interface Foresight {
  /** Whether the last solution came to where the pins aim. */
  isMet: boolean;
  /** The errors before the last step. */
  readonly last: Float64Array;
  /** By how much that step's errors came out beside what it expected. */
  readonly bend: Float64Array;
  /** Those of the pose, with what is foreseen. */
  readonly foreseen: Float64Array;
}

export interface Balls {
  /** By pin, the slot of the joint in whose pivot the centre is; -1 where nothing is known to bound the pin. */
  readonly centre: Int32Array;
  readonly radius: Float64Array;
}

/** One for each screw of each slot (`screws.ts`), and one for each slot that has none. */
export interface Links {
  /** Those of slot s: from `first[s]` up to `first[s + 1]`. */
  readonly first: Int32Array;
  /** `PLAN` and `RULES` numbers each: all that forward kinematics goes by. */
  readonly plan: Int32Array;
  readonly rules: Float64Array;
  /** The unknown that moves it, or -1. */
  readonly variable: Int32Array;
  /** The follower that its DOF is, or -1. */
  readonly follower: Int32Array;
  /** Whether it turns about its axis, and how far it slides along it for each radian or by itself. */
  readonly turns: Uint8Array;
  readonly slides: Float64Array;
  /** Scratch: an angle each, its sine and cosine. */
  readonly angles: Float64Array;
  readonly turned: Float64Array;
  /** At the pose last looked at: the axis in the world and a point on it, 6 numbers each. */
  readonly lines: Float64Array;
}

/**
 * What screws write to the Jacobian: three numbers for each pin and each screw on the path from it that an unknown
 * moves. Most only turn and are followed by nothing, and their pins hold no orientation: these HINGES are listed apart.
 */
export interface ScrewColumns {
  /** Whether hinges are all that moves anything. */
  readonly areAll: boolean;
  /** Of pin p: those from `firstHinge[p]` up to `firstHinge[p + 1]`. */
  readonly firstHinge: Int32Array;
  /** Where the line of each is in `lines`, and where its first number is in the Jacobian. */
  readonly hinges: Int32Array;
  /** By how much the DOF of each changes where its unknown does by 1. */
  readonly hingeScales: Float64Array;
  /** All others: screw and pin. */
  readonly others: Int32Array;
}
