/** How what moves a take besides its channels becomes keys: layers (`flatten.ts`), goals (`../limbs/flatten-goals.ts`). */

/** Options of flattening layers and goals. */
export interface FlattenOptions {
  /** How far fitted curves may be off: radians and weights, and lengths in parts of the character's size; default 0.001. */
  readonly tolerance?: number;
  /** Of fitted curves; default the take's own, else 30. */
  readonly framesPerSecond?: number;
}

/** Default of `FlattenOptions.tolerance`. */
export const FLATTEN_TOLERANCE = 1e-3;
