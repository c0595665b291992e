/**
 * Sampled motion: one row of values per frame, at a constant frame rate; the result of motion capture and of baking.
 *
 *     values   frame 0:  v₀ v₁ … v_width−1      startSeconds
 *              frame 1:  v₀ v₁ …                startSeconds + frameSeconds
 *
 * Column k drives channel firstChannel + k. Values stay as in the file (degrees); multiplied by the column's scale they
 * are in the channel's unit (radians, lengths, weights).
 */
export interface Samples {
  /** At least 1. */
  readonly frameCount: number;
  /** Time between frames; greater than 0. */
  readonly frameSeconds: number;
  /** Time of frame 0, in seconds of the take. */
  readonly startSeconds: number;
  /** The channel that column 0 drives. */
  readonly firstChannel: number;
  /** `frameCount` rows of `scales.length` values. */
  readonly values: Float64Array;
  /** One per column; never 0. */
  readonly scales: Float64Array;
  readonly interpolation: Interpolation;
}

/**
 * How values between two frames are found: the nearer frame; linear interpolation (joints with all three rotations turn
 * along the shortest arc); a smooth curve through all frames.
 */
export const INTERPOLATIONS = ['nearest', 'linear', 'cubic'] as const;
/** How values between two frames are found; see `INTERPOLATIONS`. */
export type Interpolation = (typeof INTERPOLATIONS)[number];

/** Seconds between frames that files may state: from a microsecond to an hour. */
export const SHORTEST_FRAME = 1e-6;
/** See `SHORTEST_FRAME`. */
export const LONGEST_FRAME = 3600;

/** The column that drives a channel; -1 if none does. */
export function columnOf(samples: Samples | undefined, channel: number): number {
  if (!samples) return -1;
  const column = channel - samples.firstChannel;
  return column >= 0 && column < samples.scales.length ? column : -1;
}

/** First to last frame, in seconds of the take. */
export function rangeOfSamples({ startSeconds, frameCount, frameSeconds }: Samples): readonly [number, number] {
  return [startSeconds, startSeconds + (frameCount - 1) * frameSeconds];
}
