/** Poses frame by frame, before and after holding pins. */

/** A row of all the character's DOFs for each frame. */
export interface HeldFrames {
  readonly width: number;
  /** As in the take, within limits if they are enforced. */
  readonly own: Float64Array;
  readonly held: Float64Array;
  /** By frame: whether every pin reached its target. */
  readonly isReached: Uint8Array;
}
