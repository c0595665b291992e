/**
 * What happens to the skin when joints move. `stays` (bind mode): it is rebound, so that every vertex stays in place in
 * the displayed pose. `follows` (pose mode): its bindings are kept, and it moves along.
 */
export const SKIN_MODES = ['stays', 'follows'] as const;
export type SkinMode = (typeof SKIN_MODES)[number];

export interface Rigging {
  readonly characterId: string;
  /** Default `follows`. */
  readonly skin?: SkinMode | undefined;
  /** Transport time of the displayed pose. Default 0. */
  readonly timeSeconds?: number | undefined;
}

export interface OfJoint extends Rigging {
  readonly joint: number;
}

export type NamedAxis = 'x' | 'y' | 'z';
export const AXIS_LETTERS: readonly NamedAxis[] = ['x', 'y', 'z'];
