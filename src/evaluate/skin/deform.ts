/**
 * Exact morphs and smooth skinning: doubles, any number of attachments, weights as given.
 *
 *     v = v₀ + Σ φₜ · (vₜ − v₀)                normals alike; then
 *     v′ = Σ wᵢ · Wᵢ·Bᵢ⁻¹ · v                  n′ = normalised Σ wᵢ · (Wᵢ·Bᵢ⁻¹)⁻ᵀ · n
 *
 * Used by the command line, by exports, and as the reference for rendering; the GPU draws from `skinMatrices`.
 *
 * Vertices without attachments stay in place. A skin without attachments follows the root, and one without a skeleton
 * is left as it is; in all cases normals are normalised.
 */
import { inverseTranspose3, invertAffine, isSingular, multiplyAffine, setIdentity } from '../../math/mat4.ts';
import { normalizeAt } from '../../math/vec3.ts';
import type { Morph, MorphRows } from '../../model/morph.ts';
import { perObject } from '../../model/per-object.ts';
import { bindingCount, type Skin, vertexCount } from '../../model/skin.ts';
import { normalsOf } from './normals.ts';

/** A skin ready to be deformed. */
export interface CompiledSkin {
  readonly skin: Skin;
  readonly vertexCount: number;
  /** x y z per vertex: the file's, or computed. */
  readonly normals: Float64Array;
  /** Number of matrices that move it: one per binding, at least the root's. */
  readonly matrixCount: number;
  /** B⁻¹, 16 per matrix; the identity if there is no binding. */
  readonly inverseBindings: Float64Array;
  /** Scratch of `deform`: W·B⁻¹, 16 per matrix, and its inverse transpose, 9 per matrix. */
  readonly matrices: Float64Array;
  readonly normalMatrices: Float64Array;
}

/** The skin's compiled form, cached. */
export const compileSkin = perObject(compile);

/** Number of joint matrices that move a skin: one per binding, at least the root's. */
export function matrixCountOf(skin: Skin): number {
  return Math.max(1, bindingCount(skin));
}

function compile(skin: Skin): CompiledSkin {
  const matrixCount = matrixCountOf(skin);
  const inverseBindings = new Float64Array(16 * matrixCount);
  for (let o = 0; o < inverseBindings.length; o += 16) {
    // Readers reject singular bindings; skins from elsewhere must not produce NaN.
    if (o < skin.bindings.length && !isSingular(skin.bindings, o)) invertAffine(skin.bindings, o, inverseBindings, o);
    else setIdentity(inverseBindings, o);
  }
  return {
    skin,
    vertexCount: vertexCount(skin),
    normals: normalsOf(skin),
    matrixCount,
    inverseBindings,
    matrices: new Float64Array(16 * matrixCount),
    normalMatrices: new Float64Array(9 * matrixCount),
  };
}

/**
 * Positions and normals (not normalised) with morphs applied, before skinning.
 * @param weights the weight of morph m is `weights[weightOffset + m]`
 * @param outPositions x y z per vertex
 * @param outNormals x y z per vertex
 */
export function blendMorphs(
  skin: CompiledSkin,
  morphs: readonly Morph[],
  weights: Float64Array,
  weightOffset: number,
  outPositions: Float64Array,
  outNormals: Float64Array,
): void {
  const { positions } = skin.skin;
  outPositions.set(positions);
  outNormals.set(skin.normals);
  for (let m = 0; m < morphs.length; m++) {
    const weight = weights[weightOffset + m];
    if (weight === 0) continue;
    addDifference(morphs[m].positions, positions, weight, outPositions);
    addDifference(morphs[m].normals, skin.normals, weight, outNormals);
  }
}

function addDifference({ indices, values }: MorphRows, base: Float64Array, weight: number, out: Float64Array): void {
  for (let row = 0; row < indices.length; row++) {
    const o = 3 * indices[row];
    // Typed arrays ignore writes beyond the skin's vertices; `checkMorph` reports such rows.
    out[o] += weight * (values[3 * row] - base[o]);
    out[o + 1] += weight * (values[3 * row + 1] - base[o + 1]);
    out[o + 2] += weight * (values[3 * row + 2] - base[o + 2]);
  }
}

/**
 * W·B⁻¹ for each joint that the skin refers to, 16 numbers each.
 * @param world 16 per joint; vertices of joints that the skeleton lacks stay in place
 * @param out 16 × `skin.matrixCount`
 */
