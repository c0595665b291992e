/** How far vertices are moved by attachments that a file leaves out or rescales. */
import type { CompiledSkin } from '../../evaluate/skin/deform.ts';
import type { AttachmentSets } from './attachments.ts';

/** Attachments of some vertices: those of entry i are `start[i]` up to (excluding) `start[i + 1]`. */
export interface Bound {
  readonly vertices: Uint32Array;
  readonly start: Uint32Array;
  readonly joints: Uint32Array;
  readonly weights: Float64Array;
}

/** The attachments of vertices that have other ones in a file: as written, up to some sets. */
export function boundAsWritten({ joints, weights }: AttachmentSets, vertices: Uint32Array, sets: number): Bound {
  const start = [0];
  const jointList: number[] = [];
  const weightList: number[] = [];
  for (const v of vertices) {
    let sum = 0;
    for (let set = 0; set < sets; set++) for (let k = 4 * v; k < 4 * v + 4; k++) sum += weights[set][k];
    for (let set = 0; set < sets; set++) {
      for (let k = 4 * v; k < 4 * v + 4; k++) {
        if (weights[set][k] === 0) continue;
        jointList.push(joints[set][k]);
        // Programs that read fewer normalise what they read.
        weightList.push(weights[set][k] / sum);
      }
    }
    start.push(jointList.length);
  }
  return boundOf(vertices, start, jointList, weightList);
}

/** The attachments as the skin has them, those of joints that are not there on the one that never moves. */
export function boundAsGiven({ skin: { attachments } }: CompiledSkin, vertices: Uint32Array, resting: number): Bound {
  const start = [0];
  const jointList: number[] = [];
  const weightList: number[] = [];
  for (const v of vertices) {
    if (attachments) {
      for (let a = attachments.start[v]; a < attachments.start[v + 1]; a++) {
        jointList.push(Math.min(resting, attachments.joints[a]));
        weightList.push(attachments.weights[a]);
      }
    }
    start.push(jointList.length);
  }
  return boundOf(vertices, start, jointList, weightList);
}

function boundOf(
  vertices: Uint32Array,
  start: readonly number[],
  joints: readonly number[],
  weights: readonly number[],
): Bound {
  return {
    vertices,
    start: Uint32Array.from(start),
    joints: Uint32Array.from(joints),
    weights: Float64Array.from(weights),
  };
}

/**
 * The largest distance between vertices bound one way and another, in one pose.
 * @param matrices W·B⁻¹ of each joint, and last of the one that never moves; 16 numbers each
 */
export function largestDisplacement(positions: Float64Array, a: Bound, b: Bound, matrices: Float64Array): number {
  const [p, q] = [new Float64Array(3), new Float64Array(3)];
  let most = 0;
  for (let i = 0; i < a.vertices.length; i++) {
    blend(positions, a, i, matrices, p);
    blend(positions, b, i, matrices, q);
    most = Math.max(most, Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
  }
  return most;
}

function blend(positions: Float64Array, bound: Bound, i: number, matrices: Float64Array, out: Float64Array): void {
  const o = 3 * bound.vertices[i];
  const x = positions[o];
  const y = positions[o + 1];
  const z = positions[o + 2];
  out.fill(0);
  for (let k = bound.start[i]; k < bound.start[i + 1]; k++) {
    const m = 16 * bound.joints[k];
    const w = bound.weights[k];
    for (let r = 0; r < 3; r++) {
      out[r] += w * (matrices[m + r] * x + matrices[m + 4 + r] * y + matrices[m + 8 + r] * z + matrices[m + 12 + r]);
    }
  }
}
