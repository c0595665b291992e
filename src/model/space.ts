/** The unit, up axis and ground of a character. */

/** Maps a character's own space to y up and metres, before its placement. */
export interface Space {
  /** The axis that points up; `-y`: y points down, as in pictures. */
  readonly up: 'y' | 'z' | '-y';
  readonly unit: LengthUnit;
  /** Metres per unit if the unit is `own`; greater than 0. */
  readonly metres?: number;
  /** Offset that lifts the character onto the ground; in metres, or in file units for `asIs`. */
  readonly lift: number;
  /** Whether the file states unit and up axis, or they were guessed; absent: set by the user. */
  readonly known?: 'stated' | 'guessed';
}

/**
 * The length of one unit in a file. `asIs`: taken as a metre, whatever it is. `cmu`: 1/0.45 inch, as in the motion
 * capture of Carnegie Mellon University. `own`: any other, given in `metres`.
 */
export const LENGTH_UNITS = [
  'asIs',
  'metres',
  'decimetres',
  'centimetres',
  'millimetres',
  'inches',
  'cmu',
  'own',
] as const;
/** The length of one unit in a file; see `LENGTH_UNITS`. */
export type LengthUnit = (typeof LENGTH_UNITS)[number];

/** The space of a character whose file states none: y up, a unit taken as a metre, not lifted. */
export const DEFAULT_SPACE: Space = { up: 'y', unit: 'asIs', lift: 0 };

/** The space that comes with a file: stated by it, or guessed from the posture of its characters. */
export interface FileSpace {
  readonly space: Space;
  /**
   * Fraction of the frames in which the character stands: takes of one skeleton share the guess for the surest. 0 of a
   * stated space.
   */
  readonly standing: number;
}