export function skinMatrices(skin: CompiledSkin, world: Float64Array, out: Float64Array): void {
  for (let o = 0; o < 16 * skin.matrixCount; o += 16) {
    if (o + 16 <= world.length) multiplyAffine(world, o, skin.inverseBindings, o, out, o);
    else setIdentity(out, o);
  }
}

/**
 * The skin in a pose.
 * @param world 16 per joint, from `worldMatrices`; undefined without a skeleton
 * @param positions x y z per vertex, from `blendMorphs` or the skin's own
 * @param normals x y z per vertex, of any length
 * @param outPositions x y z per vertex; may be `positions`
 * @param outNormals x y z per vertex, normalised; may be `normals`
 */
export function deform(
  skin: CompiledSkin,
  world: Float64Array | undefined,
  positions: Float64Array,
  normals: Float64Array,
  outPositions: Float64Array,
  outNormals: Float64Array,
): void {
  const { matrices, normalMatrices, vertexCount: count } = skin;
  if (!world) {
    for (let v = 0; v < count; v++) keep(v, positions, normals, outPositions, outNormals);
    return;
  }
  skinMatrices(skin, world, matrices);
  for (let j = 0; j < skin.matrixCount; j++) inverseTranspose3(matrices, 16 * j, normalMatrices, 9 * j);
  const attachments = skin.skin.attachments ?? HANGS_ON_ROOT;
  const { start, joints, weights } = attachments;
  for (let v = 0; v < count; v++) {
    const from = attachments === HANGS_ON_ROOT ? 0 : start[v];
    const to = attachments === HANGS_ON_ROOT ? 1 : start[v + 1];
    if (from === to) {
      keep(v, positions, normals, outPositions, outNormals);
      continue;
    }
    const o = 3 * v;
    const px = positions[o];
    const py = positions[o + 1];
    const pz = positions[o + 2];
    const nx = normals[o];
    const ny = normals[o + 1];
    const nz = normals[o + 2];
    let x = 0;
    let y = 0;
    let z = 0;
    let dx = 0;
    let dy = 0;
    let dz = 0;
    for (let a = from; a < to; a++) {
      const w = weights[a];
      const m = 16 * joints[a];
      const n = 9 * joints[a];
      x += w * (matrices[m] * px + matrices[m + 4] * py + matrices[m + 8] * pz + matrices[m + 12]);
      y += w * (matrices[m + 1] * px + matrices[m + 5] * py + matrices[m + 9] * pz + matrices[m + 13]);
      z += w * (matrices[m + 2] * px + matrices[m + 6] * py + matrices[m + 10] * pz + matrices[m + 14]);
      dx += w * (normalMatrices[n] * nx + normalMatrices[n + 3] * ny + normalMatrices[n + 6] * nz);
      dy += w * (normalMatrices[n + 1] * nx + normalMatrices[n + 4] * ny + normalMatrices[n + 7] * nz);
      dz += w * (normalMatrices[n + 2] * nx + normalMatrices[n + 5] * ny + normalMatrices[n + 8] * nz);
    }
    outPositions[o] = x;
    outPositions[o + 1] = y;
    outPositions[o + 2] = z;
    outNormals[o] = dx;
    outNormals[o + 1] = dy;
    outNormals[o + 2] = dz;
    if (!normalizeAt(outNormals, o)) setDirection(outNormals, o, nx, ny, nz);
  }
}

/** Attachments of a skin without any: every vertex to the root, with weight 1. */
const HANGS_ON_ROOT = { start: new Uint32Array(0), joints: Uint32Array.of(0), weights: Float64Array.of(1) };

function keep(
  v: number,
  positions: Float64Array,
  normals: Float64Array,
  outPositions: Float64Array,
  outNormals: Float64Array,
): void {
  const o = 3 * v;
  outPositions[o] = positions[o];
  outPositions[o + 1] = positions[o + 1];
  outPositions[o + 2] = positions[o + 2];
  setDirection(outNormals, o, normals[o], normals[o + 1], normals[o + 2]);
}

/** Writes the direction of x y z, or up if there is none, so that shading never gets NaN. */
function setDirection(out: Float64Array, o: number, x: number, y: number, z: number): void {
  out[o] = x;
  out[o + 1] = y;
  out[o + 2] = z;
  if (normalizeAt(out, o)) return;
  out[o] = out[o + 2] = 0;
  out[o + 1] = 1;
}
