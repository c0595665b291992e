/**
 * New positions for vertices of a removed joint. They now follow an ancestor, which displaces them unless the displayed
 * pose is the binding pose. No binding can prevent that, since the ancestor's own vertices must stay too; so the
 * vertices themselves are changed. With A·v + t the old transformation of a vertex, and A′·v + t′ the new one:
 *
 *     v′ = A′⁻¹ · (A·v + t − t′)        n′ = N′⁻¹ · N · n        morphs alike
 */
import { compileSkin, skinMatrices } from '../../evaluate/skin/deform.ts';
import { inverseTranspose3, invertAffine, isSingular } from '../../math/mat4.ts';
import type { Morph, MorphRows } from '../../model/morph.ts';
import type { Skin } from '../../model/skin.ts';
import type { JointMap } from './joint-map.ts';
import type { ShownPose } from './shown.ts';

/** Tolerance of matrices, so that noise changes no vertices. */
const SAME = 1e-12;

/** Moves vertices of removed joints to the positions they need. */
export class VertexPlaces {
  /** By vertex: 12 numbers for its position, 9 for its normal; only for vertices that move. */
  private readonly ways = new Map<number, { readonly position: Float64Array; readonly normal: Float64Array }>();

  constructor(
    before: Skin,
    private readonly after: Skin,
    was: ShownPose,
    is: ShownPose,
    { to }: JointMap,
  ) {
    const { attachments } = before;
    if (!attachments || !after.attachments) return;
    const from = new Blend(before, was);
    const into = new Blend(after, is);
    for (let v = 0; v + 1 < attachments.start.length; v++) {
      if (!isOfGone(attachments.joints, attachments.start[v], attachments.start[v + 1], to)) continue;
      from.blend(v);
      into.blend(v);
      const path = pathBetween(from, into);
      if (path) this.ways.set(v, path);
    }
  }

  /** The skin with the vertices at their new positions; the same object if none is moved. */
  skin(): Skin {
    const { after, ways } = this;
    if (ways.size === 0) return after;
    const positions = after.positions.slice();
    const normals = after.normals?.slice();
    for (const [v, { position, normal }] of ways) {
      if (3 * v + 3 > positions.length) continue;
      move(position, positions, 3 * v);
      if (normals) turn(normal, normals, 3 * v);
    }
    return { ...after, positions, ...(normals && { normals }) };
  }

  /** The morphs with moved rows; unchanged ones keep their identity. */
  morphs(morphs: readonly Morph[]): readonly Morph[] {
    const next = morphs.map((morph) => {
      const positions = this.rows(morph.positions, 'position');
      const normals = this.rows(morph.normals, 'normal');
      return positions === morph.positions && normals === morph.normals ? morph : { ...morph, positions, normals };
    });
    return next.every((morph, m) => morph === morphs[m]) ? morphs : next;
  }

  private rows(rows: MorphRows, what: 'position' | 'normal'): MorphRows {
    if (!rows.indices.some((vertex) => this.ways.has(vertex))) return rows;
    const values = rows.values.slice();
    rows.indices.forEach((vertex, row) => {
      const path = this.ways.get(vertex);
      if (path) (what === 'position' ? move : turn)(path[what], values, 3 * row);
    });
    return { indices: rows.indices, values };
  }
}

function isOfGone(joints: Uint32Array, from: number, to: number, kept: Int32Array): boolean {
  for (let a = from; a < to; a++) if (joints[a] < kept.length && kept[joints[a]] < 0) return true;
  return false;
}

/** Σ w · W·B⁻¹ of a vertex, and Σ w · (W·B⁻¹)⁻ᵀ. */
class Blend {
  readonly matrix = new Float64Array(16);
  readonly normal = new Float64Array(9);
  private readonly matrices: Float64Array;
  private readonly normals: Float64Array;

  constructor(
    private readonly skin: Skin,
    { world }: ShownPose,
  ) {
    const compiled = compileSkin(skin);
    this.matrices = new Float64Array(16 * compiled.matrixCount);
    this.normals = new Float64Array(9 * compiled.matrixCount);
    skinMatrices(compiled, world, this.matrices);
    for (let j = 0; j < compiled.matrixCount; j++) inverseTranspose3(this.matrices, 16 * j, this.normals, 9 * j);
  }

  blend(vertex: number): void {
    const { matrix, normal, matrices, normals, skin } = this;
    matrix.fill(0);
    normal.fill(0);
    const { attachments } = skin;
    if (!attachments) return;
    for (let a = attachments.start[vertex]; a < attachments.start[vertex + 1]; a++) {
      const w = attachments.weights[a];
      const joint = attachments.joints[a];
      for (let k = 0; k < 16; k++) matrix[k] += w * matrices[16 * joint + k];
      for (let k = 0; k < 9; k++) normal[k] += w * normals[9 * joint + k];
    }
  }
}

/** Undefined if they are equal, or the new one is singular. */
function pathBetween(from: Blend, into: Blend) {
  const isSame = from.matrix.every(
    (value, k) => Math.abs(value - into.matrix[k]) <= SAME * Math.max(1, Math.abs(value)),
  );
  if (isSame) return undefined;
  if (isSingular(into.matrix)) return undefined;
  // Weights that don't sum to 1 also scale the translation, so the last row is ignored.
  const back = into.matrix.slice();
  back[15] = 1;
  invertAffine(back, 0, back, 0);
  const position = new Float64Array(12);
  for (let c = 0; c < 4; c++) {
    for (let r = 0; r < 3; r++) {
      let sum = c === 3 ? back[12 + r] : 0;
      for (let k = 0; k < 3; k++) sum += back[4 * k + r] * from.matrix[4 * c + k];
      position[3 * c + r] = sum;
    }
  }
  return { position, normal: normalPath(from.normal, into.normal) };
}

function normalPath(from: Float64Array, into: Float64Array): Float64Array {
  const out = new Float64Array(9);
  for (let c = 0; c < 3; c++) for (let r = 0; r < 3; r++) square[4 * c + r] = into[3 * c + r];
  if (isSingular(square)) {
    out[0] = out[4] = out[8] = 1;
    return out;
  }
  invertAffine(square, 0, square, 0);
  for (let c = 0; c < 3; c++) {
    for (let r = 0; r < 3; r++) {
      for (let k = 0; k < 3; k++) out[3 * c + r] += square[4 * k + r] * from[3 * c + k];
    }
  }
  square[12] = square[13] = square[14] = 0;
  return out;
}

/** Scratch; never escapes. */
const square = new Float64Array(16);

/** Applies 12 numbers, columns of three, to a point. */
function move(m: Float64Array, points: Float64Array, o: number): void {
  const [x, y, z] = [points[o], points[o + 1], points[o + 2]];
  for (let r = 0; r < 3; r++) points[o + r] = m[r] * x + m[3 + r] * y + m[6 + r] * z + m[9 + r];
}

/** Applies 9 numbers to a direction. */
function turn(m: Float64Array, points: Float64Array, o: number): void {
  const [x, y, z] = [points[o], points[o + 1], points[o + 2]];
  for (let r = 0; r < 3; r++) points[o + r] = m[r] * x + m[3 + r] * y + m[6 + r] * z;
}
