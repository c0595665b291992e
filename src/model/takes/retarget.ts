/** How a take is retargeted to another character: which joint follows which, and the options. */

/** Which joint of the source drives which joint of the target, both by index. */
export interface JointPair {
  /** A joint of the target character. */
  readonly target: number;
  /** The joint that it follows. */
  readonly source: number;
}

/** Options of retargeting a take. */
export interface RetargetOptions {
  /** Root motion scale, from metres to metres; absent: the ratio of leg lengths. */
  readonly scale?: number;
  /**
   * The reference pose: the source's file pose, a time of its take (seconds of the take), or `automatic`: the file pose
   * if it is a standing one, else the frame closest to the target's pose.
   */
  readonly reference: 'automatic' | 'rest' | number;
  /** Whether legs are bent so that the feet follow the source's, in proportion. */
  readonly plantsFeet: boolean;
}

/** Automatic reference pose and scale, with the feet following the source's. */
export const DEFAULT_RETARGET: RetargetOptions = { reference: 'automatic', plantsFeet: true };
