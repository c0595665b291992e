/**
 * Modes of the skin while joints move. `stays` (bind mode): it is rebound, so that every vertex stays in place in the
 * displayed pose. `follows` (pose mode): its bindings are kept, and it moves along.
 */
export const SKIN_MODES = ['stays', 'follows'] as const;
/** Mode of the skin while joints move; see `SKIN_MODES`. */
export type SkinMode = (typeof SKIN_MODES)[number];

/** Arguments that all rigging commands share. */
export interface Rigging {
  readonly characterId: string;
  /** Default `follows`. */
  readonly skin?: SkinMode;
  /** Transport time of the displayed pose. Default 0. */
  readonly timeSeconds?: number;
}

/** A joint, as argument of rigging commands. */
export interface OfJoint extends Rigging {
  readonly joint: number;
}
