import type { Vec3 } from '../math/vec3.ts';

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
  /** If absent, the whole skin follows the root. */
  readonly attachments?: Attachments;
  /** Three vertex indices per triangle; winding differs between real files and has no meaning. */
  readonly triangles: Uint32Array;
  /** At least one. They cover all triangles, in order and without gaps. */
  readonly surfaces: readonly Surface[];
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

/** Successive triangles of one material. */
export interface Surface {
  /** Only the first surface may have none: in a file, a material holds until the next one. */
  readonly material?: Material;
  /** Index of the first triangle. */
  readonly triangleStart: number;
  readonly triangleCount: number;
}

/** With both a texture and a colour, their product is shown, as in glTF. */
export interface Material {
  readonly name: string;
  /** File name of the texture, as written. */
  readonly texture?: string;
  /** Red, green and blue from 0 to 1, linear as glTF's `baseColorFactor`; as written, so possibly out of range. */
  readonly color?: Vec3;
}

/** All triangles as one surface. */
export function oneSurface(triangles: Uint32Array, material?: Material): readonly Surface[] {
  return [{ ...(material && { material }), triangleStart: 0, triangleCount: Math.floor(triangles.length / 3) }];
}

/** File names of the textures that its materials name, as written, each once. */
export function textureNames({ surfaces }: Skin): readonly string[] {
  return [...new Set(surfaces.flatMap(({ material }) => material?.texture ?? []))];
}

/** Number of vertices of a skin. */
export function vertexCount(skin: Skin): number {
  return skin.positions.length / 3;
}

/** Number of joints that the skin refers to: as many as it has bindings. */
export function bindingCount(skin: Skin): number {
  return skin.bindings.length / 16;
}
