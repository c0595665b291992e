/**
 * A skin's morphs for the GPU: differences to the base, sorted by vertex, of which each vertex has the range
 * `morphRange`. Any number of morphs of any size, and a vertex costs what moves it.
 *
 *     two texels a difference     morph, x, y, z of the position     x, y, z of the normal, unused
 *
 * Weights are in the palette: see `skinning.ts`. Rejected: three.js's morph targets, whose texture has every vertex of
 * every morph, whose shader reads all of them, and whose weights are uniforms, of which there are few.
 */
import { BufferAttribute, DataTexture, FloatType, RGBAFormat, type Vector3 } from 'three';
import type { Steps } from '../../evaluate/steps.ts';
import type { Morph } from '../../model/morph.ts';

/** Rows between two yields: under a millisecond's work. */
const STRIDE = 16384;
/** Texels per row of the texture. */
export const MORPH_ROW = 2048;
/** Floats of a difference. */
const FLOATS = 8;
/** No row of a morph: the difference is only of the normal. */
const NONE = -1;

export interface PackedMorphs {
  readonly morphs: readonly Morph[];
  /** Two per vertex: its first difference, and the one after its last. */
  readonly ranges: BufferAttribute;
  readonly texture: DataTexture;
  /** Of each difference: its row in the morph's positions, or -1. */
  readonly rows: Int32Array;
  /** Whether any normal is moved; else shaders don't read differences of normals. */
  readonly moveNormals: boolean;
}

/**
 * Undefined if nothing moves a vertex.
 *
 * @param positions x y z per vertex of the skin
 * @param normals likewise
 */
export function* packMorphs(
  morphs: readonly Morph[],
  positions: Float64Array,
  normals: Float64Array,
): Steps<PackedMorphs | undefined> {
  const vertices = positions.length / 3;
  /** At first how many a vertex has; then where its next one goes. */
  const next = new Uint32Array(vertices);
  let all = 0;
  for (const morph of morphs) {
    for (let row = 0; row < rowsOf(morph); row++) {
      for (const v of verticesOf(morph, row)) {
        if (v >= vertices) continue;
        next[v]++;
        all++;
      }
      if (row % STRIDE === STRIDE - 1) yield 0.2;
    }
  }
  if (all === 0) return undefined;
  const ranges = new Uint32Array(2 * vertices);
  for (let v = 0, start = 0; v < vertices; v++) {
    ranges[2 * v] = start;
    start += next[v];
    next[v] = ranges[2 * v];
    ranges[2 * v + 1] = start;
  }
  yield 0.3;
  const floats = new Float32Array(4 * MORPH_ROW * Math.ceil((2 * all) / MORPH_ROW));
  const rows = new Int32Array(all).fill(NONE);
  let moveNormals = false;
  for (let m = 0; m < morphs.length; m++) {
    const morph = morphs[m];
    for (let row = 0; row < rowsOf(morph); row++) {
      for (const v of verticesOf(morph, row)) {
        if (v >= vertices) continue;
        const d = next[v]++;
        const o = FLOATS * d;
        floats[o] = m;
        if (morph.positions.indices[row] === v) {
          rows[d] = row;
          for (let i = 0; i < 3; i++) floats[o + 1 + i] = morph.positions.values[3 * row + i] - positions[3 * v + i];
        }
        if (morph.normals.indices[row] === v) {
          moveNormals = true;
          for (let i = 0; i < 3; i++) floats[o + 4 + i] = morph.normals.values[3 * row + i] - normals[3 * v + i];
        }
      }
      if (row % STRIDE === STRIDE - 1) yield 0.3 + (0.7 * (m + row / rowsOf(morph))) / morphs.length;
    }
  }
  const texture = new DataTexture(floats, MORPH_ROW, floats.length / 4 / MORPH_ROW, RGBAFormat, FloatType);
  texture.needsUpdate = true;
  return { morphs, ranges: new BufferAttribute(ranges, 2), texture, rows, moveNormals };
}

/** Adds Σ φₘ · (vₘ − v₀) to a vertex's position v₀, in doubles. @param weights one per morph */
export function addMorphs(
  { morphs, ranges, texture, rows }: PackedMorphs,
  positions: Float64Array,
  vertex: number,
  weights: ArrayLike<number>,
  out: Vector3,
): void {
  const { data } = texture.image;
  // As it was created: three.js allows textures without.
  if (!data) return;
  const o = 3 * vertex;
  for (let d = ranges.array[2 * vertex]; d < ranges.array[2 * vertex + 1]; d++) {
    const m = data[FLOATS * d];
    const row = 3 * rows[d];
    if (row < 0) continue;
    const { values } = morphs[m].positions;
    const weight = weights[m];
    out.x += weight * (values[row] - positions[o]);
    out.y += weight * (values[row + 1] - positions[o + 1]);
    out.z += weight * (values[row + 2] - positions[o + 2]);
  }
}

function rowsOf({ positions, normals }: Morph): number {
  return Math.max(positions.indices.length, normals.indices.length);
}

const scratch: number[] = [];

/** The vertices of a row: one, where positions and normals are listed alike, as in files. Scratch. */
function verticesOf({ positions, normals }: Morph, row: number): readonly number[] {
  scratch.length = 0;
  if (row < positions.indices.length) scratch.push(positions.indices[row]);
  if (row < normals.indices.length && normals.indices[row] !== scratch[0]) scratch.push(normals.indices[row]);
  return scratch;
}
