/**
 * All state of an IK problem: its description and the arrays used in solving. Allocated once by `ikProblem`.
 *
 * The joints involved, those on the paths from the pins to the root, are renumbered in skeleton order as SLOTS.
 * Everything is in the space of the world matrices.
 */
import type { CompiledSkeleton } from '../kinematics.ts';
import type { IkVariables } from './variables.ts';

/** The description and all arrays of one IK problem; solving allocates nothing. */
export interface IkProblem {
  readonly skeleton: CompiledSkeleton;
  readonly clamps: boolean;
  /** The longest path along the bones from the root to a joint or a pin; 1 if there is none. */
  readonly reach: number;
  readonly pins: PinArrays;
  readonly slots: Slots;
  readonly links: Links;
  readonly screwColumns: ScrewColumns;
  readonly balls: Balls;
  readonly variables: IkVariables;
  /** The variables of the root translation; -1 for those that are none. */
  readonly rootVariables: Int32Array;
  /** Total number of error components. */
  readonly rows: number;
  readonly errors: Float64Array;
  readonly shape: JacobianShape;
  /** ∂ error / ∂ variable: a row of `variables.count` for each error. */
  readonly jacobian: Float64Array;
  readonly foresight: Foresight;
  readonly scratch: Scratch;
  /** Overwritten by every solve. */
  readonly result: IkResult;
}

/** The result of a solve; owned by the problem and overwritten by the next one. */
export interface IkResult {
  /** Steps tried, over all attempts. */
  iterations: number;
  /** Whether every pin is at its target within tolerance. */
  isSolved: boolean;
  /** By pin: distance from its target, in the character's unit. */
  readonly residuals: Float64Array;
  /** By pin: orientation error in radians; 0 if none is held. */
  readonly turns: Float64Array;
  /** The character's DOFs whose limits keep the pins from coming nearer: the first `bindingCount` of `binding`. */
  readonly binding: Int32Array;
  bindingCount: number;
}

/** Pins as columns; positions and targets are in the space of the world matrices. */
export interface PinArrays {
  readonly count: number;
  readonly slot: Int32Array;
  /** x y z each, in the joint's space. */
  readonly points: Float64Array;
  /** x y z each: targets. Written by `movePin`. */
  readonly targets: Float64Array;
  /** x y z each: the nearest reachable position. */
  readonly aims: Float64Array;
  readonly holdsOrientation: Uint8Array;
  /** 9 each. Written by `turnPin`. */
  readonly targetFrames: Float64Array;
  /** Weights of position and orientation errors. */
  readonly weights: Float64Array;
  readonly turnWeights: Float64Array;
  /** Its first error. */
  readonly row: Int32Array;
  /** For the pose last evaluated: x y z each, `FRAME_SIZE` each, the remaining rotation, 3 each. */
  readonly positions: Float64Array;
  readonly frames: Float64Array;
  readonly turns: Float64Array;
}

/** The joints involved, as columns. */
export interface Slots {
  readonly count: number;
  readonly joint: Int32Array;
  /** Its slot, or -1. */
  readonly parent: Int32Array;
  /** 16 each, for the pose last evaluated. */
  readonly locals: Float64Array;
  /** For kept slots, and joints with their own rule. */
  readonly worlds: Float64Array;
  /** 1 if the world matrix is needed: by a pin, a ball, or a child that doesn't directly continue from it. */
  readonly isKept: Uint8Array;
  /** 1 if neither the joint nor any above it stretches. */
  readonly isRigid: Uint8Array;
  readonly allScrews: boolean;
  /** The pins on the joint or below it: `pinsBelow[firstPin[s]]` up to (excluding) `firstPin[s + 1]`. */
  readonly firstPin: Int32Array;
  readonly pinsBelow: Int32Array;
  /** Its DOFs that a variable moves: from `firstPart[s]` up to (excluding) `firstPart[s + 1]` in the lists below. */
  readonly firstPart: Int32Array;
  /** Relative to the joint's first DOF. */
  readonly partDof: Int32Array;
  readonly partVariable: Int32Array;
  /** Its index among the followers, or -1. */
  readonly partFollower: Int32Array;
  /** 1 if the joint is a product of screws and nothing above it stretches; `locals` is then unused. */
  readonly takesScrews: Uint8Array;
}

