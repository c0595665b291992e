/**
 * A morph target: absolute replacement values for some vertices of a base skin.
 *
 *     v = v₀ + Σ φₜ · (vₜ − v₀)        before skinning; normals alike
 */
export interface Morph {
  readonly name: string;
  readonly positions: MorphRows;
  readonly normals: MorphRows;
  /** In the file pose; absent: 0. */
  readonly weight?: number;
}

/** The vertices that a morph target replaces, with their values: positions, or normals. */
export interface MorphRows {
  /** Vertices of the base skin, each once: of several rows for a vertex the reader keeps the last. */
  readonly indices: Uint32Array;
  /** x y z for each entry of `indices`. */
  readonly values: Float64Array;
}
