/**
 * A skin's morphs, in one of two ways:
 *
 * - On the GPU, as three.js's own morph targets (differences of positions and normals), while they are few and small.
 *   three.js builds their texture in one loop over vertices × morphs before the first frame, and its shader has a
 *   uniform per morph and reads them all for every vertex.
 * - Else summed on the CPU into positions and normals when weights change. Any number of morphs; three.js's texture
 *   ends at 2,048, and uniforms well before. The differences are sorted by vertex, so that summing is one pass over
 *   memory: 40 ms for a million vertices with three full morphs. (A pass per morph takes 110 ms; adding only changes is
 *   faster, but accumulates rounding errors.)
 *
 * Either way `getVertexPosition` returns what is drawn.
 */
import { BufferAttribute, type BufferGeometry } from 'three';
import type { Steps } from '../../evaluate/steps.ts';
import type { Morph, MorphRows } from '../../model/morph.ts';

/** Weights are uniforms: WebGL2 guarantees 256 vectors, and materials need some. */
const MAX_ON_GPU = 128;
/** Vertices × morphs for which three.js builds its texture in a few milliseconds. */
const LARGEST_ON_GPU = 200_000;

export interface Morphing {
  /** For `morphTargetInfluences`, updated by `apply`; empty if summed on the CPU. */
  readonly influences: number[];
  /** Sets the weights to `values[first + m]` for morph m. */
  apply(values: Float64Array, first: number): void;
}

/** Rows between two yields: under a millisecond's work. */
const STRIDE = 16384;

/**
 * @param positions x y z per vertex of the skin, in doubles
 * @param normals likewise
 */
export function* morphing(
  geometry: BufferGeometry,
  positions: Float64Array,
  normals: Float64Array,
  morphs: readonly Morph[],
): Steps<Morphing> {
  const work = (positions.length / 3) * morphs.length;
  if (morphs.length <= MAX_ON_GPU && work <= LARGEST_ON_GPU) {
    return new TargetMorphing(geometry, positions, normals, morphs);
  }
  const rows = (of: 'positions' | 'normals') => morphs.map((m) => m[of]);
  // Created as such in `skin-geometry.ts`; three.js's type allows interleaved ones too.
  const position = geometry.getAttribute('position') as BufferAttribute;
  const normal = geometry.getAttribute('normal') as BufferAttribute;
  return new SummedMorphing(morphs.length, [
    new Sum(position, positions, yield* sortByVertex(rows('positions'), positions)),
    new Sum(normal, normals, yield* sortByVertex(rows('normals'), normals)),
  ]);
}

class TargetMorphing implements Morphing {
  readonly influences: number[];

  constructor(geometry: BufferGeometry, positions: Float64Array, normals: Float64Array, morphs: readonly Morph[]) {
    this.influences = morphs.map(() => 0);
    if (morphs.length === 0) return;
    geometry.morphTargetsRelative = true;
    geometry.morphAttributes.position = morphs.map((m) => differences(m.positions, positions, m.name));
    geometry.morphAttributes.normal = morphs.map((m) => differences(m.normals, normals, m.name));
  }

  apply(values: Float64Array, first: number): void {
    const { influences } = this;
    for (let m = 0; m < influences.length; m++) influences[m] = values[first + m];
  }
}

function differences({ indices, values }: MorphRows, base: Float64Array, name: string): BufferAttribute {
  const out = new Float32Array(base.length);
  for (let row = 0; row < indices.length; row++) {
    const o = 3 * indices[row];
    for (let i = 0; i < 3; i++) out[o + i] = values[3 * row + i] - base[o + i];
  }
  const attribute = new BufferAttribute(out, 3);
  attribute.name = name;
  return attribute;
}

class SummedMorphing implements Morphing {
  readonly influences: number[] = [];
  private readonly weights: Float64Array;

  constructor(
    morphCount: number,
    private readonly sums: readonly Sum[],
  ) {
    this.weights = new Float64Array(morphCount);
  }

  apply(values: Float64Array, first: number): void {
    const { weights, sums } = this;
    let changed = false;
    for (let m = 0; m < weights.length; m++) {
      if (weights[m] === values[first + m]) continue;
      weights[m] = values[first + m];
      changed = true;
    }
    if (changed) for (let i = 0; i < sums.length; i++) sums[i].write(weights);
  }
}

/** Differences of morphs to the base, sorted by vertex. */
interface Differences {
  /** Vertices moved by any morph, ascending. */
  readonly vertices: Uint32Array;
  /** One longer than `vertices`: the i-th has the differences `start[i]` up to (not including) `start[i + 1]`. */
  readonly start: Uint32Array;
  /** The morph of each difference. */
  readonly morphs: Uint32Array;
  /** x y z each; floats, as on the GPU. */
  readonly values: Float32Array;
}

function* sortByVertex(morphs: readonly MorphRows[], base: Float64Array): Steps<Differences> {
  const vertexCount = base.length / 3;
  const counts = new Uint32Array(vertexCount);
  let all = 0;
  let moved = 0;
  for (const { indices } of morphs) {
    for (let row = 0; row < indices.length; row++) {
      if (counts[indices[row]]++ === 0) moved++;
      if (++all % STRIDE === 0) yield 1;
    }
  }
  const vertices = new Uint32Array(moved);
  const start = new Uint32Array(moved + 1);
  /** Index of a vertex's next difference. */
  const next = counts;
  let i = 0;
  for (let v = 0; v < vertexCount; v++) {
    const count = counts[v];
    if (count > 0) {
      vertices[i] = v;
      start[i + 1] = start[i] + count;
      next[v] = start[i++];
    }
    if (v % STRIDE === 0) yield 1;
  }
  const of = new Uint32Array(all);
  const values = new Float32Array(3 * all);
  yield 1;
  let done = 0;
  for (let m = 0; m < morphs.length; m++) {
    const rows = morphs[m];
    for (let row = 0; row < rows.indices.length; row++) {
      const v = rows.indices[row];
      const d = next[v]++;
      of[d] = m;
      for (let c = 0; c < 3; c++) values[3 * d + c] = rows.values[3 * row + c] - base[3 * v + c];
      if (++done % STRIDE === 0) yield 1;
    }
  }
  return { vertices, start, morphs: of, values };
}

/** base + Σ φₘ · differenceₘ, written to one attribute. */
class Sum {
  constructor(
    private readonly attribute: BufferAttribute,
    private readonly base: Float64Array,
    private readonly differences: Differences,
  ) {}

  write(weights: Float64Array): void {
    const { attribute, base } = this;
    const { vertices, start, morphs, values } = this.differences;
    const floats = attribute.array;
    if (vertices.length === 0) return;
    for (let i = 0; i < vertices.length; i++) {
      const o = 3 * vertices[i];
      let x = base[o];
      let y = base[o + 1];
      let z = base[o + 2];
      for (let d = start[i]; d < start[i + 1]; d++) {
        const weight = weights[morphs[d]];
        x += weight * values[3 * d];
        y += weight * values[3 * d + 1];
        z += weight * values[3 * d + 2];
      }
      floats[o] = x;
      floats[o + 1] = y;
      floats[o + 2] = z;
    }
    const first = vertices[0];
    const last = vertices[vertices.length - 1];
    attribute.clearUpdateRanges();
    attribute.addUpdateRange(3 * first, 3 * (last - first + 1));
    attribute.needsUpdate = true;
  }
}
