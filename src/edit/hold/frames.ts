/** Poses frame by frame, before and after pins were held in them. */

/** A row of all the character's DOFs for each frame. */
export interface HeldFrames {
  readonly width: number;
  /** As the take has them, within limits if those hold. */
  readonly own: Float64Array;
  readonly held: Float64Array;
  /** By frame: whether every pin came to where it should. */
  readonly isReached: Uint8Array;
}
