/**
 * Finds vertices that no watched point stands for: those that a fit moves too far from where they should be. Most
 * follow several joints, whose errors add up at one vertex and cancel each other at the next.
 */
import { multiplyAffine } from '../../../math/mat4.ts';
import type { AttachmentSets } from '../../shared/attachments.ts';
import { nodeWorlds } from '../../shared/joint-nodes.ts';
import type { Measured } from './measured.ts';
import type { WatchedSkin, WatchPoints } from './watch-points.ts';

/** Rows of a stretch that are looked at, and vertices times attachments in all of them, about. */
const MAX_ROWS = 32;
const MOST = 5_000_000;
/** Fraction of the limit: where watched points are off by less, no vertex is off by more. */
const LIKELY = 0.5;
/** Vertices of one row that are watched from then on. */
const MAX_OF_ROW = 8;

/** The vertices that are off by more than the limit at rows where something is off most, those that are off most of all. */
export function verticesBeyond(measured: Measured, points: WatchPoints, limit: number): ReadonlySet<number> {
  const found = new Set<number>();
  const { skin } = points;
  if (!skin) return found;
  const check = new VertexCheck(measured, points, skin);
  const rows = worstRows(measured.errors, (LIKELY * limit) ** 2);
  const { sets, compiled } = skin;
  const most = Math.min(MAX_ROWS, Math.ceil(MOST / (4 * sets.joints.length * compiled.vertexCount)));
  for (const m of rows.slice(0, most)) for (const v of check.beyond(m, limit)) found.add(v);
  return found;
}

/** Rows whose error is a local maximum of at least so much, the largest first. */
function worstRows(errors: Float64Array, least: number): readonly number[] {
  const rows: number[] = [];
  errors.forEach((error, m) => {
    if (error >= least && !(errors[m - 1] > error) && !(errors[m + 1] >= error)) rows.push(m);
  });
  return rows.sort((a, b) => errors[b] - errors[a]);
}

class VertexCheck {
  private readonly measured: Measured;
  private readonly points: WatchPoints;
  private readonly skin: WatchedSkin;
  private readonly worlds: Float64Array;
  private readonly matrices: readonly [Float64Array, Float64Array];
  /** How far each vertex is off. */
  private readonly off: Float64Array;
  private readonly at = [new Float64Array(3), new Float64Array(3)] as const;

  constructor(measured: Measured, points: WatchPoints, skin: WatchedSkin) {
    this.measured = measured;
    this.points = points;
    this.skin = skin;
    this.worlds = new Float64Array(16 * points.nodes.nodes.length);
    const count = skin.compiled.matrixCount;
    this.matrices = [new Float64Array(16 * count), new Float64Array(16 * count)];
    this.off = new Float64Array(skin.compiled.vertexCount);
  }

  /** The vertices that are off by more than the limit at a row: few, those that are off most. */
  beyond(m: number, limit: number): readonly number[] {
    const { rows } = this.measured;
    const made = this.measured.made.slice(0, this.measured.waysAt(m));
    const { off, skin } = this;
    const o = m * rows.width;
    this.writeMatrices(rows.values, o, 0);
    off.fill(0);
    for (const values of made) {
      this.writeMatrices(values, o, 1);
      this.addSets(values, o, skin.sets.joints.length);
      // Programs that read four attachments only show other vertices.
      if (skin.sets.joints.length > 1) this.addSets(values, o, 1);
    }
    const limit2 = limit * limit;
    const beyond: number[] = [];
    off.forEach((d, v) => {
      if (d > limit2) beyond.push(v);
    });
    return beyond.sort((a, b) => off[b] - off[a]).slice(0, MAX_OF_ROW);
  }

  /** W·B⁻¹ of each joint by a row of numbers: of the truth (0) or of what is made (1). */
  private writeMatrices(values: Float64Array, o: number, which: 0 | 1): void {
    const { nodes, lastOf } = this.points.nodes;
    const { inverseBindings, matrixCount } = this.skin.compiled;
    nodeWorlds(nodes, values, o, this.worlds);
    const count = Math.min(matrixCount, lastOf.length);
    for (let j = 0; j < count; j++) {
      multiplyAffine(this.worlds, 16 * lastOf[j], inverseBindings, 16 * j, this.matrices[which], 16 * j);
    }
  }

  private addSets(made: Float64Array, o: number, setCount: number): void {
    const { off, at, skin, matrices, measured } = this;
    const { sets, compiled, morphs } = skin;
    const most = Math.min(compiled.matrixCount, this.points.nodes.lastOf.length);
    const { positions } = compiled.skin;
    const { displacements } = this.points;
    for (let v = 0; v < off.length; v++) {
      for (let k = 0; k < 3; k++) at[0][k] = at[1][k] = positions[3 * v + k];
      displacements.forEach((displacement, i) => {
        const weight = o + morphs.weightsAt + i;
        for (let k = 0; k < 3; k++) {
          at[0][k] += measured.rows.values[weight] * displacement[3 * v + k];
          at[1][k] += made[weight] * displacement[3 * v + k];
        }
      });
      const d = distance2(sets, v, setCount, most, matrices, at);
      if (d > off[v]) off[v] = d;
    }
  }
}

/** The squared distance of a vertex by one set of matrices and by another. */
function distance2(
  { joints, weights }: AttachmentSets,
  v: number,
  setCount: number,
  jointCount: number,
  [a, b]: readonly [Float64Array, Float64Array],
  [p, q]: readonly [Float64Array, Float64Array],
): number {
  let sum = 0;
  let x = 0;
  let y = 0;
  let z = 0;
  for (let set = 0; set < setCount; set++) {
    for (let k = 4 * v; k < 4 * v + 4; k++) {
      const w = weights[set][k];
      sum += w;
      const m = 16 * joints[set][k];
      if (w === 0 || joints[set][k] >= jointCount) continue;
      x += w * (rowOf(a, m, p) - rowOf(b, m, q));
      y += w * (rowOf(a, m + 1, p) - rowOf(b, m + 1, q));
      z += w * (rowOf(a, m + 2, p) - rowOf(b, m + 2, q));
    }
  }
  return (x * x + y * y + z * z) / (sum * sum);
}

function rowOf(m: Float64Array, o: number, p: Float64Array): number {
  return m[o] * p[0] + m[o + 4] * p[1] + m[o + 8] * p[2] + m[o + 12];
}
