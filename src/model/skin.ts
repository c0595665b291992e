/**
 * A smooth skin: a triangle mesh whose vertices follow joints.
 *
 *     v′ = Σ wᵢ · Wᵢ · Bᵢ⁻¹ · v          n′ = normalised Σ wᵢ · (Wᵢ·Bᵢ⁻¹)⁻ᵀ · n
 *
 * Doubles, as the file gives them; the view makes floats of them for the GPU.
 */
export interface Skin {
  readonly name: string;
  /** x y z per vertex. */
  readonly positions: Float64Array;
  /** x y z per vertex, of any length; as many as positions. If absent, normals are computed, area-weighted. */
  readonly normals?: Float64Array;
  /** u v per vertex; v points up, both wrap. */
  readonly texcoords?: Float64Array;
  readonly material?: Material;
  /** If absent, the whole skin follows the root. */
  readonly attachments?: Attachments;
  /** Three vertex indices per triangle; winding differs between real files and has no meaning. */
  readonly triangles: Uint32Array;
  /** 16 numbers per joint, column-major: the joint's world matrix when the skin was bound. */
  readonly bindings: Float64Array;
}

/**
 * Which joints move a vertex, and how much: vertex v has the attachments `start[v]` up to (excluding) `start[v + 1]`.
 * Any number, including none; weights are used as given and need not sum to 1.
 */
export interface Attachments {
  /** One more than the number of vertices. */
  readonly start: Uint32Array;
  /** Depth-first joint indices, each below the number of bindings if there are any. */
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

/** Number of joints that the skin refers to: as many as it has bindings. */
export function bindingCount(skin: Skin): number {
  return skin.bindings.length / 16;
}
