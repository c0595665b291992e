/**
 * Sampled motion: a row of values for each frame, at uniform times. What motion capture is, and what baking gives.
 *
 *     values   frame 0:  v₀ v₁ … v_width−1      startSeconds
 *              frame 1:  v₀ v₁ …                startSeconds + frameSeconds
 *
 * A column drives a channel: column k the channel firstChannel + k. Values stay as the file has them (degrees); times
 * the column's scale they are what the channel measures (radians, lengths, weights).
 */
export interface Samples {
  /** At least 1. */
  readonly frameCount: number;
  /** Between frames; above 0. */
  readonly frameSeconds: number;
  /** Of frame 0, in seconds of the clip. */
  readonly startSeconds: number;
  /** The channel that column 0 drives. */
  readonly firstChannel: number;
  /** `frameCount` rows, each of as many values as there are scales. */
  readonly values: Float64Array;
  /** One a column; never 0. */
  readonly scales: Float64Array;
  readonly interpolation: Interpolation;
}

/**
 * What is played between two frames: the nearer one; the way from one to the other (joints with all three rotations
 * turn along the shortest arc); a smooth way that passes through all frames.
 */
export const INTERPOLATIONS = ['nearest', 'linear', 'cubic'] as const;
export type Interpolation = (typeof INTERPOLATIONS)[number];

export const RADIANS_PER_DEGREE: number = Math.PI / 180;

/** The column that drives a channel; -1 where none does. */
export function columnOf(samples: Samples | undefined, channel: number): number {
  if (!samples) return -1;
  const column = channel - samples.firstChannel;
  return column >= 0 && column < samples.scales.length ? column : -1;
}

/** First to last frame, in seconds of the clip. */
export function rangeOfSamples({ startSeconds, frameCount, frameSeconds }: Samples): readonly [number, number] {
  return [startSeconds, startSeconds + (frameCount - 1) * frameSeconds];
}