/** Scratch of the solver; meaningless between calls. */
export interface Scratch {
  readonly twists: Float64Array;
  readonly matrix: Float64Array;
  /** By variable. */
  readonly step: Float64Array;
  readonly held: Uint8Array;
  /** Held variables, and those that would cross their limits and take `fixedStep`. */
  readonly fixed: Uint8Array;
  readonly fixedStep: Float64Array;
  readonly before: Float64Array;
  /** The pose last evaluated. */
  readonly seen: Float64Array;
  readonly bestPose: Float64Array;
  readonly startPose: Float64Array;
  /** Rows × variables. */
  readonly freeColumns: Float64Array;
  /** By row. */
  readonly rest: Float64Array;
  readonly errorsBefore: Float64Array;
  /** The errors predicted for a step. */
  readonly expected: Float64Array;
  /** Square, of `systemSize`. */
  readonly normal: Float64Array;
  readonly factor: Float64Array;
  readonly solution: Float64Array;
}

/** Which entries of a Jacobian can be nonzero; a BLOCK is the three errors of a position or an orientation. */
export interface JacobianShape {
  /** The variables that move block b: `column[first[b]]` up to (excluding) `column[first[b + 1]]`, ascending. */
  readonly first: Int32Array;
  readonly column: Int32Array;
  /** By pair of blocks: the number of leading variables beyond which none moves both. */
  readonly shared: Int32Array;
}

/** State carried from one step of a drag to the next, by row (`foresight.ts`). */
export interface Foresight {
  /** Whether the last solve reached the aims of the pins. */
  isMet: boolean;
  /** The errors before the last step. */
  readonly last: Float64Array;
  /** How far that step's errors deviated from the prediction. */
  readonly bend: Float64Array;
  /** The errors of the pose including the anticipated deviation. */
  readonly foreseen: Float64Array;
}

/** The ball around a joint that bounds each pin: no pose brings it farther away. */
export interface Balls {
  /** By pin, the slot of the joint whose pivot is the centre; -1 if the pin is not known to be bounded. */
  readonly centre: Int32Array;
  readonly radius: Float64Array;
}

/** One for each screw of each slot (`screws.ts`), and one for each slot without screws. */
export interface Links {
  /** Those of slot s: from `first[s]` up to (excluding) `first[s + 1]`. */
  readonly first: Int32Array;
  /** `PLAN` and `RULES` numbers each: the input of forward kinematics. */
  readonly plan: Int32Array;
  readonly rules: Float64Array;
  /** The variable that moves it, or -1. */
  readonly variable: Int32Array;
  /** The index of its DOF among the followers, or -1. */
  readonly follower: Int32Array;
  /** Whether it rotates about its axis, and how far it slides along it per unit of its DOF. */
  readonly turns: Uint8Array;
  readonly slides: Float64Array;
  /** Scratch: an angle each, its sine and cosine. */
  readonly angles: Float64Array;
  readonly turned: Float64Array;
  /** For the pose last evaluated: the axis in the world and a point on it, 6 numbers each. */
  readonly lines: Float64Array;
}

/**
 * Entries that screws write to the Jacobian: three numbers for each pin and each screw on its path that a variable
 * moves. Most only rotate, no DOF is linked to them, and their pins hold no orientation: these HINGES are listed
 * separately.
 */
export interface ScrewColumns {
  /** Whether there are only hinges. */
  readonly areAll: boolean;
  /** Those of pin p: from `firstHinge[p]` up to (excluding) `firstHinge[p + 1]`. */
  readonly firstHinge: Int32Array;
  /** For each, the index of its line in `lines`, and of its first number in the Jacobian. */
  readonly hinges: Int32Array;
  /** Change of each one's DOF per unit of its variable. */
  readonly hingeScales: Float64Array;
  /** All others: screw and pin. */
  readonly others: Int32Array;
}
