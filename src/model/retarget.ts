/** How a take is put onto another character: which joints follow which, and what else can be chosen. */

export interface JointPair {
  /** A joint of the character that is moved. */
  readonly target: number;
  /** The joint that it follows. */
  readonly source: number;
}

export interface RetargetOptions {
  /** What the way of the hips is multiplied by, both in metres; absent: the ratio of the legs' lengths. */
  readonly scale?: number | undefined;
  /**
   * The pose in which both stand alike: the source's file pose, a moment of its take (seconds of the clip), or
   * `automatic`: the file pose where one stands in it, else the moment that looks most like the target's.
   */
  readonly reference: 'automatic' | 'rest' | number;
  /** Whether the legs are bent so that the feet go where the source's do, in proportion. */
  readonly plantsFeet: boolean;
}

export const DEFAULT_RETARGET: RetargetOptions = { reference: 'automatic', plantsFeet: true };
