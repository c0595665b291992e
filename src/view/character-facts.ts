/** Values of a character as drawn now, for all that reads them. */
import type { CharacterView } from './character-view.ts';

export interface CharacterFacts {
  /** Every DOF (see `model/dofs.ts`), clamped. Overwritten by each `seek`: copy what you keep. */
  readonly dofs: Float64Array;
  /**
   * 16 numbers per joint, column-major, in the character's own space. Read-only. Overwritten by each `seek`: copy what
   * you keep.
   */
  readonly worlds: Float64Array;
  /** A copy of `worlds`. */
  worldMatrices(): Float64Array;
  /** The skin's vertices as drawn, x y z each, in the character's own space; a copy. Empty without a skin. */
  vertices(): Float64Array;
}

export function factsOf(view: CharacterView): CharacterFacts {
  const { dofs, worldMatrices: worlds } = view;
  return { dofs, worlds, worldMatrices: () => worlds.slice(), vertices: () => view.vertices() };
}
