/**
 * A smooth skin: a triangle mesh whose vertices follow joints.
 *
 *     v′ = Σ wᵢ · Wᵢ · Bᵢ⁻¹ · v          n′ = normalised Σ wᵢ · (Wᵢ·Bᵢ⁻¹)⁻ᵀ · n
 *
 * Doubles, as the file gives them; the view makes floats of them for the GPU.
 */
export interface Skin {
  readonly name: string;
  /** x y z a vertex. */
  readonly positions: Float64Array;
  /** x y z a vertex, of any length but as many as positions. Without it normals are computed, area-weighted. */
  readonly normals?: Float64Array;
  /** u v a vertex; v runs up, both wrap. */
  readonly texcoords?: Float64Array;
  readonly material?: Material;
  /** Without it the whole skin hangs on the root. */
  readonly attachments?: Attachments;
  /** Three vertex indices a triangle; winding differs between real files and means nothing. */
  readonly triangles: Uint32Array;
  /** 16 numbers a joint, column-major: the joint's world matrix at the moment of binding. */
  readonly bindings: Float64Array;
}

/**
 * Which joints move a vertex, and how much: vertex v has the attachments `start[v]` up to (not including)
 * `start[v + 1]`. Any number of them, none included; weights are used as given and need not sum to 1.
 */
export interface Attachments {
  /** One more than there are vertices. */
  readonly start: Uint32Array;
  /** Depth-first joint indices, each below the number of bindings where there are any. */
  readonly joints: Uint32Array;
  readonly weights: Float64Array;
}

export interface Material {
  readonly name: string;
  /** File name of the texture, as written. */
  readonly texture?: string;
}

export function vertexCount(skin: Skin): number {
  return skin.positions.length / 3;
}

/** Joints that the skin speaks of: as many as it has bindings. */
export function bindingCount(skin: Skin): number {
  return skin.bindings.length / 16;
}
